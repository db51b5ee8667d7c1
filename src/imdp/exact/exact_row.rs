//! The robust expectation of one row in exact arithmetic.
//!
//! The bounds of a row are rational (the shortest decimals that give the doubles, or what stands beside them), so over
//! a common denominator `D` they are integers. If the decimals admit no distribution because a rounding took it away, every bound
//! is read as any of the numbers that may have been rounded to it: `l (1 − 2⁻⁵³)` and `u (1 + 2⁻⁵³)`.
//!
//! `min_p p·V` is attained by the distribution that gives every successor its lower bound and pours what is
//! left, `1 − Σ l`, from the lowest value upwards, `u − l` each: moving mass from a lower value to a higher
//! one cannot help. For the maximum, from the highest value downwards.

use super::values::{ExactValues, SumOfProducts};
use crate::model::{End, Row, StateId};
use crate::numeric::{Rational, decimal_parts};
use num_bigint::{BigInt, BigUint};
use num_traits::{One, Zero};
use std::ops::{AddAssign, SubAssign};

/// Up to this power of ten, sums of numerators fit into 128 bits with room for 10⁸ successors.
const SMALL_SCALE: u32 = 30;

/// Numerators of probabilities.
pub(crate) trait Mass:
    Clone + Ord + Zero + Into<BigUint> + for<'a> AddAssign<&'a Self> + for<'a> SubAssign<&'a Self>
{
    /// The digits of 64 bits, the least significant first.
    fn digits(&self) -> impl Iterator<Item = u64>;
}

impl Mass for u128 {
    fn digits(&self) -> impl Iterator<Item = u64> {
        [*self as u64, (*self >> 64) as u64].into_iter()
    }
}

impl Mass for BigUint {
    fn digits(&self) -> impl Iterator<Item = u64> {
        self.iter_u64_digits()
    }
}

/// A row with exact bounds.
#[derive(Clone, Debug)]
pub(crate) enum ExactRow {
    Small(Numerators<u128>),
    Big(Numerators<BigUint>),
}

/// `l = lower/scale`, `u = (lower + room)/scale` and `1 − Σ l = slack/scale`.
#[derive(Clone, Debug)]
pub(crate) struct Numerators<M> {
    pub scale: M,
    pub lower: Vec<M>,
    pub room: Vec<M>,
    pub slack: M,
}

/// Which way nature pulls, and with it the order in which mass is poured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Nature {
    Min,
    Max,
}

impl ExactRow {
    /// `None` if no distribution fits, or a bound is not a number in `[0, 1]`.
    pub(crate) fn new(row: Row<'_>) -> Option<Self> {
        if !row.exact.is_empty() {
            return Self::of_rationals(row);
        }
        let parts = |bounds: &[f64]| -> Option<Vec<(u64, u32)>> {
            let part = |x: &f64| {
                let (digits, power) = decimal_parts(*x)?;
                Some((u64::try_from(digits).ok()?, u32::try_from(-power).unwrap_or(0)))
            };
            bounds.iter().map(part).collect()
        };
        let (lower, upper) = (parts(row.lower)?, parts(row.upper)?);
        let places = lower.iter().chain(&upper).map(|&(_, places)| places).max().unwrap_or(0);
        if places <= SMALL_SCALE {
            let scaled = |&(digits, own): &(u64, u32)| u128::from(digits) * 10u128.pow(places - own);
            let of = |parts: &[(u64, u32)]| parts.iter().map(scaled).collect();
            if let Some(row) = Numerators::new(10u128.pow(places), of(&lower), of(&upper)) {
                return Some(Self::Small(row));
            }
        }
        let ten = BigUint::from(10u8);
        let scaled = |&(digits, own): &(u64, u32)| BigUint::from(digits) * ten.pow(places - own);
        let (lower, upper): (Vec<BigUint>, Vec<BigUint>) =
            (lower.iter().map(scaled).collect(), upper.iter().map(scaled).collect());
        let scale = ten.pow(places);
        Numerators::new(scale.clone(), lower.clone(), upper.clone())
            .or_else(|| widened(scale, lower, upper))
            .map(Self::Big)
    }

    /// A row with bounds that are not the shortest decimals of their doubles, over their common denominator.
    fn of_rationals(row: Row<'_>) -> Option<Self> {
        let bounds = |end| (0..row.len()).map(|i| row.rational(end, i)).collect::<Vec<_>>();
        let (lower, upper) = (bounds(End::Lower), bounds(End::Upper));
        let denominators = lower.iter().chain(&upper).map(|bound| bound.denom().magnitude());
        let scale = denominators.fold(BigUint::one(), common_multiple);
        let scaled = |bound: &Rational| {
            bound.numer().to_biguint().map(|numer| numer * (&scale / bound.denom().magnitude()))
        };
        let scaled = |bounds: &[Rational]| bounds.iter().map(scaled).collect::<Option<Vec<_>>>();
        let (lower, upper) = (scaled(&lower)?, scaled(&upper)?);
        Numerators::new(scale, lower, upper).map(Self::Big)
    }

    /// The bounds over their common denominator.
    pub(crate) fn into_numerators(self) -> Numerators<BigUint> {
        match self {
            Self::Small(Numerators { scale, lower, room, slack }) => Numerators {
                scale: scale.into(),
                lower: lower.into_iter().map(BigUint::from).collect(),
                room: room.into_iter().map(BigUint::from).collect(),
                slack: slack.into(),
            },
            Self::Big(row) => row,
        }
    }

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

/// The least common multiple of two denominators.
pub(crate) fn common_multiple(a: BigUint, b: &BigUint) -> BigUint {
    if (&a % b).is_zero() {
        return a;
    }
    // `a/b` in lowest terms has the denominator `b / gcd(a, b)`.
    let reduced = Rational::new(a.clone().into(), b.clone().into());
    a * reduced.denom().magnitude()
}

/// The row whose bounds are all numbers that may have been rounded to the given ones.
fn widened(scale: BigUint, lower: Vec<BigUint>, upper: Vec<BigUint>) -> Option<Numerators<BigUint>> {
    let unit = BigUint::one() << 53;
    let wide: BigUint = &scale * &unit;
    let (less, more): (BigUint, BigUint) = (&unit - 1u8, &unit + 1u8);
    let below = lower.into_iter().map(|l| l * &less).collect();
    let above = upper.into_iter().map(|u| (u * &more).min(wide.clone())).collect();
    Numerators::new(wide, below, above)
}

impl<M: Mass> Numerators<M> {
    /// `None` unless `Σ l ≤ 1 ≤ Σ u` and `l ≤ u`.
    fn new(scale: M, lower: Vec<M>, upper: Vec<M>) -> Option<Self> {
        let total = |masses: &[M]| {
            masses.iter().fold(M::zero(), |mut sum, mass| {
                sum += mass;
                sum
            })
        };
        let sum = total(&lower);
        if sum > scale || total(&upper) < scale || lower.iter().zip(&upper).any(|(l, u)| l > u) {
            return None;
        }
        let mut slack = scale.clone();
        slack -= &sum;
        let mut room = upper;
        room.iter_mut().zip(&lower).for_each(|(room, l)| *room -= l);
        Some(Self { scale, lower, room, slack })
    }

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
