//! The bounds of one row in exact arithmetic.
//!
//! The bounds of a row are rational (the shortest decimals that give the doubles, or what stands beside them), so over
//! a common denominator `D` they are integers. If the decimals admit no distribution because a rounding took it away, every bound
//! is read as any of the numbers that may have been rounded to it: `l (1 − 2⁻⁵³)` and `u (1 + 2⁻⁵³)`.

use super::{End, Row};
use crate::numeric::{Rational, common_multiple, decimal_parts};
use num_bigint::BigUint;
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
}
