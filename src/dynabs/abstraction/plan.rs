//! Plans: where cells steer to while noise is what it mostly is.
//!
//! A plan is the best policy for *nominal* noise, which moves every coordinate by one cell up, or down, with probability
//! `m` each and independently, so that it leaves a berth around what is unsafe; and it hurries: a step later everything is
//! worth `γ` of it. With `ν` for the nominal noise its values are
//!
//! `v(s) = γ · max { Σ_o ν(o) v(cell(d_a) + o) : a enabled in s }`,
//!
//! 1 in goal cells, 0 in unsafe ones and outside; for a task to stay, `1 − γ` is added for every step that is done. Samples have
//! no part in it, and nothing is proven of it: a plan only says which actions are left.

use super::enabled::EnabledActions;
use super::targets::Targets;
use crate::partition::{CellId, CellKind, Grid, GridAxis};
use crate::problem::{Problem, TargetId, Tracking};
use crate::task::Aim;
use imdp::model::RowRange;
use imdp::progress::Progress;
use rayon::prelude::*;

/// `m`: how likely nominal noise moves a coordinate by a cell to either side. Like `γ` chosen for the spacecraft of the paper:
/// the less they hurry, the wider a berth plans take, until noise has too many steps to do harm in.
const SIDEWAYS: f64 = 0.1;

/// `γ`: what is left of a worth after one more step.
const PATIENCE: f64 = 0.8;

/// Values that change by less than this part of them are settled.
const SETTLED: f64 = 1e-4;

/// What is farther away is not planned for.
const MOST_STEPS: u64 = 1000;

/// Where cells steer to.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Per cell of the partition.
    headings: Vec<Option<TargetId>>,
}

impl Plan {
    /// The plan of a problem with these actions enabled in `cells`, which is made but where it is given.
    pub(super) fn new(
        problem: &Problem,
        tracking: &Tracking,
        targets: &Targets,
        (cells, actions): (&[CellId], &EnabledActions),
        progress: &dyn Progress,
    ) -> Self {
        let grid = problem.grid();
        let starts = actions.starts();
        let ranges = |i: usize| &actions.ranges[starts[i]..starts[i + 1]];
        let is_to_stay = problem.worst_task().aim() == Aim::Stay;
        let mut values: Vec<f64> =
            (problem.labels().iter())
                .map(|(_, kind)| {
                    if kind == CellKind::Goal || (is_to_stay && kind == CellKind::Ordinary) {
                        1.0
                    } else {
                        0.0
                    }
                })
                .collect();
        let landing: Vec<Option<usize>> =
            targets.ids().map(|target| landing(grid, targets, target)).collect();
        let worth = |values: &[f64]| -> Vec<f64> {
            let spread = spread(grid, values);
            landing.iter().map(|cell| cell.map_or(0.0, |cell| spread[cell])).collect()
        };
        let reward = if is_to_stay { 1.0 - PATIENCE } else { 0.0 };
        let steps = problem.horizon().unwrap_or(MOST_STEPS).min(MOST_STEPS);
        progress.start("the plan", steps);
        for _ in 0..steps {
            let worth = Highest::new(worth(&values), actions);
            let next: Vec<f64> =
                (0..cells.len()).into_par_iter().map(|i| reward + PATIENCE * worth.of(ranges(i))).collect();
            let is_settled =
                |(cell, next): (&CellId, &f64)| (next - values[cell.index()]).abs() <= SETTLED * next;
            let settled = cells.iter().zip(&next).all(is_settled);
            cells.iter().zip(next).for_each(|(cell, next)| values[cell.index()] = next);
            progress.advance(1);
            if settled {
                break;
            }
        }
        progress.finish();
        let worth = worth(&values);
        let mut headings = vec![None; values.len()];
        for (i, cell) in cells.iter().enumerate() {
            let best =
                ranges(i).iter().copied().flat_map(RowRange::rows).fold(None, |best, row| match best {
                    Some((_, most)) if worth[row.index()] <= most => best,
                    _ => Some((row, worth[row.index()])).filter(|(_, worth)| *worth > 0.0),
                });
            headings[cell.index()] = best.map(|(row, _)| targets.original(TargetId::from_index(row.index())));
        }
        for (cell, point) in tracking.given() {
            headings[cell.index()] = nearest(grid, targets, point);
        }
        Self { headings }
    }

    /// The target that a cell steers to, if anything can be done from there.
    pub fn heading(&self, cell: CellId) -> Option<TargetId> {
        self.headings[cell.index()]
    }

    /// The same for every cell.
    pub fn headings(&self) -> impl Iterator<Item = Option<TargetId>> {
        self.headings.iter().copied()
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

/// The target nearest to a point, in widths of cells.
fn nearest(grid: &Grid, targets: &Targets, point: &[f64]) -> Option<TargetId> {
    let widths: Vec<f64> = grid.widths();
    let mut place = vec![0.0; point.len()];
    let mut distance = |target: TargetId| -> f64 {
        targets.point(target, &mut place);
        let along = place.iter().zip(point).zip(&widths);
        along.map(|((d, x), width)| ((d - x) / width).powi(2)).sum()
    };
    let originals = targets.ids().take(targets.num_originals());
    originals
        .map(|target| (distance(target), target))
        .min_by(|(a, _), (b, _)| a.total_cmp(b))
        .map(|(_, target)| target)
}

/// The highest number in ranges of a list: `levels[k]` holds the highest of every `2ᵏ` neighbours.
struct Highest {
    levels: Vec<Vec<f64>>,
}

impl Highest {
    /// For the ranges of some actions.
    fn new(numbers: Vec<f64>, actions: &EnabledActions) -> Self {
        let longest = actions.ranges.iter().map(|range| range.len()).max().unwrap_or(1);
        let mut levels = vec![numbers];
        for level in 1..=longest.ilog2() as usize {
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
