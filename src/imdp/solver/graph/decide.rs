//! Sums of bounds compared with 1, decided on the decimals that were written.

use crate::numeric::{Rational, from_decimal, rounding_factor};
use num_traits::{One, Zero};
use std::cmp::Ordering;

/// How far a running sum of `count` bounds may be from the sum of their decimals.
///
/// Sum and intermediate results are at most `count`; the reading of each bound and each addition or
/// subtraction err by at most a relative `2⁻⁵³`.
pub(super) fn margin(count: usize) -> f64 {
    rounding_factor(2 * count + 4) * count as f64
}

/// Compares the sum of bounds, read as decimals, with 1.
pub(super) fn compare_with_one(bounds: impl Iterator<Item = f64> + Clone) -> Ordering {
    let (mut sum, mut count) = (0.0, 0);
    for bound in bounds.clone() {
        sum += bound;
        count += 1;
    }
    if (sum - 1.0_f64).abs() > margin(count) {
        return sum.total_cmp(&1.0);
    }
    let exact = bounds.filter_map(from_decimal).fold(Rational::zero(), |sum, bound| sum + bound);
    exact.cmp(&Rational::one())
}

/// Whether the upper bounds of the successors in a set reach 1: `Σ_T u ≥ 1`.
pub(in crate::solver) fn upper_covers_one(row: crate::model::Row<'_>, inside: impl Fn(u32) -> bool) -> bool {
    let outside = || row.successors.iter().zip(row.upper).filter(|(s, u)| !inside(**s) && **u > 0.0);
    // A row admits a distribution: if nothing else is possible, the set has it all.
    outside().next().is_none()
        || compare_with_one(
            row.successors.iter().zip(row.upper).filter(|(s, _)| inside(**s)).map(|(_, u)| *u),
        ) != Ordering::Less
}

/// Whether the lower bounds of the successors in a set reach 1: `Σ_T l ≥ 1`.
pub(super) fn lower_covers_one(row: crate::model::Row<'_>, inside: impl Fn(u32) -> bool + Clone) -> bool {
    compare_with_one(row.successors.iter().zip(row.lower).filter(|(s, _)| inside(**s)).map(|(_, l)| *l))
        != Ordering::Less
}

/// Whether every distribution of a row gives the successor at a position positive probability.
pub(in crate::solver) fn certain(row: crate::model::Row<'_>, position: usize) -> bool {
    let itself = row.successors[position];
    row.lower[position] > 0.0 || (row.upper[position] > 0.0 && !upper_covers_one(row, |s| s != itself))
}

/// Whether some distribution that stays in a set gives the successor at a position positive probability; the row is
/// known to have a distribution that stays.
pub(in crate::solver) fn possible_within(
    row: crate::model::Row<'_>,
    position: usize,
    inside: impl Fn(u32) -> bool + Clone,
) -> bool {
    let itself = row.successors[position];
    row.upper[position] > 0.0 && !lower_covers_one(row, move |s| inside(s) && s != itself)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_tenths_are_one() {
        assert_eq!(compare_with_one([0.1; 10].into_iter()), Ordering::Equal);
        assert_eq!(compare_with_one([0.1, 0.2, 0.3, 0.4].into_iter()), Ordering::Equal);
        assert_eq!(compare_with_one([0.1, 0.2, 0.3, 0.4000000000000001].into_iter()), Ordering::Greater);
        assert_eq!(compare_with_one([1.0, 5e-324].into_iter()), Ordering::Greater);
        assert_eq!(compare_with_one([0.9999999999999999].into_iter()), Ordering::Less);
        assert_eq!(compare_with_one([0.5, 0.6].into_iter()), Ordering::Greater);
        assert_eq!(compare_with_one(std::iter::empty()), Ordering::Less);
    }
}
