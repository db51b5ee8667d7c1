//! Which action a cell takes, and when.

use crate::abstraction::Abstraction;
use imdp::solver::Policy;

/// An action that holds from some number of steps left upwards, until the next entry of the cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The least number of grouped steps left for which it holds; 1 in stationary schedules.
    pub steps_left: u64,
    /// The target, as numbered by [`Targets`](crate::abstraction::Targets); or the input, where actions are inputs.
    pub action: u32,
}

/// The entries of every cell, ascending in the steps left.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Schedule {
    /// Where the entries of each cell start; one more than cells.
    pub(super) starts: Vec<usize>,
    pub(super) entries: Vec<Entry>,
}

impl Schedule {
    pub(super) fn new(abstraction: &Abstraction, policy: &Policy) -> Self {
        let choices = abstraction.model.choices();
        let mut schedule = Self { starts: vec![0], entries: vec![] };
        for &state in &abstraction.state_of_cell {
            for &(steps_left, choice) in policy.changes(state) {
                // States that merge cells have no choices, so every entry is of one cell.
                if let Some(row) = choices.row_of_choice(state, choice) {
                    schedule.entries.push(Entry { steps_left, action: row.0 });
                }
            }
            schedule.starts.push(schedule.entries.len());
        }
        schedule
    }

    /// From `(steps left, action)` of every pair of memory and cell, ascending.
    pub(super) fn of_pairs<'a>(pairs: impl Iterator<Item = &'a [(u64, u32)]>) -> Self {
        let mut schedule = Self { starts: vec![0], entries: vec![] };
        for changes in pairs {
            let entries = changes.iter().map(|&(steps_left, action)| Entry { steps_left, action });
            schedule.entries.extend(entries);
            schedule.starts.push(schedule.entries.len());
        }
        schedule
    }

    /// All entries of a cell, or of a pair of memory and cell.
    pub(super) fn of(&self, pair: usize) -> &[Entry] {
        &self.entries[self.starts[pair]..self.starts[pair + 1]]
    }

    /// The action with so many steps left.
    pub(super) fn action(&self, pair: usize, steps_left: u64) -> Option<u32> {
        let entries = self.of(pair);
        let later = entries.partition_point(|entry| entry.steps_left <= steps_left);
        later.checked_sub(1).map(|index| entries[index].action)
    }
}
