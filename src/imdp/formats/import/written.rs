//! Numbers as people write them, brought into the one form that is read exactly.

use super::decimal::{LONGEST, LONGEST_EXPONENT};
use crate::numeric::Rational;
use num_bigint::BigInt;
use num_traits::{Pow, Signed, Zero};

/// How many digits stand for a fraction that no decimal equals; it is enclosed by two of them.
const DIGITS: u32 = 40;

/// The most places of an exact decimal; other fractions are enclosed.
const MOST_PLACES: u32 = 1100;

/// A number between two decimals, which are the same unless it is a fraction like 1/3.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::formats) struct Written {
    /// At most the number.
    pub lower: String,
    /// At least the number.
    pub upper: String,
}

/// Reads `.4`, `+0.4`, `4.`, `2/5`, `1e-3` as decimals that start with a digit; `None` for anything else.
pub(in crate::formats) fn read_written(text: &[u8]) -> Option<Written> {
    let text = std::str::from_utf8(text).ok()?.trim_ascii();
    if text.len() > LONGEST + LONGEST_EXPONENT {
        return None;
    }
    match text.split_once('/') {
        None => decimal(text).map(|exact| Written { lower: exact.clone(), upper: exact }),
        Some((numerator, denominator)) => fraction(numerator.trim_ascii(), denominator.trim_ascii()),
    }
}

/// Reads the two bounds of `[lower, upper]`, or a number that is both.
pub(in crate::formats) fn read_written_interval(text: &[u8]) -> Option<(String, String)> {
    let Some(inside) = text.strip_prefix(b"[") else {
        return read_written(text).map(|number| (number.lower, number.upper));
    };
    let inside = inside.strip_suffix(b"]")?;
    let comma = inside.iter().position(|byte| *byte == b',')?;
    let (lower, upper) = (read_written(&inside[..comma])?, read_written(&inside[comma + 1..])?);
    Some((lower.lower, upper.upper))
}

/// `digits.digits e exponent` with a digit in front and, if there is a point, one behind it.
fn decimal(text: &str) -> Option<String> {
    let text = text.strip_prefix('+').unwrap_or(text);
    let (mantissa, exponent) = match text.find(['e', 'E']) {
        Some(at) => (&text[..at], Some(&text[at + 1..])),
        None => (text, None),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits = |part: &str| part.bytes().all(|byte| byte.is_ascii_digit());
    let exponent_digits = exponent.map(|exponent| exponent.strip_prefix(['+', '-']).unwrap_or(exponent));
    if !digits(whole) || !digits(fraction) || whole.len() + fraction.len() == 0 {
        return None;
    }
    if exponent_digits.is_some_and(|part| part.is_empty() || !digits(part)) {
        return None;
    }
    let mut decimal = if whole.is_empty() { "0".to_owned() } else { whole.to_owned() };
    if !fraction.is_empty() {
        decimal.push('.');
        decimal.push_str(fraction);
    }
    if let Some(exponent) = exponent {
        decimal.push('e');
        decimal.push_str(exponent);
    }
    Some(decimal)
}

fn fraction(numerator: &str, denominator: &str) -> Option<Written> {
    let integer = |text: &str| {
        let is_number = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
        is_number.then(|| text.parse::<BigInt>().ok()).flatten()
    };
    let (numerator, denominator) = (integer(numerator)?, integer(denominator)?);
    if denominator.is_zero() {
        return None;
    }
    Some(enclose(&Rational::new(numerator, denominator)))
}

/// A number of at least 0 as decimals: exactly if there is one, else rounded both ways.
pub(in crate::formats) fn enclose(number: &Rational) -> Written {
    let mut rest = number.denom().clone();
    let mut places = [0u32; 2];
    for (prime, places) in [2u8, 5].into_iter().zip(&mut places) {
        while (&rest % prime).is_zero() && *places <= MOST_PLACES {
            rest /= prime;
            *places += 1;
        }
    }
    let exact = rest == BigInt::from(1);
    let places = if exact { places[0].max(places[1]) } else { DIGITS };
    let scale = BigInt::from(10).pow(places);
    let scaled = number.numer().abs() * &scale;
    let (floor, rest) = (&scaled / number.denom(), &scaled % number.denom());
    let ceiling = if rest.is_zero() { floor.clone() } else { &floor + 1 };
    let text = |scaled: &BigInt| {
        let digits = format!("{scaled:0>width$}", width = places as usize + 1);
        let (whole, fraction) = digits.split_at(digits.len() - places as usize);
        if fraction.is_empty() { whole.to_owned() } else { format!("{whole}.{fraction}") }
    };
    Written { lower: text(&floor), upper: text(&ceiling) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_form_for_all() {
        for (text, decimal) in [
            (".4", "0.4"),
            ("+0.4", "0.4"),
            ("4.", "4"),
            ("2/5", "0.4"),
            ("1e-3", "1e-3"),
            ("7/8", "0.875"),
            ("3/3", "1"),
        ] {
            assert_eq!(read_written(text.as_bytes()).unwrap().lower, decimal, "{text}");
            assert_eq!(read_written(text.as_bytes()).unwrap().upper, decimal, "{text}");
        }
        for text in ["", ".", "-1", "1/0", "1/-2", "x", "1e", "1/2/3", "NaN", "0x1", "1 2"] {
            assert_eq!(read_written(text.as_bytes()), None, "{text}");
        }
    }

    #[test]
    fn thirds_are_enclosed() {
        let Written { lower, upper } = read_written(b"1/3").unwrap();
        assert!(lower.starts_with("0.33333333333333333333") && lower.ends_with('3'));
        assert!(upper.starts_with("0.33333333333333333333") && upper.ends_with('4'));
        assert_eq!(read_written_interval(b"[1/4, 1/2]"), Some(("0.25".into(), "0.5".into())));
        assert_eq!(read_written_interval(b"[1/4 1/2]"), None);
    }
}
