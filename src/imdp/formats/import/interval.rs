//! Intervals as they are written.

use super::decimal::{Decimal, read_decimal};
use super::error::Fault;
use super::exact_sum::ExactSum;
use super::text::Cursor;

/// Bounds that were read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Interval {
    /// The double nearest to the lower bound.
    pub lower: f64,
    /// The double nearest to the upper bound.
    pub upper: f64,
    /// Whether both bounds are certainly the shortest decimals of their doubles.
    pub shortest: bool,
}

impl Interval {
    /// Bounds given as doubles, which stand for their shortest decimals.
    pub(crate) fn of_doubles(lower: f64, upper: f64) -> Self {
        Self { lower, upper, shortest: true }
    }
}

/// Reads `[lower,upper]`, or a plain number that is both bounds; `blank` may follow the comma.
///
/// # Errors
/// Those of [`read_decimal`], and an upper bound below the lower one.
#[inline]
pub(crate) fn read_interval(
    cursor: &mut Cursor<'_>,
    blank: &[u8],
) -> Result<Interval, Box<Fault>> {
    if cursor.peek() != b'[' {
        let Decimal { value, shortest } = read_decimal(cursor)?;
        return Ok(Interval { lower: value, upper: value, shortest });
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
    if lower.value > upper.value || (lower.value == upper.value && lower_text != upper_text && exceeds(lower_text, upper_text)) {
        let expected = format!("an upper bound of at least {}", lower_text.escape_ascii());
        return Err(cursor.fault_at(upper_at, expected));
    }
    cursor.expect(b']', "`]`")?;
    Ok(Interval { lower: lower.value, upper: upper.value, shortest: lower.shortest && upper.shortest })
}

#[cold]
fn exceeds(left: &[u8], right: &[u8]) -> bool {
    ExactSum::of([left]).compare(&ExactSum::of([right])).is_gt()
}
