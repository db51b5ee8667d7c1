//! Which cells a row lists: nested boxes around the target, and how much may lie outside them.
//!
//! The boxes `{η : |η_j − c_j| ≤ t h_j for all j}` have one parameter `t`. Their center `c` and proportions `h`
//! are learned from the first few samples, their size from all others, so that given the first ones the family
//! is fixed. With the `j` farthest of `N` samples left out, `t` is the `(j+1)`-th largest distance, and
//!
//! `P(η outside) ≤ ε_j`, where `Σ_{i≤j} C(N,i) ε_jⁱ (1 − ε_j)^{N−i} = level`,
//!
//! except with probability `level`, whatever the distribution: the mass beyond the `(j+1)`-th largest of `N` numbers
//! is stochastically at most `Beta(j+1, N−j)` (Wilks, *Ann. Math. Stat.* 12, 1941). For `j = 0` this is
//! `ε = 1 − level^{1/N}`; a bounding box in `ℝⁿ`, with its `2n` free sides, would have to pay for `j = 2n − 1`.
//!
//! Where all targets sit alike in their cells, distance is measured in whole cells (that of a cell is the least
//! distance of its points): the boxes grow by one layer of cells at a time, and what a sample needs of the
//! last layer in one dimension does not make the others any longer.

use super::landing::Spread;
use super::placement::Placement;
use crate::noise::NoiseSamples;
use crate::partition::Grid;
use crate::statistics::upper_bound;
use imdp::numeric::{UNIT_ROUNDOFF, to_f64};

/// At most this many samples decide about the proportions: enough for their order of magnitude.
const SHAPE_SAMPLES: usize = 48;

/// And at most this part of all samples.
const SHAPE_PART: usize = 16;

/// A mean this many standard errors away from 0 is taken for the center, if this many samples say so.
const CLEARLY_OFF_CENTER: (f64, usize) = (3.0, 8);

/// The least half-width, in cells: noise far below a cell stays in it, and some width there must be.
const LEAST_PROPORTION: f64 = 1.0 / 16.0;

/// The center and the proportions of nested boxes.
#[derive(Clone, Debug)]
pub(super) struct Shape {
    center: Vec<f64>,
    half: Vec<f64>,
    /// How many of the first samples it was learned from: the others are independent of it.
    samples: usize,
}

/// Nested boxes, the largest first, and bounds on the mass outside them.
#[derive(Clone, Debug)]
pub(super) struct Windows {
    shape: Shape,
    /// Whether distance is measured in whole cells.
    of_cells: bool,
    reaches: Vec<f64>,
    /// Per window, the bound on the mass outside.
    unseen: Vec<f64>,
}

/// How many of `samples` samples decide about the proportions.
pub(super) fn shape_samples(samples: usize) -> usize {
    SHAPE_SAMPLES.min(samples / SHAPE_PART)
}

impl Shape {
    /// Half-widths are the standard deviations, but at least a sixteenth of a cell; the center is 0 unless the mean clearly
    /// lies elsewhere.
    pub(super) fn learn(samples: &NoiseSamples, grid: &Grid) -> Self {
        let used = shape_samples(samples.len());
        let number = used as f64;
        let (mut center, mut half) = (vec![], vec![]);
        for (j, axis) in grid.axes().iter().enumerate() {
            let values = || samples.iter().take(used).map(|sample| sample[j]);
            let mean = values().sum::<f64>() / number;
            let squares = values().map(|x| (x - mean) * (x - mean)).sum::<f64>();
            let error = (squares / (number * (number - 1.0))).sqrt();
            let is_off = used >= CLEARLY_OFF_CENTER.1 && mean.abs() > CLEARLY_OFF_CENTER.0 * error;
            let middle = if is_off { mean } else { 0.0 };
            let least = LEAST_PROPORTION * to_f64(axis.width());
            let deviation = (squares / (number - 1.0)).sqrt();
            // Not a number if there are too few samples.
            half.push(least.max(deviation));
            center.push(middle);
        }
        Self { center, half, samples: used }
    }

    /// The distance of the farthest of these cells.
    fn distance_of_cells(&self, spread: &Spread, placement: &Placement) -> f64 {
        let along = |j: usize, o| placement.distance(j, o, self.center[j]) / self.half[j];
        (0..self.half.len())
            .map(|j| along(j, spread.lower[j]).max(along(j, spread.upper[j])))
            .fold(0.0, f64::max)
    }

    fn distance_of_point(&self, noise: &[f64]) -> f64 {
        let along = |j: usize| (noise[j] - self.center[j]).abs() / self.half[j];
        (0..self.half.len()).map(along).fold(0.0, f64::max)
    }

    /// The cells that are at most this far.
    fn cells_within(&self, reach: f64, placement: &Placement) -> Spread {
        let mut cells = placement.spread(&self.center);
        for j in 0..self.half.len() {
            let is_within = |o| placement.distance(j, o, self.center[j]) / self.half[j] <= reach;
            let (lowest, highest) = placement.extent(j);
            while cells.lower[j] > lowest && is_within(cells.lower[j] - 1) {
                cells.lower[j] -= 1;
            }
            while cells.upper[j] < highest && is_within(cells.upper[j] + 1) {
                cells.upper[j] += 1;
            }
        }
        cells
    }

    /// The cells met by the box that reaches this far.
    fn cells_met(&self, reach: f64, placement: &Placement) -> Spread {
        // Distances are rounded three times and so are the sides; twice as much covers both.
        let side = |j: usize, sign: f64| {
            let (c, h) = (self.center[j], self.half[j]);
            c + sign * (reach * h + 16.0 * UNIT_ROUNDOFF * (c.abs() + reach * h))
        };
        let sides = |sign| (0..self.half.len()).map(|j| side(j, sign)).collect::<Vec<_>>();
        placement.spread_of_box(&sides(-1.0), &sides(1.0))
    }
}

impl Windows {
    /// Windows that leave out the `discard`, `discard + 1`, … farthest samples; `levels` are those of their events.
    ///
    /// With a `shared` placement distance is measured in its cells.
    pub(super) fn new(
        samples: &NoiseSamples,
        shape: Shape,
        shared: Option<&Placement>,
        discard: usize,
        levels: &[f64],
    ) -> Self {
        let distance = |noise: &[f64]| match shared {
            Some(placement) => shape.distance_of_cells(&placement.spread(noise), placement),
            None => shape.distance_of_point(noise),
        };
        let mut distances: Vec<f64> = samples.iter().skip(shape.samples).map(distance).collect();
        distances.sort_by(|a, b| b.total_cmp(a));
        let number = distances.len() as u64;
        let mut windows = Self { of_cells: shared.is_some(), reaches: vec![], unseen: vec![], shape };
        for (rank, &level) in (discard..).zip(levels) {
            let Some(&reach) = distances.get(rank) else { break };
            windows.reaches.push(reach);
            windows.unseen.push(upper_bound(rank as u64, number, level));
        }
        windows
    }

    /// The cells of every window.
    pub(super) fn cells(&self, placement: &Placement) -> Vec<Spread> {
        let cells = |&reach: &f64| {
            if self.of_cells {
                self.shape.cells_within(reach, placement)
            } else {
                self.shape.cells_met(reach, placement)
            }
        };
        self.reaches.iter().map(cells).collect()
    }

    /// Per window, a bound on the mass outside; the largest window first.
    pub(super) fn unseen(&self) -> &[f64] {
        &self.unseen
    }
}
