//! Which state of the model a run arrives in.

use super::picks::push_any;
use crate::task::{CellTask, Standing};
use imdp::model::{Rows, StateId};
use std::collections::HashMap;

/// Everything that failed.
pub(crate) const FAILED: StateId = StateId(0);
/// Where unlisted noise goes.
pub(crate) const LOST: StateId = StateId(1);
/// All goal cells, if there is a goal.
pub(super) const REACHED: StateId = StateId(2);

/// The states of memories in cells, and those in which nature picks one of them.
///
/// If nature picks anywhere, all runs that go on come by such a state, so that all steps are equally long.
pub(super) struct Arrivals {
    /// By memory: the state with it in the first cell in which it may be open.
    pub(super) first: Vec<u32>,
    /// The state after those of memories in cells.
    pub(super) pairs_end: usize,
    /// What nature picks from, by state from `pairs_end` on.
    picks: Vec<Vec<StateId>>,
    /// The state after the last of those.
    pub(super) end: usize,
    /// By the memory before and cell: where a run arrives.
    pub(super) of_cell: Vec<Vec<StateId>>,
    /// By cell: where a run may begin.
    pub(super) at_start: Vec<Vec<StateId>>,
}

impl Arrivals {
    /// The states from `heads` on, for the open cells of every memory.
    pub(super) fn new(task: &CellTask, pairs: &[Vec<u32>], heads: u32) -> Self {
        let mut end = heads;
        let first: Vec<u32> = (pairs.iter())
            .map(|open| {
                let first = end;
                end += open.len() as u32;
                first
            })
            .collect();
        let state = |standing: &Standing, cell: usize| match standing {
            Standing::Failed => FAILED,
            Standing::Reached => REACHED,
            Standing::Open(memory) => {
                let place = pairs[*memory as usize].binary_search(&(cell as u32));
                place.map_or(FAILED, |place| StateId(first[*memory as usize] + place as u32))
            }
        };
        let states = |before, cell| {
            let standings = task.standings(before, cell).iter();
            let mut states: Vec<StateId> = standings.map(|standing| state(standing, cell)).collect();
            states.sort_unstable();
            states.dedup();
            states
        };
        let pairs_end = end as usize;
        let (mut picks, mut numbers) = (vec![], HashMap::new());
        let mut arrival = |before, cell| {
            let states: Vec<StateId> = states(before, cell);
            match states[..] {
                [one] if one.0 < heads || !task.is_ambiguous() => one,
                _ => *numbers.entry(states).or_insert_with_key(|states| {
                    picks.push(states.clone());
                    StateId::from_index(pairs_end + picks.len() - 1)
                }),
            }
        };
        let cells = 0..task.num_cells();
        let of_cell: Vec<Vec<StateId>> = (0..task.memories())
            .map(|memory| cells.clone().map(|cell| arrival(Some(memory), cell)).collect())
            .collect();
        let at_start = cells.map(|cell| states(None, cell)).collect();
        Self { first, pairs_end, end: pairs_end + picks.len(), picks, of_cell, at_start }
    }

    /// Adds the rows of the states in which nature picks.
    pub(super) fn push_picks(&self, rows: &mut Rows) {
        self.picks.iter().for_each(|states| push_any(rows, states.clone()));
    }
}
