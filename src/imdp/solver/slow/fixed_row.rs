//! Rows in fixed point, and their expectations with a known error.

use super::super::expectation::Bound;
use super::super::query::Direction;
use super::fixed::{ONE, SumOfProducts, floor};
use super::ways_out::Leads;
use crate::model::{End, Row};

/// A row with bounds in fixed point: lower ones rounded down, upper ones up.
///
/// So it allows every distribution of the true row and perhaps a few more. As each bound moves by less than a unit,
/// mass of at most as many units as there are successors moves, and an expectation of values in `[0, 1]` by no more.
#[derive(Debug)]
pub(super) struct FixedRow {
    /// Whose values the successors have, as positions in a list of values.
    pub targets: Vec<u32>,
    lower: Vec<u128>,
    room: Vec<u128>,
    slack: u128,
}

impl FixedRow {
    /// `None` if the bounds admit no distribution when taken exactly.
    pub(super) fn new(row: Row<'_>, targets: Vec<u32>) -> Option<Self> {
        let (mut lower, mut room) = (Vec::with_capacity(row.len()), Vec::with_capacity(row.len()));
        let (mut least, mut most) = (0u128, 0u128);
        for i in 0..row.len() {
            let (below, _) = floor(&row.rational(End::Lower, i))?;
            let (above, exact) = floor(&row.rational(End::Upper, i))?;
            let above = above + u128::from(!exact);
            (least, most) = (least + below, most + above);
            lower.push(below);
            room.push(above.checked_sub(below)?);
        }
        (most >= ONE).then_some(())?;
        Some(Self { targets, lower, room, slack: ONE.checked_sub(least)? })
    }

    /// All mass on one value.
    pub(super) fn certain(target: u32) -> Self {
        Self { targets: vec![target], lower: vec![ONE], room: vec![0], slack: 0 }
    }

    /// A distribution, in units, that attains the optimum over values.
    pub(super) fn respond<V: Ord>(&self, values: &[V], nature: Direction) -> Vec<u128> {
        let mut order: Vec<usize> = (0..self.targets.len()).collect();
        order.sort_by(|&i, &j| values[self.targets[i] as usize].cmp(&values[self.targets[j] as usize]));
        if nature == Direction::Max {
            order.reverse();
        }
        let mut masses = self.lower.clone();
        let mut left = self.slack;
        for i in order {
            let poured = self.room[i].min(left);
            masses[i] += poured;
            left -= poured;
        }
        masses
    }

    /// `p·V` for masses of [`respond`](Self::respond).
    pub(super) fn expectation(&self, masses: &[u128], values: &[u128]) -> SumOfProducts {
        let mut sum = SumOfProducts::default();
        self.targets.iter().zip(masses).for_each(|(&target, &mass)| sum.add(mass, values[target as usize]));
        sum
    }

    /// A bound on the optimum over the true row.
    pub(super) fn bound(&self, values: &[u128], nature: Direction, side: Bound) -> u128 {
        let sum = self.expectation(&self.respond(values, nature), values);
        // More freedom than the true row has moves the optimum towards nature.
        let error = self.targets.len() as u128;
        match (side, nature) {
            (Bound::Lower, Direction::Min) => sum.floor(),
            (Bound::Lower, Direction::Max) => sum.floor().saturating_sub(error),
            (Bound::Upper, Direction::Min) => (sum.ceil() + error).min(ONE),
            (Bound::Upper, Direction::Max) => sum.ceil().min(ONE),
        }
    }
}

impl Leads for FixedRow {
    fn targets(&self) -> &[u32] {
        &self.targets
    }

    fn hits(&self, nature: Direction, inside: impl Fn(u32) -> bool) -> bool {
        let entries = || self.targets.iter().zip(&self.lower).zip(&self.room);
        match nature {
            Direction::Min => {
                let positive = entries().any(|((t, l), _)| inside(*t) && *l > 0);
                let outside: u128 =
                    entries().filter(|((t, _), _)| !inside(**t)).map(|((_, l), r)| l + r).sum();
                positive || outside < ONE
            }
            Direction::Max => {
                let possible = entries().any(|((t, l), r)| inside(*t) && l + r > 0);
                let outside: u128 = entries().filter(|((t, _), _)| !inside(**t)).map(|((_, l), _)| l).sum();
                possible && outside < ONE
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::fixed::to_rational;
    use super::*;
    use crate::exact::{ExactValues, Nature, Replaced};
    use crate::model::ExactRow;
    use crate::model::StateId;
    use crate::numeric::{Rational, from_decimal};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn bounds_enclose_the_exact_expectation(
            entries in prop::collection::vec((0u32..=1000, 0u32..=1000, 0.0f64..=1.0), 2..7),
        ) {
            // Thousandths, so that decimals and fixed point differ.
            let size = entries.len() as u32;
            let third = |n: u32| f64::from(n / size) / 1000.0;
            let lower: Vec<f64> = entries.iter().map(|e| third(e.0)).collect();
            let upper: Vec<f64> = entries.iter().zip(&lower).map(|(e, l)| (l + f64::from(e.1) / 1000.0).min(1.0)).collect();
            let successors: Vec<StateId> = StateId::first(entries.len()).collect();
            let row = Row { successors: &successors, lower: &lower, upper: &upper, exact: &[] };
            let total: Rational = upper.iter().map(|&u| from_decimal(u).unwrap()).sum();
            prop_assume!(total >= from_decimal(1.0).unwrap());
            let doubles: Vec<f64> = entries.iter().map(|e| e.2).collect();
            let fixed: Vec<u128> = doubles.iter().map(|&x| super::super::fixed::floor_f64(x)).collect();
            prop_assume!(doubles.iter().zip(&fixed).all(|(&x, &f)| super::super::fixed::to_f64_down(f) == x));
            let exact = ExactRow::new(row).unwrap();
            let fixed_row = FixedRow::new(row, (0..size).collect()).unwrap();
            for (nature, optimum) in [(Nature::Min, Direction::Min), (Nature::Max, Direction::Max)] {
                let value = exact.expectation(&successors, &ExactValues::with(&doubles, &Replaced::new()), nature);
                let value = Rational::new(value.numer().clone(), value.denom().clone());
                let (low, high) =
                    (fixed_row.bound(&fixed, optimum, Bound::Lower), fixed_row.bound(&fixed, optimum, Bound::Upper));
                prop_assert!(to_rational(low) <= value && value <= to_rational(high));
                prop_assert!(high - low <= 3 * u128::from(size) + 2);
            }
        }
    }
}
