//! Rationals read from decimals, and their directed rounding to doubles.

use num_bigint::{BigInt, BigUint};
use num_traits::{Pow, ToPrimitive, Zero};

/// An exact rational number.
pub type Rational = num_rational::BigRational;

/// The shortest decimal that reads back as `x`, as an exact rational; `None` unless `x` is finite.
///
/// `0.1` gives `1/10`, not the dyadic number nearest to it. This is what a user who wrote `0.1` meant.
pub fn from_decimal(x: f64) -> Option<Rational> {
    let (digits, power) = decimal_parts(x)?;
    let (digits, ten) = (BigInt::from(digits), BigInt::from(10));
    Some(if power >= 0 {
        Rational::from_integer(digits * ten.pow(power.unsigned_abs()))
    } else {
        Rational::new(digits, ten.pow(power.unsigned_abs()))
    })
}

/// Integers `(d, e)` such that `d · 10ᵉ` is the shortest decimal that reads back as `x`; `None` unless `x` is finite.
pub fn decimal_parts(x: f64) -> Option<(i64, i32)> {
    if !x.is_finite() {
        return None;
    }
    // The standard library's `{:e}` prints the shortest digits that round-trip, at most 17.
    let text = format!("{x:e}");
    let (mantissa, exponent) = text.split_once('e')?;
    let exponent: i32 = exponent.parse().ok()?;
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    let digits: i64 = format!("{whole}{fraction}").parse().ok()?;
    Some((digits, exponent - fraction.len() as i32))
}

/// The exact value of a double; `None` unless it is finite.
pub fn from_dyadic(x: f64) -> Option<Rational> {
    Rational::from_float(x)
}

/// The double nearest to `r` (`±∞` beyond the range of doubles).
pub fn to_f64(r: &Rational) -> f64 {
    if r.is_zero() { 0.0 } else { r.to_f64().unwrap_or(f64::NAN) }
}

/// The largest double that is at most `r`.
pub fn to_f64_down(r: &Rational) -> f64 {
    let nearest = to_f64(r);
    match from_dyadic(nearest) {
        Some(exact) if exact <= *r => nearest,
        Some(_) => nearest.next_down(),
        None if nearest > 0.0 => f64::MAX,
        None => nearest,
    }
}

/// The smallest double that is at least `r`.
pub fn to_f64_up(r: &Rational) -> f64 {
    -to_f64_down(&-r)
}

/// The least common multiple of two denominators.
pub(crate) fn common_multiple(a: BigUint, b: &BigUint) -> BigUint {
    if (&a % b).is_zero() {
        return a;
    }
    // `a/b` in lowest terms has the denominator `b / gcd(a, b)`.
    let reduced = Rational::new(a.clone().into(), b.clone().into());
    a * reduced.denom().magnitude()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn ratio(n: i64, d: i64) -> Rational {
        Rational::new(n.into(), d.into())
    }

    #[test]
    fn decimals_mean_what_was_written() {
        assert_eq!(from_decimal(0.1).unwrap(), ratio(1, 10));
        assert_eq!(from_decimal(-3.4).unwrap(), ratio(-17, 5));
        assert_eq!(from_decimal(1e12).unwrap(), ratio(1_000_000_000_000, 1));
        assert_eq!(from_decimal(5e-8).unwrap(), ratio(1, 20_000_000));
        assert_eq!(from_decimal(0.0).unwrap(), ratio(0, 1));
        assert!(from_decimal(f64::NAN).is_none() && from_decimal(f64::INFINITY).is_none());
    }

    #[test]
    fn one_third_is_enclosed_tightly() {
        let (down, up) = (to_f64_down(&ratio(1, 3)), to_f64_up(&ratio(1, 3)));
        assert_eq!(down.next_up(), up);
        assert!(from_dyadic(down).unwrap() < ratio(1, 3) && ratio(1, 3) < from_dyadic(up).unwrap());
    }

    proptest! {
        #[test]
        fn decimals_round_trip(x in proptest::num::f64::NORMAL | proptest::num::f64::SUBNORMAL) {
            prop_assert_eq!(to_f64(&from_decimal(x).unwrap()), x);
        }

        #[test]
        fn rounding_is_directed_and_tight(n in any::<i64>(), d in 1i64..) {
            let r = ratio(n, d);
            let (down, up) = (to_f64_down(&r), to_f64_up(&r));
            prop_assert!(from_dyadic(down).unwrap() <= r && r <= from_dyadic(up).unwrap());
            prop_assert!(down == up || down.next_up() == up);
        }
    }
}
