//! Which choice a policy makes, and when.

use crate::model::{Choices, RowId, StateId};

/// A choice per state, or per state and number of steps elapsed.
///
/// States that have nothing to choose (no rows) or whose choice no longer matters (goal states, and
/// states that are neither safe nor goal) have no entry.
#[derive(Clone, Debug, PartialEq)]
pub struct Policy {
    horizon: Option<u64>,
    /// Where the changes of each state start; one more entry than states.
    starts: Vec<usize>,
    /// `(steps left, choice)`: the choice holds from this many steps left upwards; ascending.
    changes: Vec<(u64, u32)>,
}

impl Policy {
    /// One choice per state, [`NO_CHOICE`] for none.
    pub fn stationary(choices: &[u32]) -> Self {
        let changes = choices.iter().enumerate().filter(|(_, choice)| **choice != NO_CHOICE);
        Self::assemble(
            None,
            choices.len(),
            &changes.map(|(s, &c)| (StateId::from_index(s), 1, c)).collect::<Vec<_>>(),
        )
    }

    /// From `(state, steps left, choice)`, ascending in the steps left for every state.
    pub fn time_varying(horizon: u64, states: usize, changes: &[(StateId, u64, u32)]) -> Self {
        Self::assemble(Some(horizon), states, changes)
    }

    fn assemble(horizon: Option<u64>, states: usize, list: &[(StateId, u64, u32)]) -> Self {
        let mut starts = vec![0; states + 1];
        for &(state, ..) in list {
            starts[state.index() + 1] += 1;
        }
        for state in 0..states {
            starts[state + 1] += starts[state];
        }
        let mut next = starts.clone();
        let mut changes = vec![(0, 0); list.len()];
        for &(state, left, choice) in list {
            changes[next[state.index()]] = (left, choice);
            next[state.index()] += 1;
        }
        Self { horizon, starts, changes }
    }

    /// The number of steps after which the policy has nothing left to do; `None` if it is stationary.
    pub fn horizon(&self) -> Option<u64> {
        self.horizon
    }

    /// The number of states.
    pub fn num_states(&self) -> usize {
        self.starts.len() - 1
    }

    /// The number of choices stored.
    pub fn num_entries(&self) -> usize {
        self.changes.len()
    }

    /// The index of the choice made in `state` after `elapsed` steps, counted in the state's own choices.
    pub fn choice(&self, state: StateId, elapsed: u64) -> Option<u32> {
        let left = self.horizon.map_or(Some(1), |horizon| horizon.checked_sub(elapsed))?;
        let changes = self.changes(state);
        let later = changes.partition_point(|&(from, _)| from <= left);
        later.checked_sub(1).map(|index| changes[index].1)
    }

    /// `(steps left, choice)` of a state: each holds from that many steps left upwards; ascending.
    ///
    /// A stationary policy has one pair at most, with 1 step left.
    pub fn changes(&self, state: StateId) -> &[(u64, u32)] {
        match (self.starts.get(state.index()), self.starts.get(state.index() + 1)) {
            (Some(&start), Some(&end)) => &self.changes[start..end],
            _ => &[],
        }
    }

    /// The row of the choice made in `state` after `elapsed` steps.
    pub fn row(&self, choices: &Choices, state: StateId, elapsed: u64) -> Option<RowId> {
        choices.row_of_choice(state, self.choice(state, elapsed)?)
    }
}

/// Stands for "no choice" in [`Policy::stationary`].
pub const NO_CHOICE: u32 = u32::MAX;

/// The first choice of a state whose row satisfies a condition.
pub(super) fn first_choice(choices: &Choices, state: StateId, holds: impl Fn(RowId) -> bool) -> Option<u32> {
    choices.rows(state).position(holds).map(|choice| choice as u32)
}
