//! Sums of bounds compared with 1, decided on the bounds as they were written.

use crate::model::{End, Row, StateId};
use crate::numeric::{Rational, rounding_factor};
use num_traits::{One, Zero};
use std::cmp::Ordering;

/// How far a running sum of `count` bounds may be from the sum of what they stand for.
///
/// Sum and intermediate results are at most `count`; the reading of each bound and each addition or
/// subtraction err by at most a relative `2⁻⁵³`.
pub(super) fn margin(count: usize) -> f64 {
    rounding_factor(2 * count + 4) * count as f64
}

/// Compares the sum of the bounds at one end, over the successors that `include` names by position, with 1.
pub(super) fn compare_with_one(row: Row<'_>, end: End, include: impl Fn(usize) -> bool) -> Ordering {
    let positions = || (0..row.len()).filter(|&i| include(i));
    let (mut sum, mut count) = (0.0, 0);
    for i in positions() {
        sum += row.bounds(end)[i];
        count += 1;
    }
    if (sum - 1.0_f64).abs() > margin(count) {
        return sum.total_cmp(&1.0);
    }
    let exact = positions().fold(Rational::zero(), |sum, i| sum + row.rational(end, i));
    exact.cmp(&Rational::one())
}

/// Whether the upper bounds of the successors in a set reach 1: `Σ_T u ≥ 1`.
pub(in crate::solver) fn upper_covers_one(row: Row<'_>, inside: impl Fn(StateId) -> bool) -> bool {
    // A row admits a distribution: if nothing else is possible, the set has it all.
    let outside = row.successors.iter().zip(row.upper).any(|(s, u)| !inside(*s) && *u > 0.0);
    !outside || compare_with_one(row, End::Upper, |i| inside(row.successors[i])) != Ordering::Less
}

/// Whether the lower bounds of the successors in a set reach 1: `Σ_T l ≥ 1`.
pub(super) fn lower_covers_one(row: Row<'_>, inside: impl Fn(StateId) -> bool) -> bool {
    compare_with_one(row, End::Lower, |i| inside(row.successors[i])) != Ordering::Less
}

/// Whether some distribution that stays in a set gives the successor at a position positive probability; the row is
/// known to have a distribution that stays.
pub(in crate::solver) fn possible_within(
    row: crate::model::Row<'_>,
    position: usize,
    inside: impl Fn(u32) -> bool + Clone,
) -> bool {
    let itself = row.successors[position];
    row.upper[position] > 0.0 && !lower_covers_one(row, move |s| inside(s.0) && s != itself)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{ExactBound, Row};
    use crate::numeric::Exact;

    fn compared(bounds: &[f64], exact: &[ExactBound]) -> Ordering {
        let successors: Vec<StateId> = StateId::first(bounds.len()).collect();
        let row = Row { successors: &successors, lower: bounds, upper: bounds, exact };
        compare_with_one(row, End::Upper, |_| true)
    }

    #[test]
    fn ten_tenths_are_one() {
        assert_eq!(compared(&[0.1; 10], &[]), Ordering::Equal);
        assert_eq!(compared(&[0.1, 0.2, 0.3, 0.4], &[]), Ordering::Equal);
        assert_eq!(compared(&[0.1, 0.2, 0.3, 0.4000000000000001], &[]), Ordering::Greater);
        assert_eq!(compared(&[1.0, 5e-324], &[]), Ordering::Greater);
        assert_eq!(compared(&[0.9999999999999999], &[]), Ordering::Less);
        assert_eq!(compared(&[0.5, 0.6], &[]), Ordering::Greater);
        assert_eq!(compared(&[], &[]), Ordering::Less);
    }

    #[test]
    fn what_was_written_decides() {
        let value = Exact::of(b"0.69999999999999996", 0.7).unwrap();
        let exact = [ExactBound { position: 1, end: End::Upper, value }];
        assert_eq!(compared(&[0.3, 0.7], &exact), Ordering::Less);
        assert_eq!(compared(&[0.3, 0.7], &[]), Ordering::Equal);
    }
}
