//! Probabilities as they are written.

use std::cmp::Ordering;

use super::error::Fault;
use super::exact_sum::ExactSum;
use super::text::Cursor;

/// The longest mantissa accepted; the exact value of every double is shorter, and so is what stands for a fraction.
pub(super) const LONGEST: usize = 1108;

/// The longest exponent accepted, with its letter. Mantissas have a limit of their own: what is written of a number has no more
/// digits than what was read, but perhaps an exponent.
pub(super) const LONGEST_EXPONENT: usize = 24;

const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18,
    1e19, 1e20, 1e21, 1e22,
];

/// Any two numbers of so few digits have different doubles, so each of them is the shortest decimal of its double.
const FEW_DIGITS: u64 = 1_000_000_000_000_000;

/// A number that was read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Decimal {
    /// The double nearest to it.
    pub value: f64,
    /// Whether it is certainly the shortest decimal of that double; if not, [`Exact`](crate::numeric::Exact) looks.
    pub shortest: bool,
}

/// Reads a decimal in `[0, 1]`: `0.25`, `1`, `2.5e-7`.
///
/// # Errors
/// A sign, `NaN`, more than 1 as written, or a positive number that no double can tell from 0.
#[inline]
pub(crate) fn read_decimal(cursor: &mut Cursor<'_>) -> Result<Decimal, Box<Fault>> {
    let text = cursor.rest();
    let mut at = 0;
    let mut mantissa = 0u64;
    let mut digits = 0;
    let mut scale = 0;
    while let Some(digit @ b'0'..=b'9') = text.get(at) {
        mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit - b'0'));
        at += 1;
        digits += 1;
    }
    if digits == 0 {
        return Err(not_a_probability(cursor));
    }
    if text.get(at) == Some(&b'.') {
        at += 1;
        let point = at;
        while let Some(digit @ b'0'..=b'9') = text.get(at) {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit - b'0'));
            at += 1;
        }
        scale = at - point;
        digits += scale;
        if scale == 0 {
            return Err(not_a_probability(cursor));
        }
    }
    let has_exponent = matches!(text.get(at), Some(b'e' | b'E'));
    // Both mantissa and power are doubles exactly, so that one division rounds correctly.
    if !has_exponent && digits <= 19 && mantissa < 1 << 53 && scale < POWERS.len() {
        let value = mantissa as f64 / POWERS[scale];
        if value > 1.0 {
            return Err(cursor.fault_here("a probability of at most 1"));
        }
        cursor.advance(at);
        return Ok(Decimal { value, shortest: mantissa < FEW_DIGITS });
    }
    read_long_decimal(cursor, at)
}

/// Reads a decimal that has an exponent or many digits; its mantissa ends at `at`.
#[cold]
fn read_long_decimal(cursor: &mut Cursor<'_>, mut at: usize) -> Result<Decimal, Box<Fault>> {
    let text = cursor.rest();
    let is_zero = !text[..at].iter().any(|byte| matches!(byte, b'1'..=b'9'));
    let mantissa = at;
    if matches!(text.get(at), Some(b'e' | b'E')) {
        at += 1;
        at += usize::from(matches!(text.get(at), Some(b'+' | b'-')));
        let digits = text[at..].iter().take_while(|byte| byte.is_ascii_digit()).count();
        if digits == 0 {
            return Err(not_a_probability(cursor));
        }
        at += digits;
    }
    if mantissa > LONGEST || at - mantissa > LONGEST_EXPONENT {
        let expected = format!("at most {LONGEST} characters and {LONGEST_EXPONENT} more for the exponent");
        return Err(cursor.fault_here(expected));
    }
    let parsed = std::str::from_utf8(&text[..at]).ok().and_then(|text| text.parse::<f64>().ok());
    let value = parsed.ok_or_else(|| not_a_probability(cursor))?;
    if value == 0.0 && !is_zero {
        return Err(cursor.fault_here("a probability that a double can tell from 0"));
    }
    // A little above 1 reads as exactly 1.
    if value > 1.0 || (value == 1.0 && ExactSum::of([&text[..at]]).cmp_one() == Ordering::Greater) {
        return Err(cursor.fault_here("a probability of at most 1"));
    }
    cursor.advance(at);
    Ok(Decimal { value, shortest: false })
}

#[cold]
fn not_a_probability(cursor: &Cursor<'_>) -> Box<Fault> {
    cursor.fault_here(match cursor.peek() {
        b'-' => "a probability that is not negative",
        _ => "a probability such as 0.25 or 2.5e-7",
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::Exact;
    use proptest::prelude::*;

    fn read(text: &str) -> Result<f64, String> {
        let read = read_decimal(&mut Cursor::new(text.as_bytes(), 0));
        read.map(|decimal| decimal.value).map_err(|fault| fault.expected)
    }

    #[test]
    fn probabilities_only() {
        for (text, value) in [("0", 0.0), ("1", 1.0), ("1.000", 1.0), ("10e-1", 1.0), ("5E-324", 5e-324)] {
            assert_eq!(read(text), Ok(value), "{text}");
        }
        for text in ["0e-99999999999999999999", "0.3", "00.5", "1e0", "0.1000000000000000055511151231257827"]
        {
            assert_eq!(read(text), Ok(text.parse().unwrap()), "{text}");
        }
        for text in
            ["1.5", "1.00000000000000000000001", "1e1", "1e999999999999999999999", "99999999999999999999"]
        {
            assert!(read(text).unwrap_err().contains("at most 1"), "{text}");
        }
        for text in ["", "x", ".5", "1.", "NaN", "+0.5", "1e", "inf", "0x1", "1/3"] {
            assert!(read(text).is_err() || text.starts_with(['0', '1']), "{text}");
        }
        assert!(read("-0.5").unwrap_err().contains("negative"));
        assert!(read("1e-400").unwrap_err().contains("from 0"));
    }

    /// A number of many places is written with an exponent, which makes it longer.
    #[test]
    fn what_is_written_of_the_longest_is_read() {
        let text = format!("0.{}", "9".repeat(LONGEST - 2));
        let exact = Exact::of(text.as_bytes(), read(&text).unwrap()).unwrap();
        let written = exact.to_string();
        assert!(written.contains("e-"), "{written}");
        assert_eq!(read(&written), read(&text));
        assert!(read(&format!("{text}9")).unwrap_err().contains("at most 1108 characters"));
        assert!(read(&format!("0e-{}", "9".repeat(LONGEST_EXPONENT))).unwrap_err().contains("24 more"));
    }

    proptest! {
        #[test]
        fn the_nearest_double_is_read(value in 0.0f64..=1.0, digits in 0usize..25) {
            for text in [format!("{value:.digits$}"), format!("{value:e}"), format!("{value}")] {
                prop_assert_eq!(read(&text), Ok(text.parse().unwrap()));
                let decimal = read_decimal(&mut Cursor::new(text.as_bytes(), 0)).unwrap();
                prop_assert!(!decimal.shortest || Exact::of(text.as_bytes(), decimal.value).is_none());
            }
        }
    }
}
