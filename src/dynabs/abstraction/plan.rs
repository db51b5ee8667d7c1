//! Plans: where cells steer to while noise is what it mostly is.
//!
//! A plan is the best policy for *nominal* noise ([`super::nominal`]), so that it leaves a berth around what is unsafe; and it
//! hurries: a step later everything is worth [`PATIENCE`] of it. Samples have no part in it, and nothing is proven of it: a plan
//! only says which actions are left.

use super::enabled::EnabledActions;
use super::nominal::Nominal;
use super::targets::Targets;
use crate::partition::{CellId, Grid};
use crate::problem::{Problem, TargetId, Tracking};
use imdp::model::RowRange;
use imdp::progress::Progress;
use rayon::prelude::*;

/// What is left of a worth after one more step. Like nominal noise chosen for the spacecraft of the paper: the less they hurry,
/// the wider a berth plans take, until noise has too many steps to do harm in.
const PATIENCE: f64 = 0.8;

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
        let starts = actions.starts();
        let steps = problem.horizon().unwrap_or(MOST_STEPS).min(MOST_STEPS);
        let nominal = Nominal::new(problem, targets, PATIENCE, steps);
        progress.start("the plan", nominal.steps);
        let values = nominal.values(cells, actions, progress);
        progress.finish();
        let worth = nominal.worth(&values);
        let best = |(i, cell): (usize, &CellId)| {
            let rows = actions.ranges[starts[i]..starts[i + 1]].iter().copied().flat_map(RowRange::rows);
            let best = rows.fold((0.0, None), |best, row| match worth[row.index()] {
                more if more > best.0 => (more, Some(row)),
                _ => best,
            });
            (*cell, best.1.map(|row| targets.original(TargetId::from_index(row.index()))))
        };
        let found: Vec<_> = cells.par_iter().enumerate().map(best).collect();
        let mut headings = vec![None; values.len()];
        found.into_iter().for_each(|(cell, heading)| headings[cell.index()] = heading);
        for (cell, point) in tracking.given() {
            headings[cell.index()] = nearest(problem.grid(), targets, point);
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
