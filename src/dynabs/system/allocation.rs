//! Control allocation: how a demand is shared among more inputs than it takes.

use super::rehearsal::Rehearsal;
use super::{Demands, LinearSystem, Shares};
use crate::geometry::Polytope;
use crate::linear_algebra::ExactMatrix;
use imdp::numeric::{Rational, from_dyadic, to_f64};
use nalgebra::DMatrix;
use num_traits::One;

/// Weights are cut to so many bits, so that exact numbers stay short.
const WEIGHT_BITS: u32 = 8;

/// A right inverse `M` of `B` and the input `ū` about which it is used: `u = ū + M (d − A x − q − B ū)`.
///
/// `M = W Bᵀ (B W Bᵀ)⁻¹` with a diagonal `W`, and `ū` the center of the bounding box of `U`. With the squares of the half
/// widths `w` of `U` for `W`, inputs are compared by the share of their range that they use, and their units do
/// not matter. From there `W` and `ū` are changed by [`Shares`], as long as more [`Demands`] can be met or more is reached: an input
/// that is of no use is left alone.
///
/// For a square `B` all this is `B⁻¹`.
#[derive(Clone, Debug)]
pub(super) struct ControlAllocation {
    /// `M`, `p×n`.
    pub(super) right_inverse: ExactMatrix,
    /// `ū`, `p×1`.
    pub(super) center: ExactMatrix,
}

impl ControlAllocation {
    /// The allocation of `system` for inputs in `input`; `None` unless `B` has full row rank.
    ///
    /// Where there is nothing to share, or no range to do so by, shares do not matter.
    pub(super) fn new(system: &LinearSystem, input: &Polytope, shares: Option<&Shares>) -> Option<Self> {
        let b = system.b();
        let p = b.columns();
        let about_zero = |right_inverse| Self { right_inverse, center: ExactMatrix::zeros(p, 1) };
        if b.rows() == p {
            return b.inverse().map(about_zero);
        }
        let weighted = shares.and_then(|shares| Self::weighted(system, input, shares));
        weighted.or_else(|| b.right_inverse().map(about_zero))
    }

    /// The shares of inputs in `input` with which most demands are met; `None` if there is nothing to share.
    pub(super) fn rehearsed(system: &LinearSystem, input: &Polytope, demands: &Demands) -> Option<Shares> {
        if system.b().rows() == system.b().columns() {
            return None;
        }
        let (middle, half) = middle_and_half(input)?;
        let doubles = |values: &[Rational]| values.iter().map(to_f64).collect::<Vec<_>>();
        Some(Rehearsal::new(system, (&doubles(&middle), &doubles(&half)), demands).best())
    }

    fn weighted(system: &LinearSystem, input: &Polytope, shares: &Shares) -> Option<Self> {
        let (middle, half) = middle_and_half(input)?;
        let b = system.b();
        let exact = |value: f64| from_dyadic(cut(value));
        let weight = |(half, &share): (&Rational, &f64)| Some(half * half * exact(share)?);
        let weights: Vec<Rational> = half.iter().zip(&shares.weights).map(weight).collect::<Option<_>>()?;
        let shifted = |i: usize| Some(&middle[i] + &half[i] * exact(shares.shifts[i])?);
        let center: Vec<Rational> = (0..b.columns()).map(shifted).collect::<Option<_>>()?;
        let weighted = ExactMatrix::from_fn(b.columns(), b.rows(), |i, j| &weights[i] * b.get(j, i));
        let right_inverse = weighted.times(&b.times(&weighted).inverse()?);
        Some(Self { right_inverse, center: ExactMatrix::from_fn(b.columns(), 1, |i, _| center[i].clone()) })
    }
}

/// The middle of the bounding box of `U`, and half its widths.
fn middle_and_half(input: &Polytope) -> Option<(Vec<Rational>, Vec<Rational>)> {
    let two = Rational::one() + Rational::one();
    let bounds = input.bounding_box()?;
    Some(bounds.iter().map(|(lower, upper)| ((upper + lower) / &two, (upper - lower) / &two)).unzip())
}

/// `M` of [`ControlAllocation`] in doubles and before it is improved, for `B` (`n×p`) and half widths of inputs: enough to compare
/// designs; `None` unless `B` has full row rank with the inputs that have a range.
pub(crate) fn rough_right_inverse(b: &DMatrix<f64>, half: &[f64]) -> Option<DMatrix<f64>> {
    let weighted = DMatrix::from_fn(b.ncols(), b.nrows(), |i, j| half[i] * half[i] * b[(j, i)]);
    Some(&weighted * (b * &weighted).try_inverse()?)
}

/// The first bits of a double.
fn cut(x: f64) -> f64 {
    f64::from_bits(x.to_bits() >> (52 - WEIGHT_BITS) << (52 - WEIGHT_BITS))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(rows: usize, columns: usize, entries: &[f64]) -> ExactMatrix {
        ExactMatrix::from_decimals(&DMatrix::from_row_slice(rows, columns, entries)).unwrap()
    }

    fn input(lower: &[f64], upper: &[f64]) -> Polytope {
        let exact = |values: &[f64]| exact(1, values.len(), values).entries().to_vec();
        Polytope::from_box(&exact(lower), &exact(upper))
    }

    fn allocation(
        a: &[f64],
        b: &[f64],
        (lower, upper): (&[f64], &[f64]),
        holds: &[&[f64]],
    ) -> ControlAllocation {
        let p = lower.len();
        let n = b.len() / p;
        let system = LinearSystem::new(exact(n, n, a), exact(n, p, b), ExactMatrix::zeros(n, 1));
        let holds = holds.iter().map(|x| (x.to_vec(), 1.0)).collect();
        let demands = Demands { cell: vec![0.1; n], holds };
        let input = input(lower, upper);
        let shares = ControlAllocation::rehearsed(&system, &input, &demands);
        let found = ControlAllocation::new(&system, &input, shares.as_ref()).unwrap();
        assert_eq!(system.b().times(&found.right_inverse), ExactMatrix::identity(n));
        found
    }

    #[test]
    fn inputs_are_shared_by_what_they_can_do() {
        // The weak one is not asked for more than it has, and opposed ones start from their middles.
        let weak = allocation(&[1.0], &[1.0, 1.0], (&[-0.01, -2.0], &[0.01, 2.0]), &[]);
        assert!(weak.right_inverse.to_f64()[(0, 0)] * 2.0 <= 0.01);
        let opposed = allocation(&[0.9], &[0.1, -0.1], (&[0.0, 0.0], &[10.0, 10.0]), &[]);
        assert_eq!(opposed.right_inverse, exact(2, 1, &[5.0, -5.0]));
        assert_eq!(opposed.center, exact(2, 1, &[5.0, 5.0]));
    }

    #[test]
    fn square_systems_have_one_law() {
        let square =
            allocation(&[1.0, 1.0, 0.0, 1.0], &[0.5, 0.0, 0.0, 2.0], (&[1.0, -1.0], &[3.0, 1.0]), &[]);
        assert_eq!(square.center, ExactMatrix::zeros(2, 1));
        assert_eq!(square.right_inverse, exact(2, 2, &[2.0, 0.0, 0.0, 0.5]));
    }

    #[test]
    fn units_do_not_matter_and_what_is_demanded_does() {
        let (a, b) = ([0.9, 0.1, 0.0, 0.8], [0.5, 0.2, 0.1, 0.1, 0.4, -0.3]);
        let (lower, upper) = ([-1.0, -1.0, 0.0], [1.0, 1.0, 2.0]);
        let hold: &[&[f64]] = &[&[1.1, 1.1]];
        let plain = allocation(&a, &b, (&lower, &upper), &[]);
        let holding = allocation(&a, &b, (&lower, &upper), hold);
        let need = exact(2, 1, &[0.0, 0.22]);
        let largest = |found: &ControlAllocation| {
            let shift = found.center.minus(&found.right_inverse.times(&exact(2, 3, &b).times(&found.center)));
            let u = found.right_inverse.times(&need).plus(&shift).to_f64();
            (0..3).map(|i| (u[i] - (lower[i] + upper[i]) / 2.0).abs()).fold(0.0, f64::max)
        };
        assert!(largest(&holding) < largest(&plain), "{} {}", largest(&holding), largest(&plain));
        let milli = [0.5, 0.0002, 0.1, 0.1, 0.0004, -0.3];
        let other = allocation(&a, &milli, (&[-1.0, -1000.0, 0.0], &[1.0, 1000.0, 2.0]), hold);
        let thousand = Rational::from_integer(1000.into());
        for j in 0..2 {
            assert_eq!(holding.right_inverse.get(0, j), other.right_inverse.get(0, j));
            assert_eq!(holding.right_inverse.get(1, j) * &thousand, *other.right_inverse.get(1, j));
        }
    }
}
