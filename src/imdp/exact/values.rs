//! Values of states as exact numbers over one denominator, and sums of products with them.

use crate::model::StateId;
use crate::numeric::Rational;
use num_bigint::BigUint;
use num_traits::{One, Zero};
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// Numbers in `[0, 1]` as `numerator / denominator`.
pub(crate) struct ExactValues<'a> {
    doubles: &'a [f64],
    /// Whether some of the numbers are no doubles.
    mixed: bool,
    /// The numerators, `width` digits of 64 bits each, the least significant first.
    digits: Vec<u64>,
    width: usize,
    /// The denominator is `odd · 2^shift`.
    shift: u64,
    odd: BigUint,
}

/// Numbers that stand in place of doubles, by state.
pub(crate) type Replaced = BTreeMap<StateId, Rational>;

impl<'a> ExactValues<'a> {
    /// Doubles in `[0, 1]`, and other numbers in their place.
    pub(crate) fn with(doubles: &'a [f64], replaced: &Replaced) -> Self {
        let mut shift = doubles.iter().map(|&x| places(x)).max().unwrap_or(0);
        let mut odd = BigUint::one();
        for denominator in replaced.values().map(|number| number.denom().magnitude()) {
            let twos = denominator.trailing_zeros().unwrap_or(0);
            shift = shift.max(twos);
            let rest = denominator >> twos;
            if !(&odd % &rest).is_zero() {
                let common = Rational::new(rest.clone().into(), odd.clone().into());
                odd *= common.numer().magnitude();
            }
        }
        // A numerator is at most the denominator.
        let width = ((shift + odd.bits()) / 64 + 1) as usize;
        let mut digits = vec![0; width * doubles.len()];
        for (digits, &x) in digits.chunks_exact_mut(width).zip(doubles) {
            let (mantissa, offset) = (odd_mantissa(x), shift - places(x));
            let shifted = u128::from(mantissa) << (offset % 64);
            let pair = [shifted as u64, (shifted >> 64) as u64];
            let from = if mantissa == 0 { 0 } else { (offset / 64) as usize };
            digits[from..].iter_mut().zip(pair).for_each(|(digit, part)| *digit = part);
        }
        if !odd.is_one() {
            for digits in digits.chunks_exact_mut(width) {
                let number = digits.iter().rev().fold(BigUint::zero(), |sum, &digit| (sum << 64) + digit);
                put(digits, &(number * &odd));
            }
        }
        let denominator = &odd << shift;
        for (&state, number) in replaced {
            let numerator = number.numer().magnitude() * (&denominator / number.denom().magnitude());
            if let Some(digits) = digits.chunks_exact_mut(width).nth(state.index()) {
                put(digits, &numerator);
            }
        }
        Self { doubles, mixed: !replaced.is_empty(), digits, width, shift, odd }
    }

    /// The same, to be compared only.
    pub(crate) fn to_compare(doubles: &'a [f64], replaced: &Replaced) -> Self {
        match replaced.is_empty() {
            true => Self { doubles, mixed: false, digits: vec![], width: 0, shift: 0, odd: BigUint::one() },
            false => Self::with(doubles, replaced),
        }
    }

    /// The digits of the value of a state times the denominator.
    pub(crate) fn numerator(&self, state: StateId) -> &[u64] {
        &self.digits[state.index() * self.width..][..self.width]
    }

    /// Compares the values of two states.
    pub(crate) fn compare(&self, a: StateId, b: StateId) -> Ordering {
        match self.mixed {
            false => self.doubles[a.index()].total_cmp(&self.doubles[b.index()]),
            true => self.numerator(a).iter().rev().cmp(self.numerator(b).iter().rev()),
        }
    }

    /// The denominator times another number.
    pub(crate) fn denominator_times(&self, scale: BigUint) -> BigUint {
        let scaled = scale << self.shift;
        if self.odd.is_one() { scaled } else { scaled * &self.odd }
    }
}

/// Fills digits with a number that fits.
fn put(digits: &mut [u64], number: &BigUint) {
    digits.fill(0);
    digits.iter_mut().zip(number.iter_u64_digits()).for_each(|(digit, part)| *digit = part);
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
    use crate::numeric::from_dyadic;
    use num_bigint::BigInt;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn values_are_exact(xs in prop::collection::vec(prop_oneof![
            0.0f64..=1.0, Just(0.0), Just(1.0), Just(5e-324), 0.0f64..1e-300
        ], 1..6)) {
            let values = ExactValues::with(&xs, &Replaced::new());
            for (i, &x) in xs.iter().enumerate() {
                let mut sum = SumOfProducts::default();
                sum.add([1].into_iter(), values.numerator(StateId(i as u32)));
                let numerator = BigInt::from(sum.total());
                let denominator = BigInt::from(values.denominator_times(BigUint::one()));
                prop_assert_eq!(Rational::new(numerator, denominator), from_dyadic(x).unwrap());
            }
        }

        #[test]
        fn other_numbers_are_exact_too(xs in prop::collection::vec(0.0f64..=1.0, 3), n in 0u32..=30, d in 31u32..60) {
            let fraction = Rational::new(n.into(), d.into());
            let replaced = Replaced::from([(StateId(1), fraction.clone()), (StateId(2), from_dyadic(1e-3).unwrap())]);
            let values = ExactValues::with(&xs, &replaced);
            let exact = [from_dyadic(xs[0]).unwrap(), fraction, from_dyadic(1e-3).unwrap()];
            for (i, value) in exact.iter().enumerate() {
                let mut sum = SumOfProducts::default();
                sum.add([1].into_iter(), values.numerator(StateId(i as u32)));
                let denominator = BigInt::from(values.denominator_times(BigUint::one()));
                prop_assert_eq!(&Rational::new(BigInt::from(sum.total()), denominator), value);
                for (j, other) in exact.iter().enumerate() {
                    prop_assert_eq!(values.compare(StateId::from_index(i), StateId::from_index(j)), value.cmp(other));
                }
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
