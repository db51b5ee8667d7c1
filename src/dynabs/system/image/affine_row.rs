//! The image in one coordinate that is an affine function of the state: exact, in integers.

use super::lattice::{LatticeAxis, LatticeRange};
use crate::system::Interval;
use imdp::numeric::Rational;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// `(lower + Σ_k slope_k i_k) / denominator` up to `(upper + …) / denominator`, in sub-cells, for the cell `i`.
#[derive(Clone, Debug)]
pub(super) struct AffineRow {
    denominator: i128,
    lower: i128,
    upper: i128,
    slopes: Vec<(usize, i128)>,
    /// Whether the upper end itself does not count: it is not attained, or noise moves it on.
    upper_open: bool,
}

/// An affine function of the cell's indices, in units of the state.
pub(super) struct AffineImage {
    /// Per coordinate that matters, how far the image moves from one cell to the next.
    pub(super) slopes: Vec<(usize, Rational)>,
    /// The image of cell 0: its lower and upper ends.
    pub(super) first: (Rational, Rational),
    /// Whether the upper end is not attained.
    pub(super) upper_open: bool,
}

/// Denominators and numerators beyond this many bits do not take part in exact integers.
const MAX_BITS: u64 = 90;

impl AffineRow {
    /// The row in the units of `axis`; `cells[k]` is the number of cells in dimension `k`. `None` if its
    /// numbers are too long for integers of 128 bits.
    pub(super) fn new(image: &AffineImage, axis: &LatticeAxis, cells: &[u32]) -> Option<Self> {
        let position = |x: &Rational| (x - &axis.origin) / &axis.pitch;
        let slopes: Vec<(usize, Rational)> =
            image.slopes.iter().map(|(k, slope)| (*k, slope / &axis.pitch)).collect();
        let (lower, upper) = (position(&image.first.0), position(&image.first.1));
        let of_slopes = slopes.iter().fold(BigInt::one(), |lcm, (_, slope)| lcm.lcm(slope.denom()));
        let mut denominator = of_slopes.lcm(lower.denom()).lcm(upper.denom());
        if denominator.bits() > MAX_BITS {
            // Ends that are no short fractions (of π, say) are rounded outward; slopes stay exact.
            let room = MAX_BITS.checked_sub(of_slopes.bits())?;
            denominator = of_slopes << room;
        }
        let scale = Rational::from_integer(denominator.clone());
        let lower = (lower * &scale).floor().to_integer();
        let upper = (upper * &scale).ceil().to_integer();
        let scaled: Option<Vec<(usize, i128)>> =
            slopes.iter().map(|(k, slope)| Some((*k, (slope * &scale).to_integer().to_i128()?))).collect();
        let reach = slopes.iter().fold(BigInt::zero(), |sum, (k, slope)| {
            sum + (slope * &scale).abs().to_integer() * BigInt::from(cells[*k])
        });
        if (lower.abs().max(upper.abs()) + reach).bits() > 120 {
            return None;
        }
        Some(Self {
            denominator: denominator.to_i128()?,
            lower: lower.to_i128()?,
            upper: upper.to_i128()?,
            slopes: scaled?,
            upper_open: image.upper_open || axis.noisy,
        })
    }

    /// The sub-cells that the image of a cell meets.
    pub(super) fn range(&self, cell: &[u32]) -> LatticeRange {
        let shift: i128 = self.slopes.iter().map(|&(k, slope)| slope * i128::from(cell[k])).sum();
        let (first, _) = self.position(self.lower + shift);
        let (last, on_face) = self.position(self.upper + shift);
        LatticeRange::new(first, if on_face && self.upper_open { last - 1 } else { last })
    }

    /// A position rounded down to an index, and whether it is an index itself.
    fn position(&self, numerator: i128) -> (i64, bool) {
        // Most rows have short numbers, which divide several times faster.
        let (quotient, rest) = match (i64::try_from(numerator), i64::try_from(self.denominator)) {
            (Ok(numerator), Ok(denominator)) => {
                let quotient = numerator.div_euclid(denominator);
                (i128::from(quotient), numerator == quotient * denominator)
            }
            _ => {
                let quotient = numerator.div_euclid(self.denominator);
                (quotient, numerator == quotient * self.denominator)
            }
        };
        let index = i64::try_from(quotient).unwrap_or(if quotient > 0 { i64::MAX } else { i64::MIN });
        (index, rest)
    }

    /// The coordinates that matter.
    pub(super) fn depends_on(&self) -> Vec<usize> {
        self.slopes.iter().map(|(k, _)| *k).collect()
    }
}

/// The ends of a bounded interval, as exact rationals.
pub(super) fn exact_ends(interval: Interval) -> Option<(Rational, Rational)> {
    Some((Rational::from_float(interval.lower())?, Rational::from_float(interval.upper())?))
}
