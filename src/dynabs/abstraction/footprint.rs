//! How much memory a compilation takes, known before it takes it.

use super::hazards::Hazards;
use super::steering::Steering;
use super::targets::Targets;
use crate::memory::{Need, TooLarge};
use crate::partition::{CellId, CellKind, Grid};
use crate::problem::{Actions, Problem, Stabilizer, TargetPoints};
use imdp::numeric::to_f64;
use serde::Serialize;

/// What all parts take.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Footprint {
    needs: Vec<Need>,
}

/// Per target: how far it is from the goal, its counts, where its row starts.
const TARGET_BYTES: u64 = 96;

/// Per range of enabled actions: in a list that grows and becomes that of the model.
const RANGE_BYTES: u64 = 12;

/// The same for ranges of which some are left out because of what is unsafe in between, or which are gathered from other processes:
/// in two such lists.
const RANGE_TWICE_BYTES: u64 = 24;

/// Per entry of a row, successor and bounds: in two models, and in the pieces that they are put together from.
const ENTRY_BYTES: u64 = 60;

/// Per row that is a shift of a stencil: which, its length, what its special states get; in two models.
const SHIFTED_ROW_BYTES: u64 = 24;

/// Per cell that is planned for: its values, what it steers to.
const PLAN_CELL_BYTES: u64 = 40;

/// Per target that is planned with, its cell; and how good it is, and the best of its neighbours on every level of them.
const PLAN_TARGET_BYTES: [u64; 2] = [24, 8];

/// Per memory and cell: its state, what landing there means, values.
const PAIR_BYTES: u64 = 64;

/// How many cells say how many ranges all have.
const PROBED_CELLS: u32 = 512;

/// They are looked at in such pieces,
const PROBED_AT_ONCE: u32 = 16;

/// until they have so many ranges: where cells have very many, few of them say enough.
const ENOUGH_RANGES: u64 = 1 << 18;

impl Footprint {
    /// What cells, targets and enabled actions of a problem take, the latter by an estimate.
    pub(super) fn new(problem: &Problem, steering: &Steering) -> Self {
        let grid = problem.grid();
        let field = field_of_targets(problem);
        let (targets, memories) = (steering.targets.len() as u64, memories(problem));
        let need = |what, bytes, field| Need { what, bytes, field };
        let ranges = ranges(problem, steering).saturating_mul(memories);
        let is_twice = Hazards::in_between(problem).is_some() || imdp::ranks::size() > 1;
        let range_bytes = if is_twice { RANGE_TWICE_BYTES } else { RANGE_BYTES };
        let mut needs = vec![
            Need::of_cells(grid),
            need("the targets", targets * TARGET_BYTES, field),
            need("the enabled actions", ranges.saturating_mul(range_bytes), field),
        ];
        if let Some(tracking) = problem.stabilizer().and_then(Stabilizer::tracking) {
            let [cell, worth] = PLAN_TARGET_BYTES;
            let levels = u64::from(targets.max(1).ilog2()) + 1;
            let per_target = cell + levels * worth + 8 * tracking.abstract_input().offsets().len() as u64;
            let bytes = u64::from(grid.num_cells()) * PLAN_CELL_BYTES + targets * per_target;
            needs.push(need("the plan", bytes, field));
        }
        if memories > 1 {
            let bytes = memories.saturating_mul(u64::from(grid.num_cells())).saturating_mul(PAIR_BYTES);
            needs.push(need("what the task remembers in all cells", bytes, "/task"));
        }
        Self { needs }
    }

    /// What the cells of a grid take that are there already.
    pub(super) fn of_cells(grid: &Grid) -> Self {
        Self { needs: vec![Need::of_cells(grid)] }
    }

    /// And what its rows take; by an estimate, if they are not shifts of one another.
    pub(super) fn with_rows(mut self, problem: &Problem, steering: &Steering) -> Self {
        let targets = &steering.targets;
        let rows = (targets.len() as u64).saturating_mul(memories(problem));
        let bytes = bytes_of_rows(problem, targets, rows);
        self.needs.push(Need { what: "the rows of the model", bytes, field: field_of_targets(problem) });
        self
    }

    /// And what rows take that some targets have again, for actions that need room in between: known before they are made.
    pub(super) fn with_rooms(mut self, problem: &Problem, targets: &Targets) -> Result<Self, TooLarge> {
        let again = (targets.len() - targets.num_originals()) as u64;
        if again > 0 {
            let bytes = bytes_of_rows(problem, targets, again.saturating_mul(memories(problem)));
            let what = "rows for actions that need room in between";
            self.take(Need { what, bytes, field: field_of_targets(problem) })?;
        }
        Ok(self)
    }

    /// Adds a part that is about to be needed.
    ///
    /// # Errors
    /// [`TooLarge`] if it does not fit beside what there is by now.
    pub(super) fn take(&mut self, need: Need) -> Result<(), TooLarge> {
        self.needs.push(need);
        need.check()
    }

    /// Fails if there is not enough memory for all of it together.
    ///
    /// # Errors
    /// [`TooLarge`] with the largest part if it is too much by itself, else with all of it.
    pub(super) fn check(&self) -> Result<(), TooLarge> {
        let largest = self.needs.iter().max_by_key(|need| need.bytes);
        largest.map_or(Ok(()), |largest| {
            largest.check()?;
            Need { what: "the whole compilation", bytes: self.bytes(), field: largest.field }.check()
        })
    }

    /// The parts.
    pub fn needs(&self) -> &[Need] {
        &self.needs
    }

    /// All parts together.
    pub fn bytes(&self) -> u64 {
        self.needs.iter().fold(0, |sum, need| sum.saturating_add(need.bytes))
    }
}

/// How many memories the task has in the model.
fn memories(problem: &Problem) -> u64 {
    problem.worst_task().memories().into()
}

/// What rows with so many entries in all take.
pub(super) fn need_of_rows(problem: &Problem, entries: u64) -> Need {
    let bytes = entries.saturating_mul(ENTRY_BYTES);
    Need { what: "the rows of the model", bytes, field: field_of_targets(problem) }
}

/// The field that makes fewer actions.
fn field_of_targets(problem: &Problem) -> &'static str {
    match problem.actions() {
        Actions::Targets(TargetPoints::Centers) => "/partition/cells",
        Actions::Targets(_) => "/targets",
    }
}

/// How many ranges of actions are enabled in all cells, by the mean of some that lie evenly in all dimensions.
fn ranges(problem: &Problem, steering: &Steering) -> u64 {
    let cells = problem.grid().num_cells();
    // Steps by the golden ratio of the cells: no two dimensions in step with each other.
    let stride = (f64::from(cells) * 0.618_033_988_749_895) as u64 | 1;
    let cell = |i: u32| CellId((u64::from(i) * stride % u64::from(cells)) as u32);
    let (mut probed, mut found) = (0, 0u64);
    while probed < cells.min(PROBED_CELLS) && found < ENOUGH_RANGES {
        let next = (probed + PROBED_AT_ONCE).min(cells);
        let ordinary = |&cell: &CellId| problem.labels().kind(cell) == CellKind::Ordinary;
        let chosen: Vec<CellId> = (probed..next).map(cell).filter(ordinary).collect();
        found += steering.enabled(problem, &chosen, &()).ranges.len() as u64;
        probed = next;
    }
    // A quarter more for what the mean may miss.
    found.saturating_mul(u64::from(cells)) / u64::from(probed) * 5 / 4
}

/// What the rows of so many of the targets take.
fn bytes_of_rows(problem: &Problem, targets: &Targets, count: u64) -> u64 {
    match targets.alignment() {
        Some(_) => count.saturating_mul(SHIFTED_ROW_BYTES),
        None => entries(problem, count).saturating_mul(ENTRY_BYTES),
    }
}

/// How many entries the rows of so many targets have at most: the cells in a box around all samples, wherever a target sits, and
/// two for what is not listed cell by cell.
fn entries(problem: &Problem, targets: u64) -> u64 {
    let Some(noise) = problem.noise().samples() else {
        return targets.saturating_mul(u64::from(problem.grid().num_cells()) + 2);
    };
    let samples = &noise.samples;
    let along = problem.grid().axes().iter().enumerate().map(|(j, axis)| {
        let width = to_f64(axis.width());
        let lowest = samples.iter().map(|sample| sample[j] / width).fold(0.0, f64::min);
        let highest = samples.iter().map(|sample| sample[j] / width).fold(0.0, f64::max);
        let cells = i64::from(axis.cells());
        // As many cells as there are on either side say all; a float that is larger ends there.
        let (a, b) = ((lowest + 0.5).floor() as i64, (highest + 0.5).floor() as i64);
        (b.min(cells) - a.max(-cells) + 2).min(cells) as u64
    });
    along.fold(1, u64::saturating_mul).saturating_add(2).saturating_mul(targets)
}
