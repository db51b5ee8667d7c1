//! What a property of a model asks to be proved.

use crate::exact::Nature;
use crate::model::{IntervalMdp, StateId, StateSet};
use crate::property::{QueryKind, Resolution};

/// An event whose probability is bounded, and who pulls which way.
pub(super) struct Task {
    /// Where a path succeeds.
    pub goal: StateSet,
    /// The states whose value is a matter of choices: all others have 1 in the goal and 0 elsewhere.
    pub moving: StateSet,
    /// The number of steps, if bounded.
    pub steps: Option<u64>,
    pub policy_maximises: bool,
    pub nature: Nature,
}

impl Task {
    pub(super) fn new(model: &IntervalMdp, event: QueryKind, resolution: Resolution) -> Self {
        let has_rows = |s: &usize| !model.choices().ranges(StateId::from_index(*s)).is_empty();
        let mut moving: StateSet = (0..model.num_states()).filter(has_rows).collect();
        moving.grow(model.num_states());
        let (goal, steps) = match event {
            // A goal state may be left at once: `X` asks about the state after the step only.
            QueryKind::Next { goal } => (goal, Some(1)),
            QueryKind::Until { safe, goal, steps } => {
                moving.intersect_with(&safe);
                moving.difference_with(&goal);
                (goal, steps)
            }
        };
        let policy_maximises = resolution.policy_maximises();
        Self { goal, moving, steps, policy_maximises, nature: nature_of(resolution) }
    }

    /// 1 in the goal, 0 elsewhere.
    pub(super) fn indicator(&self) -> Vec<f64> {
        (0..self.goal.len()).map(|s| if self.goal.contains(s) { 1.0 } else { 0.0 }).collect()
    }
}

/// Which way nature pulls.
pub(super) fn nature_of(resolution: Resolution) -> Nature {
    if resolution.nature_maximises() { Nature::Max } else { Nature::Min }
}
