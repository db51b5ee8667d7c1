//! Values of states as exact numbers over one denominator.

use num_bigint::BigUint;
use num_traits::Zero;

/// Doubles in `[0, 1]` as `numerator / 2^shift`.
pub(super) struct ExactValues<'a> {
    doubles: &'a [f64],
    numerators: Vec<BigUint>,
    shift: u64,
}

impl<'a> ExactValues<'a> {
    /// Values in `[0, 1]`.
    pub fn new(doubles: &'a [f64]) -> Self {
        let shift = doubles.iter().map(|&x| places(x)).max().unwrap_or(0);
        let numerator = |&x: &f64| {
            let (mantissa, places) = (odd_mantissa(x), places(x));
            if mantissa.is_zero() { BigUint::zero() } else { BigUint::from(mantissa) << (shift - places) }
        };
        Self { doubles, numerators: doubles.iter().map(numerator).collect(), shift }
    }

    /// The values as they were given.
    pub fn doubles(&self) -> &'a [f64] {
        self.doubles
    }

    /// The value of a state times `2^shift`.
    pub fn numerator(&self, state: u32) -> &BigUint {
        &self.numerators[state as usize]
    }

    /// The exponent of the denominator.
    pub fn shift(&self) -> u64 {
        self.shift
    }
}

/// The mantissa and the exponent `e` of `x = m 2ᵉ`, a double in `[0, 1]`.
fn parts(x: f64) -> (u64, i64) {
    let bits = x.to_bits();
    let (exponent, fraction) = ((bits >> 52 & 0x7ff) as i64, bits & ((1 << 52) - 1));
    if exponent == 0 { (fraction, -1074) } else { (fraction | 1 << 52, exponent - 1075) }
}

/// The mantissa without trailing zeros.
fn odd_mantissa(x: f64) -> u64 {
    let (mantissa, _) = parts(x);
    if mantissa == 0 { 0 } else { mantissa >> mantissa.trailing_zeros() }
}

/// How many binary places `x` has after the point.
fn places(x: f64) -> u64 {
    let (mantissa, exponent) = parts(x);
    if mantissa == 0 { 0 } else { (-exponent - i64::from(mantissa.trailing_zeros())).max(0) as u64 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::{Rational, from_dyadic};
    use num_bigint::BigInt;
    use num_traits::One;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn values_are_exact(xs in prop::collection::vec(prop_oneof![
            0.0f64..=1.0, Just(0.0), Just(1.0), Just(5e-324), 0.0f64..1e-300
        ], 1..6)) {
            let values = ExactValues::new(&xs);
            for (i, &x) in xs.iter().enumerate() {
                let numerator = BigInt::from(values.numerator(i as u32).clone());
                prop_assert_eq!(Rational::new(numerator, BigInt::one() << values.shift()), from_dyadic(x).unwrap());
            }
        }
    }
}
