//! The robust expectation of one row in exact arithmetic.
//!
//! `min_p p·V` is attained by the distribution that gives every successor its lower bound and pours what is
//! left, `1 − Σ l`, from the lowest value upwards, `u − l` each: moving mass from a lower value to a higher
//! one cannot help. For the maximum, from the highest value downwards.

use super::values::{ExactValues, SumOfProducts};
use crate::model::{ExactRow, Mass, Numerators, StateId};
use crate::numeric::Rational;
use num_bigint::{BigInt, BigUint};

/// Which way nature pulls, and with it the order in which mass is poured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Nature {
    Min,
    Max,
}

impl ExactRow {
    /// `min_p p·V` or `max_p p·V`.
    pub(crate) fn expectation(
        &self,
        successors: &[StateId],
        values: &ExactValues<'_>,
        nature: Nature,
    ) -> Rational {
        match self {
            Self::Small(row) => row.expectation(successors, values, nature),
            Self::Big(row) => row.expectation(successors, values, nature),
        }
    }

    /// The successors to which some distribution that attains `max_p p·V` gives positive probability.
    pub(crate) fn maximal_support(&self, successors: &[StateId], values: &ExactValues<'_>) -> Vec<bool> {
        match self {
            Self::Small(row) => row.maximal_support(successors, values),
            Self::Big(row) => row.maximal_support(successors, values),
        }
    }

    /// The least `k` such that every distribution gives successors of a rank below `k` positive probability.
    ///
    /// That is `max(Σ_{rank<k} l, 1 − Σ_{rank≥k} u) > 0`.
    pub(crate) fn certain_rank(&self, successors: &[StateId], rank: impl Fn(StateId) -> u32) -> u64 {
        match self {
            Self::Small(row) => row.certain_rank(successors, rank),
            Self::Big(row) => row.certain_rank(successors, rank),
        }
    }
}

impl<M: Mass> Numerators<M> {
    fn expectation(&self, successors: &[StateId], values: &ExactValues<'_>, nature: Nature) -> Rational {
        let mut left = self.slack.clone();
        let mut sum = SumOfProducts::default();
        for i in order(successors, values, nature) {
            let poured = if self.room[i] < left { self.room[i].clone() } else { left.clone() };
            left -= &poured;
            let mut mass = self.lower[i].clone();
            mass += &poured;
            sum.add(mass.digits(), values.numerator(successors[i]));
        }
        let scale: BigUint = self.scale.clone().into();
        Rational::new_raw(BigInt::from(sum.total()), BigInt::from(values.denominator_times(scale)))
    }

    fn maximal_support(&self, successors: &[StateId], values: &ExactValues<'_>) -> Vec<bool> {
        let mut left = self.slack.clone();
        let mut support = vec![false; successors.len()];
        let order = order(successors, values, Nature::Max);
        // Equal values share what is left in any way.
        for equal in order.chunk_by(|&i, &j| values.compare(successors[i], successors[j]).is_eq()) {
            for &i in equal {
                support[i] = !self.lower[i].is_zero() || (!self.room[i].is_zero() && !left.is_zero());
            }
            for &i in equal {
                let poured = if self.room[i] < left { self.room[i].clone() } else { left.clone() };
                left -= &poured;
            }
        }
        support
    }

    fn certain_rank(&self, successors: &[StateId], rank: impl Fn(StateId) -> u32) -> u64 {
        let mut order: Vec<(u32, usize)> = successors.iter().zip(0..).map(|(&s, i)| (rank(s), i)).collect();
        order.sort_unstable();
        // What can be kept away from the ranks seen so far.
        let mut above = M::zero();
        for i in 0..successors.len() {
            above += &self.lower[i];
            above += &self.room[i];
        }
        for equal in order.chunk_by(|a, b| a.0 == b.0) {
            for &(_, i) in equal {
                above -= &self.lower[i];
                above -= &self.room[i];
            }
            if equal.iter().any(|&(_, i)| !self.lower[i].is_zero()) || above < self.scale {
                return u64::from(equal[0].0) + 1;
            }
        }
        u64::MAX
    }
}

/// Positions in the order in which nature pours.
fn order(successors: &[StateId], values: &ExactValues<'_>, nature: Nature) -> Vec<usize> {
    let mut order: Vec<usize> = (0..successors.len()).collect();
    let compare = |i: usize, j: usize| values.compare(successors[i], successors[j]);
    match nature {
        Nature::Min => order.sort_unstable_by(|&i, &j| compare(i, j)),
        Nature::Max => order.sort_unstable_by(|&i, &j| compare(j, i)),
    }
    order
}

#[cfg(test)]
mod tests {
    use super::super::values::Replaced;
    use super::*;
    use crate::model::Row;
    use crate::numeric::from_decimal;

    fn exact_values(doubles: &[f64]) -> ExactValues<'_> {
        ExactValues::with(doubles, &Replaced::new())
    }

    fn row(bounds: &[(f64, f64)]) -> Option<ExactRow> {
        let successors: Vec<StateId> = StateId::first(bounds.len()).collect();
        let (lower, upper): (Vec<f64>, Vec<f64>) = bounds.iter().copied().unzip();
        ExactRow::new(Row { successors: &successors, lower: &lower, upper: &upper, exact: &[] })
    }

    fn expectation(bounds: &[(f64, f64)], values: &[f64], nature: Nature) -> Rational {
        let successors: Vec<StateId> = StateId::first(bounds.len()).collect();
        let found = row(bounds).unwrap().expectation(&successors, &exact_values(values), nature);
        Rational::new(found.numer().clone(), found.denom().clone())
    }

    #[test]
    fn mass_is_poured_from_one_end() {
        let bounds = [(0.1, 0.4), (0.2, 0.7), (0.0, 0.3)];
        let values = [0.5, 0.0, 1.0];
        let exact = |text: f64| from_decimal(text).unwrap();
        assert_eq!(expectation(&bounds, &values, Nature::Min), exact(0.15));
        assert_eq!(expectation(&bounds, &values, Nature::Max), exact(0.5));
        // The same with denominators beyond 128 bits.
        let bounds = [(0.1, 0.4), (0.2, 0.7), (1e-300, 0.3)];
        // State 2 takes 1e-300 from state 0, whose value is 0.5.
        assert_eq!(expectation(&bounds, &values, Nature::Min), exact(0.15) + exact(5e-301));
    }

    #[test]
    fn thirds_are_what_was_rounded_to_them() {
        // Neither as decimals nor as doubles do they reach 1.
        let third = 0.3333333333333333;
        let found = expectation(&[(third, third); 3], &[1.0, 0.0, 0.0], Nature::Max);
        let exact = from_decimal(third).unwrap();
        assert!(found > exact && found < exact + from_decimal(1e-16).unwrap());
        assert!(row(&[(0.3333333333333334, 0.5); 3]).is_none());
        assert!(row(&[(0.0, 0.5), (0.0, 0.4)]).is_none());
    }

    #[test]
    fn supports_of_maxima_share_ties() {
        let successors = [0, 1, 2, 3].map(StateId);
        let row = row(&[(0.0, 0.5), (0.0, 0.5), (0.0, 1.0), (0.1, 0.1)]).unwrap();
        assert_eq!(
            row.maximal_support(&successors, &exact_values(&[0.5, 1.0, 0.5, 0.0])),
            [true, true, true, true]
        );
        assert_eq!(
            row.maximal_support(&successors, &exact_values(&[1.0, 1.0, 0.5, 0.0])),
            [true, true, false, true]
        );
        assert_eq!(row.maximal_support(&successors, &exact_values(&[0.0; 4])), [true; 4]);
    }

    #[test]
    fn ranks_that_nature_cannot_avoid() {
        // 0.4 + 0.6 may stay at ranks 2 and 3; with less room than that it cannot.
        let successors = [0, 1, 2].map(StateId);
        let rank = |s: StateId| [3, 2, 1][s.index()];
        assert_eq!(row(&[(0.0, 0.4), (0.0, 0.6), (0.0, 1.0)]).unwrap().certain_rank(&successors, rank), 3);
        assert_eq!(row(&[(0.0, 0.4), (0.0, 0.5), (0.0, 1.0)]).unwrap().certain_rank(&successors, rank), 2);
        assert_eq!(row(&[(0.0, 0.4), (0.0, 0.6), (0.1, 1.0)]).unwrap().certain_rank(&successors, rank), 2);
        assert_eq!(row(&[(1.0, 1.0), (0.0, 0.6), (0.0, 1.0)]).unwrap().certain_rank(&successors, rank), 4);
    }
}
