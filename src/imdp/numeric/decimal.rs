//! Short decimals that bound a number from one side.

use super::{from_decimal, from_dyadic};

/// The shortest text that reads back as the double `x`, as every writer of this crate prints numbers.
///
/// Integers lose their `.0`: `1` and `0`, not `1.0` and `0.0`.
pub fn shortest_decimal(x: f64) -> String {
    let mut buffer = zmij::Buffer::new();
    let text = buffer.format_finite(x);
    text.strip_suffix(".0").unwrap_or(text).to_owned()
}

/// The largest decimal with at most `digits` significant digits that bounds `x` from below.
///
/// Both readings of the result are at most `x`: the decimal as written and the double nearest to it,
/// so a file that prints it and a solver that computes with it are sound together. A double that is such
/// a short decimal exactly is returned unchanged. Needs `x` finite and `1 ≤ digits ≤ 15`.
pub fn round_decimal_down(x: f64, digits: usize) -> f64 {
    let text = format!("{x:.*e}", digits - 1);
    let rounded = parse(&text);
    // What reads as a smaller double is smaller: decimals that read alike end where the next double is not far.
    let is_below = rounded < x || rounded == x && from_decimal(rounded) <= from_dyadic(x);
    if is_below { rounded } else { step_down(&text, digits) }
}

/// The smallest decimal with at most `digits` significant digits that bounds `x` from above.
///
/// The mirror image of [`round_decimal_down`].
pub fn round_decimal_up(x: f64, digits: usize) -> f64 {
    -round_decimal_down(-x, digits)
}

/// The next smaller decimal with the same number of significant digits, after one in scientific notation.
fn step_down(text: &str, digits: usize) -> f64 {
    let next = text.split_once('e').and_then(|(mantissa, exponent)| {
        let mantissa: i64 = mantissa.replace('.', "").parse().ok()?;
        let exponent: i32 = exponent.parse().ok()?;
        Some(parse(&format!("{}e{}", mantissa - 1, exponent - (digits as i32 - 1))))
    });
    next.unwrap_or(f64::NAN)
}

fn parse(text: &str) -> f64 {
    text.parse().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn short_decimals_stay() {
        for x in [0.0, 1.0, 0.5, 0.015625] {
            assert_eq!(round_decimal_down(x, 10), x);
            assert_eq!(round_decimal_up(x, 10), x);
        }
    }

    #[test]
    fn text_is_short() {
        assert_eq!(shortest_decimal(1.0), "1");
        assert_eq!(shortest_decimal(0.0), "0");
        assert_eq!(shortest_decimal(0.0001), "0.0001");
        assert_eq!(shortest_decimal(round_decimal_down(1.0 / 3.0, 4)), "0.3333");
        assert_eq!(shortest_decimal(round_decimal_up(1.0 / 3.0, 4)), "0.3334");
        assert_eq!(shortest_decimal(round_decimal_up(0.9999999, 3)), "1");
    }

    proptest! {
        #[test]
        fn bounds_enclose_as_double_and_as_decimal(x in 1e-300f64..1.0, digits in 2usize..=15) {
            let (down, up) = (round_decimal_down(x, digits), round_decimal_up(x, digits));
            prop_assert!(down <= x && x <= up);
            let exact = from_dyadic(x).unwrap();
            prop_assert!(from_decimal(down).unwrap() <= exact && exact <= from_decimal(up).unwrap());
            prop_assert!(up - down <= x * 20.0 * 10f64.powi(-(digits as i32)) + f64::MIN_POSITIVE);
        }
    }
}
