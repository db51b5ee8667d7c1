//! Which actions keep clear of what is unsafe at the steps between grouped instants.

use super::enabled::EnabledActions;
use super::hazards::Hazards;
use super::room::{MOST_DIMENSIONS, RUNGS, Room};
use super::rooms::Needed;
use super::steering::Steering;
use super::windows::Windows;
use crate::partition::{CellId, Grid};
use crate::problem::Problem;
use imdp::model::{RowId, RowRange};
use imdp::numeric::{UNIT_ROUNDOFF, to_f64_up};
use imdp::progress::Progress;
use nalgebra::DMatrix;
use rayon::prelude::*;

/// Cells per parallel task.
const CELLS_PER_TASK: usize = 64;

/// Tasks whose results are put together at once.
const TASKS: usize = 32;

/// Rooms are looked for among at most so many pairs of a cell and an action: beyond, the list of them would be what takes memory.
const MOST_PAIRS: u64 = 1 << 24;

/// The test of actions at the steps in between.
pub(super) struct Between<'a> {
    hazards: &'a Hazards,
    grid: &'a Grid,
    centers: Vec<Vec<f64>>,
    steps: Vec<Step>,
}

/// Where the state is after a step in between, with noise of the window: a box for every cell and target.
struct Step {
    /// `T d + r`, target after target.
    by_target: Vec<f64>,
    /// `S`, `n×n`.
    state: DMatrix<f64>,
    /// From `T d + S c + r` to the lower and to the upper corner, for a cell with center `c`.
    lower: Vec<f64>,
    upper: Vec<f64>,
    /// The same for noise within each of the rungs.
    rungs: Vec<(Vec<f64>, Vec<f64>)>,
}

/// What keeps clear of everything unsafe in some cells.
#[derive(Default)]
struct Clear {
    /// With any noise of the largest window.
    actions: EnabledActions,
    /// With noise that stays in a room: number of the cell, target and room, ascending by cell and target.
    with_room: Vec<(u32, RowId, Room)>,
}

impl<'a> Between<'a> {
    /// The test for the largest of the windows.
    pub(super) fn new(
        problem: &'a Problem,
        hazards: &'a Hazards,
        steering: &Steering,
        windows: &Windows,
    ) -> Self {
        let grid = problem.grid();
        let steps = (1..problem.group_steps()).map(|i| Step::new(problem, steering, windows, i));
        Self {
            hazards,
            grid,
            centers: grid.axes().iter().map(|axis| axis.centers()).collect(),
            steps: steps.collect(),
        }
    }

    /// The actions, out of those `enabled` in each of `cells`, that keep clear of everything unsafe; where all targets sit
    /// alike in their cells, what does so if there is room for the noise is `needed`.
    pub(super) fn filter(
        &self,
        cells: &[CellId],
        enabled: &EnabledActions,
        needed: &mut Needed,
        progress: &dyn Progress,
    ) -> EnabledActions {
        let pairs: u64 = enabled.ranges.iter().map(|range| range.rows().count() as u64).sum();
        let has_rooms = pairs <= MOST_PAIRS;
        let starts = enabled.starts();
        let of_cell = |i: usize| &enabled.ranges[starts[i]..starts[i + 1]];
        let of_task = |least: Option<usize>, task: usize, chunk: &[CellId]| {
            let mut found = Clear::default();
            let mut probe = Probe::new(self, least);
            for (i, &cell) in (task * CELLS_PER_TASK..).zip(chunk) {
                let before = found.actions.ranges.len();
                probe.start_in(cell);
                of_cell(i).iter().for_each(|range| probe.push_clear(i as u32, range, &mut found));
                found.actions.ranges_per_cell.push((found.actions.ranges.len() - before) as u32);
            }
            progress.advance(chunk.len() as u64);
            found
        };
        let tasks: Vec<(usize, &[CellId])> = cells.chunks(CELLS_PER_TASK).enumerate().collect();
        let mut actions = EnabledActions::default();
        for tasks in tasks.chunks(TASKS) {
            let least = needed.least().filter(|_| has_rooms);
            let parts: Vec<Clear> =
                tasks.par_iter().map(|&(task, chunk)| of_task(least, task, chunk)).collect();
            for part in parts {
                actions.append(part.actions);
                needed.add(part.with_room);
            }
        }
        actions
    }
}

impl Step {
    /// The step after `i` of the steps of a group.
    fn new(problem: &Problem, steering: &Steering, windows: &Windows, i: usize) -> Self {
        let (n, targets) = (problem.grid().dimension(), &steering.targets);
        let image = steering.law.partial_image(problem.step_system(), i, &steering.extent);
        let mut by_target = Vec::with_capacity(targets.len() * n);
        let mut point = vec![0.0; n];
        for target in targets.ids() {
            targets.point(target, &mut point);
            by_target.extend(
                (0..n)
                    .map(|j| (0..n).fold(image.constant[j], |sum, k| sum + image.target[(j, k)] * point[k])),
            );
        }
        let half_widths: Vec<f64> =
            problem.grid().axes().iter().map(|axis| 0.5 * to_f64_up(axis.width())).collect();
        let reach = |j: usize, noise: f64| {
            let cell: f64 = (0..n).map(|k| image.state[(j, k)].abs() * half_widths[k]).sum();
            let rounding = 4.0 * (n as f64 + 4.0) * UNIT_ROUNDOFF * (cell + noise.abs());
            cell + image.error[j] + rounding
        };
        let with_noise = |(lower, upper): (Vec<f64>, Vec<f64>)| -> (Vec<f64>, Vec<f64>) {
            (0..n).map(|j| (lower[j] - reach(j, lower[j]), upper[j] + reach(j, upper[j]))).unzip()
        };
        let (lower, upper) = with_noise(windows.between(0, i - 1));
        let has_rooms = windows.are_shared() && n <= MOST_DIMENSIONS;
        let rungs = if has_rooms { 0..RUNGS.len() } else { 0..0 };
        Self {
            lower,
            upper,
            rungs: rungs.map(|rung| with_noise(windows.rung(rung, i - 1))).collect(),
            state: image.state,
            by_target,
        }
    }
}

/// What a task reuses from cell to cell.
struct Probe<'a> {
    between: &'a Between<'a>,
    /// The least rung that rooms may be limited to, if there may be rooms.
    least: Option<usize>,
    /// Per step, `S c`.
    by_cell: Vec<Vec<f64>>,
    center: Vec<f64>,
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl<'a> Probe<'a> {
    fn new(between: &'a Between<'a>, least: Option<usize>) -> Self {
        let zero = vec![0.0; between.grid.dimension()];
        Self {
            by_cell: vec![zero.clone(); between.steps.len()],
            center: zero.clone(),
            lower: zero.clone(),
            upper: zero,
            between,
            least,
        }
    }

    fn start_in(&mut self, cell: CellId) {
        for (j, center) in self.center.iter_mut().enumerate() {
            *center = self.between.centers[j][self.between.grid.coordinate(cell, j) as usize];
        }
        for (step, by_cell) in self.between.steps.iter().zip(&mut self.by_cell) {
            for (j, by_cell) in by_cell.iter_mut().enumerate() {
                *by_cell = (self.center.iter().enumerate()).map(|(k, c)| step.state[(j, k)] * c).sum();
            }
        }
    }

    /// Adds the parts of a range whose actions are clear, with any noise or with room for it.
    fn push_clear(&mut self, cell: u32, range: &RowRange, found: &mut Clear) {
        let ranges = &mut found.actions.ranges;
        let mut open: Option<RowRange> = None;
        for target in range.rows() {
            if self.is_clear(target) {
                open = Some(RowRange { first: open.map_or(target, |run| run.first), last: target });
            } else {
                ranges.extend(open.take());
                found.with_room.extend(self.room(target).map(|room| (cell, target, room)));
            }
        }
        ranges.extend(open);
    }

    fn is_clear(&mut self, target: RowId) -> bool {
        let n = self.center.len();
        let steps = self.between.steps.iter().zip(&self.by_cell);
        for (step, by_cell) in steps {
            let by_target = &step.by_target[target.index() * n..(target.index() + 1) * n];
            for (j, (by_target, by_cell)) in by_target.iter().zip(by_cell).enumerate() {
                let middle = by_target + by_cell;
                (self.lower[j], self.upper[j]) = (middle + step.lower[j], middle + step.upper[j]);
            }
            if self.between.hazards.are_met(&self.lower, &self.upper) {
                return false;
            }
        }
        true
    }

    /// The room in which an action keeps clear of everything unsafe.
    fn room(&self, target: RowId) -> Option<Room> {
        let least = self.least?;
        let n = self.center.len();
        let steps = self.between.steps.iter().zip(&self.by_cell);
        steps.into_iter().try_fold(Room::default(), |room, (step, by_cell)| {
            let by_target = &step.by_target[target.index() * n..(target.index() + 1) * n];
            let face = |side: usize, rung: usize| {
                let (lower, upper) = step.rungs.get(rung)?;
                let noise = if side.is_multiple_of(2) { lower } else { upper };
                Some(by_target[side / 2] + by_cell[side / 2] + noise[side / 2])
            };
            // No number is clear of anything.
            self.between.hazards.room(room, least, |side, rung| face(side, rung).unwrap_or(f64::NAN))
        })
    }
}
