//! What can be expected if noise is what it mostly is: a measure of designs that no sample has a part in.
//!
//! *Nominal* noise `ν` moves every coordinate by one cell up, or down, with probability [`SIDEWAYS`] each and independently. With
//! patience `γ ≤ 1` values are
//!
//! `v(s) = γ · max { Σ_o ν(o) v(cell(d_a) + o) : a enabled in s }`,
//!
//! 1 in goal cells, 0 in unsafe ones and outside; for a task to stay, `1 − γ` is added for every step that is done.

use super::enabled::EnabledActions;
use super::targets::Targets;
use crate::partition::{CellId, CellKind, Grid, GridAxis};
use crate::problem::{Problem, TargetId};
use crate::task::Aim;
use imdp::model::RowRange;
use imdp::progress::Progress;
use rayon::prelude::*;

/// How likely nominal noise moves a coordinate by a cell to either side.
const SIDEWAYS: f64 = 0.1;

/// Values that change by less than this part of them are settled.
const SETTLED: f64 = 1e-4;

/// Nominal noise on the cells of a problem.
pub(super) struct Nominal<'a> {
    problem: &'a Problem,
    /// Per target, its cell, if that is in the partition.
    landing: Vec<Option<usize>>,
    patience: f64,
    /// How many steps are looked at, at most.
    pub(super) steps: u64,
}

impl<'a> Nominal<'a> {
    /// For these targets, with this patience, and so many steps at most.
    pub(super) fn new(problem: &'a Problem, targets: &Targets, patience: f64, steps: u64) -> Self {
        let landing = targets.ids().map(|target| landing(problem.grid(), targets, target)).collect();
        Self { problem, landing, patience, steps }
    }

    /// How many numbers are looked at for values with these actions.
    pub(super) fn work(&self, actions: &EnabledActions) -> u64 {
        let per_cell = self.problem.grid().dimension() as u64 + 2;
        let cells = u64::from(self.problem.grid().num_cells()).saturating_mul(per_cell);
        let targets = self.landing.len() as u64 * (1 + Highest::levels_above(actions) as u64);
        cells.saturating_add(targets + actions.ranges.len() as u64).saturating_mul(self.steps)
    }

    /// The value of every cell of the partition, with these actions enabled in `cells`.
    pub(super) fn values(
        &self,
        cells: &[CellId],
        actions: &EnabledActions,
        progress: &dyn Progress,
    ) -> Vec<f64> {
        let starts = actions.starts();
        let ranges = |i: usize| &actions.ranges[starts[i]..starts[i + 1]];
        let stays = self.problem.worst_task().aim() == Aim::Stay;
        let at_first = |(_, kind)| kind == CellKind::Goal || (stays && kind == CellKind::Ordinary);
        let mut values: Vec<f64> =
            self.problem.labels().iter().map(|cell| if at_first(cell) { 1.0 } else { 0.0 }).collect();
        let reward = if stays { 1.0 - self.patience } else { 0.0 };
        for _ in 0..self.steps {
            let worth = Highest::new(self.worth(&values), actions);
            let next: Vec<f64> = (0..cells.len())
                .into_par_iter()
                .map(|i| reward + self.patience * worth.of(ranges(i)))
                .collect();
            let is_settled =
                |(cell, next): (&CellId, &f64)| (next - values[cell.index()]).abs() <= SETTLED * next;
            let settled = cells.iter().zip(&next).all(is_settled);
            cells.iter().zip(next).for_each(|(cell, next)| values[cell.index()] = next);
            progress.advance(1);
            if settled {
                break;
            }
        }
        values
    }

    /// What it is worth to steer to every target.
    pub(super) fn worth(&self, values: &[f64]) -> Vec<f64> {
        let spread = spread(self.problem.grid(), values);
        self.landing.iter().map(|cell| cell.map_or(0.0, |cell| spread[cell])).collect()
    }
}

/// The cell of a target, if it is in the partition.
fn landing(grid: &Grid, targets: &Targets, target: TargetId) -> Option<usize> {
    let mut cell = vec![0; grid.dimension()];
    targets.cell(target, &mut cell);
    let inside = |(axis, &i): (&GridAxis, &i32)| (0..axis.cells() as i32).contains(&i);
    let strides = grid.strides().iter().zip(&cell);
    grid.axes()
        .iter()
        .zip(&cell)
        .all(inside)
        .then(|| strides.map(|(&stride, &i)| stride as usize * i as usize).sum())
}

/// What values are expected to be after nominal noise, from every cell.
fn spread(grid: &Grid, values: &[f64]) -> Vec<f64> {
    let mut values = values.to_vec();
    for (axis, &stride) in grid.axes().iter().zip(grid.strides()) {
        let (count, stride) = (axis.cells() as usize, stride as usize);
        let at = |i: usize| values[i];
        let along = |cell: usize| {
            let place = cell / stride % count;
            let below = if place > 0 { at(cell - stride) } else { 0.0 };
            let above = if place + 1 < count { at(cell + stride) } else { 0.0 };
            (1.0 - 2.0 * SIDEWAYS) * at(cell) + SIDEWAYS * (below + above)
        };
        values = (0..values.len()).into_par_iter().map(along).collect();
    }
    values
}

/// The highest number in ranges of a list: `levels[k]` holds the highest of every `2ᵏ` neighbours.
struct Highest {
    levels: Vec<Vec<f64>>,
}

impl Highest {
    /// How many levels there are above the numbers themselves.
    fn levels_above(actions: &EnabledActions) -> usize {
        actions.ranges.iter().map(|range| range.len()).max().map_or(0, |longest| longest.ilog2() as usize)
    }

    /// For the ranges of some actions.
    fn new(numbers: Vec<f64>, actions: &EnabledActions) -> Self {
        let mut levels = vec![numbers];
        for level in 1..=Self::levels_above(actions) {
            let (half, below) = (1 << (level - 1), &levels[level - 1]);
            let pairs = below.iter().zip(&below[half.min(below.len())..]);
            levels.push(pairs.map(|(a, b)| a.max(*b)).collect());
        }
        Self { levels }
    }

    /// The highest in any of some ranges, 0 if there are none.
    fn of(&self, ranges: &[RowRange]) -> f64 {
        ranges.iter().fold(0.0, |highest, range| {
            let level = range.len().ilog2() as usize;
            let last = range.last.index() + 1 - (1 << level);
            highest.max(self.levels[level][range.first.index()]).max(self.levels[level][last])
        })
    }
}
