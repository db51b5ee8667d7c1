//! Fixed-point numbers in `[0, 1]`: natural multiples of `2⁻¹²⁰`.
//!
//! Sums and differences are exact; a sum of products is exact too until it is rounded once, at the end.

use crate::numeric::Rational;
use num_bigint::BigInt;
use num_traits::{Signed, ToPrimitive, Zero};

/// The binary places after the point.
pub(super) const PLACES: u32 = 120;

/// The number 1.
pub(super) const ONE: u128 = 1 << PLACES;

/// The largest multiple that is at most a number in `[0, 1]`, and whether it is that number.
pub(super) fn floor(number: &Rational) -> Option<(u128, bool)> {
    if number.is_negative() {
        return None;
    }
    let scaled: BigInt = number.numer() << PLACES;
    let units = (&scaled / number.denom()).to_u128().filter(|&units| units <= ONE)?;
    Some((units, (scaled % number.denom()).is_zero()))
}

/// The largest multiple that is at most a double in `[0, 1]`.
pub(super) fn floor_f64(x: f64) -> u128 {
    // Scaling by a power of two is exact, and so is the cut to an integer.
    if x.is_nan() { 0 } else { ((x * ONE as f64) as u128).min(ONE) }
}

/// The smallest multiple that is at least a double in `[0, 1]`.
pub(super) fn ceil_f64(x: f64) -> u128 {
    if x.is_nan() { ONE } else { ((x * ONE as f64).ceil() as u128).min(ONE) }
}

/// The largest double that is at most so many multiples.
pub(super) fn to_f64_down(units: u128) -> f64 {
    let nearest = units as f64;
    let below = if nearest as u128 > units { nearest.next_down() } else { nearest };
    below / ONE as f64
}

/// The smallest double that is at least so many multiples.
pub(super) fn to_f64_up(units: u128) -> f64 {
    let nearest = units as f64;
    let above = if (nearest as u128) < units { nearest.next_up() } else { nearest };
    above / ONE as f64
}

/// So many multiples as a rational.
pub(in crate::solver) fn to_rational(units: u128) -> Rational {
    Rational::new(BigInt::from(units), BigInt::from(ONE))
}

/// A sum of products of two numbers in `[0, 1]`, in units of `2⁻²⁴⁰`.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct SumOfProducts {
    high: u128,
    low: u128,
}

impl SumOfProducts {
    /// Adds `a b`; the sum stays below `2¹⁶`.
    pub(super) fn add(&mut self, a: u128, b: u128) {
        const HALF: u128 = u64::MAX as u128;
        let (a_high, a_low, b_high, b_low) = (a >> 64, a & HALF, b >> 64, b & HALF);
        let middle = a_high * b_low + a_low * b_high;
        let (low, carry) = (a_low * b_low).overflowing_add(middle << 64);
        let high = a_high * b_high + (middle >> 64) + u128::from(carry);
        let (low, carry) = self.low.overflowing_add(low);
        self.low = low;
        self.high += high + u128::from(carry);
    }

    /// The sum in units of `2⁻¹²⁰`, rounded down.
    pub(super) fn floor(self) -> u128 {
        (self.high << (128 - PLACES)) | (self.low >> PLACES)
    }

    /// The sum in units of `2⁻¹²⁰`, rounded up.
    pub(super) fn ceil(self) -> u128 {
        self.floor() + u128::from(self.low & (ONE - 1) != 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::from_dyadic;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn products_are_exact(pairs in prop::collection::vec((0..=ONE, 0..=ONE), 0..6)) {
            let mut sum = SumOfProducts::default();
            pairs.iter().for_each(|&(a, b)| sum.add(a, b));
            let exact: BigInt = pairs.iter().map(|&(a, b)| BigInt::from(a) * BigInt::from(b)).sum();
            let (floor, rest) = (&exact / BigInt::from(ONE), &exact % BigInt::from(ONE));
            prop_assert_eq!(BigInt::from(sum.floor()), floor.clone());
            prop_assert_eq!(BigInt::from(sum.ceil()), floor + BigInt::from(u8::from(!rest.is_zero())));
        }

        #[test]
        fn doubles_enclose(units in prop_oneof![0..=ONE, 0u128..1000]) {
            let exact = to_rational(units);
            let (down, up) = (to_f64_down(units), to_f64_up(units));
            prop_assert!(from_dyadic(down).unwrap() <= exact && exact <= from_dyadic(up).unwrap());
            prop_assert!(down == up || down.next_up() == up);
            prop_assert_eq!(floor(&exact), Some((units, true)));
            prop_assert!(floor_f64(down) <= units && units <= ceil_f64(up));
        }

        #[test]
        fn doubles_are_cut(x in prop_oneof![0.0f64..=1.0, 0.0f64..1e-30]) {
            let exact = from_dyadic(x).unwrap();
            prop_assert!(to_rational(floor_f64(x)) <= exact && exact <= to_rational(ceil_f64(x)));
            prop_assert!(ceil_f64(x) - floor_f64(x) <= 1);
        }
    }
}
