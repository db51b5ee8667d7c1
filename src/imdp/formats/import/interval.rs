//! Intervals as they are written.

use super::decimal::read_decimal;
use super::error::Fault;
use super::exact_sum::ExactSum;
use super::text::Cursor;

/// Reads `[lower,upper]`, or a plain number that is both bounds; `blank` may follow the comma.
///
/// # Errors
/// Those of [`read_decimal`], and an upper bound below the lower one.
#[inline]
pub(in crate::formats) fn read_interval(
    cursor: &mut Cursor<'_>,
    blank: &[u8],
) -> Result<(f64, f64), Box<Fault>> {
    if cursor.peek() != b'[' {
        let probability = read_decimal(cursor)?;
        return Ok((probability, probability));
    }
    cursor.advance(1);
    let lower_at = cursor.offset();
    let lower = read_decimal(cursor)?;
    let lower_text = cursor.since(lower_at);
    cursor.expect(b',', "`,` and the upper bound")?;
    cursor.skip(blank);
    let upper_at = cursor.offset();
    let upper = read_decimal(cursor)?;
    let upper_text = cursor.since(upper_at);
    // Bounds that differ by less than a double can tell are compared as written.
    if lower > upper || (lower == upper && lower_text != upper_text && exceeds(lower_text, upper_text)) {
        let expected = format!("an upper bound of at least {}", lower_text.escape_ascii());
        return Err(cursor.fault_at(upper_at, expected));
    }
    cursor.expect(b']', "`]`")?;
    Ok((lower, upper))
}

#[cold]
fn exceeds(left: &[u8], right: &[u8]) -> bool {
    ExactSum::of([left]).compare(&ExactSum::of([right])).is_gt()
}
