//! The lattice on which images land.

use crate::partition::Grid;
use crate::system::Interval;
use imdp::numeric::Rational;
use num_traits::ToPrimitive;

/// The lattice of sub-cells: cells of a partition cut into `r_j` equal parts, continued over all of space.
///
/// Sub-cell `i` of dimension `j` is `[lower_j + i δ_j, lower_j + (i+1) δ_j)` with `δ_j = w_j / r_j`.
#[derive(Clone, Debug)]
pub struct Lattice {
    axes: Vec<LatticeAxis>,
}

/// One dimension of a [`Lattice`].
#[derive(Clone, Debug)]
pub(super) struct LatticeAxis {
    pub(super) origin: Rational,
    pub(super) pitch: Rational,
    /// Whether sub-cells may count as closed, because noise moves every point on a face off it.
    pub(super) noisy: bool,
    origin_enclosure: Interval,
    pitch_enclosure: Interval,
}

/// The sub-cells `first, …, last` of one dimension, neither wrapped nor clipped to the partition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LatticeRange {
    /// The lowest index.
    pub first: i64,
    /// The highest index.
    pub last: i64,
}

/// Indices beyond this are as good as infinite; sums of two stay inside `i64`.
const FAR: i64 = 1 << 60;

impl LatticeRange {
    /// All indices.
    pub const EVERYTHING: Self = Self { first: -FAR, last: FAR };

    /// From `first` to `last`, at least `first` itself.
    pub(super) fn new(first: i64, last: i64) -> Self {
        let first = first.clamp(-FAR, FAR);
        Self { first, last: last.clamp(first, FAR) }
    }

    /// The number of sub-cells.
    pub fn count(self) -> u64 {
        (self.last - self.first) as u64 + 1
    }

    /// Whether every index of `other` is one of this.
    pub fn encloses(self, other: Self) -> bool {
        self.first <= other.first && other.last <= self.last
    }
}

impl Lattice {
    /// The lattice with `resolution[j]` sub-cells a cell in dimension `j`.
    ///
    /// `noisy[j]` says that noise with half-open lattice boxes is added in dimension `j`. Then a point on the
    /// upper face of sub-cell `i` may be counted there: `(i+1)δ + [kδ, (k+1)δ)` is sub-cell `i+k+1`, one of
    /// the two that noise box `k` takes sub-cell `i` to.
    pub fn new(grid: &Grid, resolution: &[u32], noisy: &[bool]) -> Self {
        let axes = grid.axes().iter().zip(resolution).zip(noisy).map(|((axis, &parts), &noisy)| {
            let pitch = axis.width() / Rational::from_integer(parts.max(1).into());
            LatticeAxis {
                origin_enclosure: Interval::of_rational(axis.lower()),
                pitch_enclosure: Interval::of_rational(&pitch),
                origin: axis.lower().clone(),
                pitch,
                noisy,
            }
        });
        Self { axes: axes.collect() }
    }

    pub(super) fn axis(&self, j: usize) -> &LatticeAxis {
        &self.axes[j]
    }
}

impl LatticeAxis {
    /// The sub-cells that an interval meets.
    pub(super) fn range(&self, interval: Interval) -> LatticeRange {
        if !interval.is_bounded() {
            return LatticeRange::EVERYTHING;
        }
        let position = (interval - self.origin_enclosure) / self.pitch_enclosure;
        let (Some(first), Some(last)) =
            (position.lower().floor().to_i64(), position.upper().floor().to_i64())
        else {
            return LatticeRange::EVERYTHING;
        };
        let on_face = position.upper() == position.upper().floor();
        LatticeRange::new(first, if self.noisy && on_face { last - 1 } else { last })
    }
}
