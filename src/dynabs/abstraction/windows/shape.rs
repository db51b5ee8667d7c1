//! The center and the proportions of nested boxes.

use super::super::cell_box::CellBox;
use super::super::placement::Placement;
use super::super::room::{RUNGS, Room};
use super::farther;
use crate::noise::{NoiseSample, NoiseSamples};
use crate::partition::Grid;
use imdp::numeric::{UNIT_ROUNDOFF, to_f64};

/// A mean this many standard errors away from 0 is taken for the center, if this many samples say so.
const CLEARLY_OFF_CENTER: (f64, usize) = (3.0, 8);

/// The least half-width, in cells: noise far below a cell stays in it, and some width there must be.
const LEAST_PROPORTION: f64 = 1.0 / 16.0;

/// The boxes `{x : |x_j − c_j| ≤ t h_j}`; `h_j` is positive, and infinite where nothing matters.
#[derive(Clone, Debug)]
pub(super) struct Shape {
    center: Vec<f64>,
    half: Vec<f64>,
}

impl Shape {
    /// Half-widths are the standard deviations of these `members` of the samples, but at least a sixteenth of a cell; the
    /// center is 0 unless the mean clearly lies elsewhere.
    pub(super) fn learn(samples: &NoiseSamples, members: &[usize], grid: &Grid, matters: &[bool]) -> Self {
        let number = members.len() as f64;
        let (mut center, mut half) = (vec![], vec![]);
        for (j, axis) in grid.axes().iter().enumerate() {
            let values = || members.iter().map(|&i| samples.sample(i)[j]);
            let mean = values().sum::<f64>() / number;
            let squares = values().map(|x| (x - mean) * (x - mean)).sum::<f64>();
            let error = (squares / (number * (number - 1.0))).sqrt();
            let is_off = members.len() >= CLEARLY_OFF_CENTER.1 && mean.abs() > CLEARLY_OFF_CENTER.0 * error;
            // Sums may overflow, and are no numbers if there are too few samples.
            let is_known = mean.is_finite() && squares.is_finite();
            center.push(if is_off && is_known { mean } else { 0.0 });
            let least = (LEAST_PROPORTION * to_f64(axis.width())).max(f64::MIN_POSITIVE);
            let deviation = if is_known { (squares / (number - 1.0)).sqrt() } else { least };
            half.push(if matters[j] { least.max(deviation) } else { f64::INFINITY });
        }
        Self { center, half }
    }

    /// The distance of the farthest of these cells.
    pub(super) fn distance_of_cells(&self, spread: &CellBox, placement: &Placement) -> f64 {
        let along = |j: usize, o| placement.distance(j, o, self.center[j]) / self.half[j];
        (0..self.half.len()).fold(0.0, |distance, j| {
            farther(distance, farther(along(j, spread.lower[j]), along(j, spread.upper[j])))
        })
    }

    /// The distance of noise, at most; rounded to nearest.
    pub(super) fn distance(&self, noise: NoiseSample<'_>) -> f64 {
        let along = |j: usize| ((noise.value(j) - self.center[j]).abs() + noise.error(j)) / self.half[j];
        (0..self.half.len()).fold(0.0, |distance, j| farther(distance, along(j)))
    }

    /// The cells that are at most this far.
    pub(super) fn cells_within(&self, reach: f64, placement: &Placement) -> CellBox {
        let mut cells = placement.spread(NoiseSample::exact(&self.center));
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

    /// The lower and the upper corner of a room; infinite where it has no limit.
    pub(super) fn room(&self, room: Room) -> (Vec<f64>, Vec<f64>) {
        let side = |rung: usize, j: usize| {
            let (lower, upper) = self.sides(RUNGS[rung]);
            (lower[j], upper[j])
        };
        let limits = |j: usize| {
            let lower = room.limit(2 * j).map_or(f64::NEG_INFINITY, |rung| side(rung, j).0);
            (lower, room.limit(2 * j + 1).map_or(f64::INFINITY, |rung| side(rung, j).1))
        };
        (0..self.half.len()).map(limits).unzip()
    }

    /// The lower and the upper corner of the box that reaches this far.
    pub(super) fn sides(&self, reach: f64) -> (Vec<f64>, Vec<f64>) {
        // Distances are rounded four times and so are the sides; twice as much covers both.
        let sides = |j: usize| {
            let (c, h) = (self.center[j], self.half[j]);
            let half = reach * h + 16.0 * UNIT_ROUNDOFF * (c.abs() + reach * h);
            if half.is_finite() { (c - half, c + half) } else { (f64::NEG_INFINITY, f64::INFINITY) }
        };
        (0..self.half.len()).map(sides).unzip()
    }
}
