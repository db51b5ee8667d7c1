//! Which action a cell takes, and when.

use crate::abstraction::Abstraction;
use crate::partition::CellId;
use crate::problem::Problem;
use crate::task::{Aim, Memory};
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
    /// The actions of a policy on the model of a problem whose actions are targets.
    pub(super) fn new(problem: &Problem, abstraction: &Abstraction, policy: &Policy) -> Self {
        let (task, cells) = (problem.cell_task(), problem.grid().num_cells());
        let choices = abstraction.model.choices();
        // States that merge cells have no choices, so every entry is of one cell.
        let action =
            |state, choice| choices.row_of_choice(state, choice).map(|row| abstraction.target(row).0);
        let mut schedule = Self { starts: vec![0], entries: vec![] };
        for memory in 0..task.memories() {
            for cell in (0..cells).map(CellId) {
                match (task.aim(), problem.horizon()) {
                    (Aim::End, Some(horizon)) => {
                        // Memories of the model count the steps: each has the actions of one.
                        let first = schedule.entries.len();
                        for steps_left in 1..=horizon {
                            let timed = (horizon - steps_left) as Memory * task.memories() + memory;
                            let state = abstraction.state(timed, cell);
                            let choice = state
                                .and_then(|state| Some((state, policy.choice(state, horizon - steps_left)?)));
                            let Some(action) = choice.and_then(|(state, choice)| action(state, choice))
                            else {
                                continue;
                            };
                            if schedule.entries[first..].last().is_none_or(|entry| entry.action != action) {
                                schedule.entries.push(Entry { steps_left, action });
                            }
                        }
                    }
                    _ => {
                        let state = abstraction.state(memory, cell);
                        let changes = state.iter().flat_map(|&state| {
                            policy.changes(state).iter().map(move |&(left, choice)| (left, state, choice))
                        });
                        schedule.entries.extend(changes.filter_map(|(steps_left, state, choice)| {
                            action(state, choice).map(|action| Entry { steps_left, action })
                        }));
                    }
                }
                schedule.starts.push(schedule.entries.len());
            }
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
