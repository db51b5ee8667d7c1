//! Values of states as exact numbers over one denominator, and sums of products with them.

use num_bigint::BigUint;
use num_traits::Zero;

/// Doubles in `[0, 1]` as `numerator / 2^shift`.
pub(crate) struct ExactValues<'a> {
    doubles: &'a [f64],
    /// The numerators, `width` digits of 64 bits each, the least significant first.
    digits: Vec<u64>,
    width: usize,
    shift: u64,
}

impl<'a> ExactValues<'a> {
    /// Values in `[0, 1]`.
    pub(crate) fn new(doubles: &'a [f64]) -> Self {
        let shift = doubles.iter().map(|&x| places(x)).max().unwrap_or(0);
        // A numerator is at most 2^shift.
        let width = (shift / 64 + 1) as usize;
        let mut digits = vec![0; width * doubles.len()];
        for (digits, &x) in digits.chunks_exact_mut(width).zip(doubles) {
            let (mantissa, offset) = (odd_mantissa(x), shift - places(x));
            let shifted = u128::from(mantissa) << (offset % 64);
            let pair = [shifted as u64, (shifted >> 64) as u64];
            let from = if mantissa == 0 { 0 } else { (offset / 64) as usize };
            digits[from..].iter_mut().zip(pair).for_each(|(digit, part)| *digit = part);
        }
        Self { doubles, digits, width, shift }
    }

    /// The values as they were given.
    pub(crate) fn doubles(&self) -> &'a [f64] {
        self.doubles
    }

    /// The digits of the value of a state times `2^shift`.
    pub(crate) fn numerator(&self, state: u32) -> &[u64] {
        &self.digits[state as usize * self.width..][..self.width]
    }

    /// The exponent of the denominator.
    pub(crate) fn shift(&self) -> u64 {
        self.shift
    }
}

/// A sum of products of natural numbers, carries settled at the end.
#[derive(Default)]
pub(crate) struct SumOfProducts {
    /// By digit of 64 bits; room for 2⁶⁴ summands.
    sums: Vec<u128>,
}

impl SumOfProducts {
    /// Adds `a b`, both given by their digits of 64 bits, the least significant first.
    pub(super) fn add(&mut self, a: impl Iterator<Item = u64>, b: &[u64]) {
        for (i, a) in a.enumerate().filter(|(_, a)| *a != 0) {
            if self.sums.len() < i + b.len() + 1 {
                self.sums.resize(i + b.len() + 1, 0);
            }
            for (j, &b) in b.iter().enumerate() {
                let product = u128::from(a) * u128::from(b);
                self.sums[i + j] += product & u128::from(u64::MAX);
                self.sums[i + j + 1] += product >> 64;
            }
        }
    }

    /// The sum.
    pub(super) fn total(&self) -> BigUint {
        self.sums.iter().rev().fold(BigUint::zero(), |total, &sum| (total << 64) + sum)
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
                let mut sum = SumOfProducts::default();
                sum.add([1].into_iter(), values.numerator(i as u32));
                let numerator = BigInt::from(sum.total());
                prop_assert_eq!(Rational::new(numerator, BigInt::one() << values.shift()), from_dyadic(x).unwrap());
            }
        }

        #[test]
        fn sums_of_products_are_exact(pairs in prop::collection::vec((any::<[u64; 2]>(), any::<[u64; 3]>()), 0..9)) {
            let number = |digits: &[u64]| digits.iter().rev().fold(BigUint::zero(), |n, &d| (n << 64) + d);
            let mut sum = SumOfProducts::default();
            pairs.iter().for_each(|(a, b)| sum.add(a.iter().copied(), b));
            let exact: BigUint = pairs.iter().map(|(a, b)| number(a) * number(b)).sum();
            prop_assert_eq!(sum.total(), exact);
        }
    }
}
