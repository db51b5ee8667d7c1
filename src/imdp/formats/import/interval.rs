//! Intervals as they are written.

use super::decimal::{Decimal, read_decimal};
use super::error::Fault;
use super::exact_sum::ExactSum;
use super::text::Cursor;
use super::written::read_written_interval;

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
pub(crate) fn read_interval(cursor: &mut Cursor<'_>, blank: &[u8]) -> Result<Interval, Box<Fault>> {
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
    if lower.value > upper.value
        || (lower.value == upper.value && lower_text != upper_text && exceeds(lower_text, upper_text))
    {
        let expected = format!("an upper bound of at least {}", lower_text.escape_ascii());
        return Err(cursor.fault_at(upper_at, expected));
    }
    cursor.expect(b']', "`]`")?;
    Ok(Interval { lower: lower.value, upper: upper.value, shortest: lower.shortest && upper.shortest })
}

/// Reads an interval or a number in any layout that [`read_written_interval`] knows, and appends it to `written` in the one
/// that [`read_interval`] does.
pub(in crate::formats) fn read_any_interval(
    cursor: &mut Cursor<'_>,
    written: &mut Vec<u8>,
) -> Result<Interval, Box<Fault>> {
    let start = cursor.offset();
    let strict = read_interval(cursor, b" ");
    if matches!(cursor.peek(), b' ' | b'\t' | b'\r' | b'\n') && strict.is_ok() {
        written.extend_from_slice(cursor.since(start));
        return strict;
    }
    cursor.rewind(start);
    let (in_brackets, rest) = (cursor.peek() == b'[', cursor.rest());
    let ends = |byte: &u8| if in_brackets { *byte == b']' } else { byte.is_ascii_whitespace() };
    let end = rest.iter().position(ends).map_or(rest.len(), |end| end + usize::from(in_brackets));
    let Some((lower, upper)) = read_written_interval(&rest[..end]) else {
        return Err(strict
            .err()
            .unwrap_or_else(|| cursor.fault_here("a blank or the end of the line after it")));
    };
    let text = format!("[{lower},{upper}]");
    let bounds = read_interval(&mut Cursor::new(text.as_bytes(), 0), b"");
    // In the layout that everybody knows, the place of a mistake is known as well.
    let bounds =
        bounds.map_err(|fault| strict.err().unwrap_or_else(|| cursor.fault_at(start, fault.expected)))?;
    written.extend_from_slice(text.as_bytes());
    cursor.advance(end);
    Ok(bounds)
}

#[cold]
fn exceeds(left: &[u8], right: &[u8]) -> bool {
    ExactSum::of([left]).compare(&ExactSum::of([right])).is_gt()
}
