//! Which actions are enabled in which ordinary cells: by the law, by what is to be avoided in between, and by a plan.

use super::AbstractionError;
use super::between::Between;
use super::enabled::EnabledActions;
use super::hazards::Hazards;
use super::plan::Plan;
use super::rooms::{Needed, Rooms};
use super::steering::Steering;
use super::targets::Targets;
use super::tracking::Deviations;
use super::windows::Windows;
use crate::partition::{CellId, CellKind};
use crate::problem::{Problem, Stabilizer};
use imdp::model::RowRange;
use imdp::progress::Progress;

/// The enabled actions of all ordinary cells.
pub(super) struct Enabling {
    /// In the order of the cells.
    actions: EnabledActions,
    /// Per cell of the partition, how many of their ranges come before its own; one more entry than cells.
    starts: Vec<usize>,
    /// What the actions steer to.
    pub(super) targets: Targets,
    /// The rooms that some of them need.
    pub(super) rooms: Rooms,
    /// Per cell of the partition, whether it is ordinary and the law has no action there: known before any sample, and
    /// before any plan.
    idle: Vec<bool>,
    /// The plan that they are near, if one is to be followed.
    pub(super) plan: Option<Plan>,
}

impl Enabling {
    /// What the law allows; and, where hazards have to be avoided at every step, what keeps clear of them with noise of
    /// the largest window, or with room for it; a row has at most as many entries as comes with
    /// them.
    pub(super) fn new(
        problem: &Problem,
        steering: &Steering,
        hazards: Option<(&Hazards, &Windows, usize)>,
        progress: &dyn Progress,
    ) -> Result<Self, AbstractionError> {
        let ordinary: Vec<CellId> = (problem.labels().iter())
            .filter_map(|(cell, kind)| (kind == CellKind::Ordinary).then_some(cell))
            .collect();
        progress.start("enabled actions", ordinary.len() as u64);
        let mut actions = steering.enabled(problem, &ordinary, progress);
        progress.finish();
        let is_empty = |actions: &EnabledActions| actions.ranges.is_empty() && !ordinary.is_empty();
        if is_empty(&actions) {
            let (stabilized, grouping) =
                (problem.stabilizer().and_then(Stabilizer::feedback).is_some(), problem.grouping().to_vec());
            return Err(AbstractionError::NothingEnabled { stabilized, grouping });
        }
        let mut idle = vec![false; problem.grid().num_cells() as usize];
        for (cell, &count) in ordinary.iter().zip(&actions.ranges_per_cell) {
            idle[cell.index()] = count == 0;
        }
        let (mut targets, mut rooms) = (steering.targets.clone(), Rooms::default());
        if let Some((hazards, windows, row_length)) = hazards {
            progress.start("steps in between", ordinary.len() as u64);
            let between = Between::new(problem, hazards, steering, windows);
            let mut needed = Needed::new(&targets, row_length);
            actions = between.filter(&ordinary, &actions, &mut needed, progress);
            (rooms, targets, actions) = Rooms::new(actions, needed, &targets);
            progress.finish();
            if is_empty(&actions) {
                return Err(AbstractionError::NothingClear { group_steps: problem.group_steps() });
            }
        }
        let tracking = problem.stabilizer().and_then(Stabilizer::tracking);
        let plan = tracking.map(|tracking| {
            let plan = Plan::new(problem, tracking, &targets, (&ordinary, &actions), progress);
            let deviations = Deviations::new(&steering.law, tracking.abstract_input(), &targets);
            actions = deviations.near(&plan, &targets, &ordinary, &actions);
            plan
        });
        if is_empty(&actions) {
            return Err(AbstractionError::NothingPlanned);
        }
        let mut starts = vec![0; idle.len() + 1];
        for (cell, &count) in ordinary.iter().zip(&actions.ranges_per_cell) {
            starts[cell.index() + 1] = count as usize;
        }
        (0..idle.len()).for_each(|cell| starts[cell + 1] += starts[cell]);
        Ok(Self { actions, starts, targets, rooms, idle, plan })
    }

    /// The enabled actions of a cell, ascending; none if it is not ordinary.
    pub(super) fn actions_of(&self, cell: CellId) -> &[RowRange] {
        &self.actions.ranges[self.starts[cell.index()]..self.starts[cell.index() + 1]]
    }

    /// How many ranges of actions all cells have together.
    pub(super) fn num_ranges(&self) -> usize {
        self.actions.ranges.len()
    }

    /// All of them, cell after cell: none are left.
    pub(super) fn take_actions(&mut self) -> Vec<RowRange> {
        self.starts.fill(0);
        std::mem::take(&mut self.actions.ranges)
    }

    /// Whether the law has no action in an ordinary cell: whatever the samples.
    pub(super) fn is_idle(&self, cell: CellId) -> bool {
        self.idle[cell.index()]
    }
}
