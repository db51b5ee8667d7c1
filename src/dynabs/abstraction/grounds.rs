//! What cells are to rows, with every memory of the task.

use super::enabling::Enabling;
use super::states::{FAILED, StateSpace};
use super::stencil::Ground;
use super::targets::Targets;
use crate::problem::Problem;
use std::sync::Arc;

/// What landing in each cell leads to, one after the other for the memories that states have; `shared` are the targets that
/// coordinates count from if all sit alike in their cells.
pub(super) fn grounds(
    problem: &Problem,
    enabling: &Enabling,
    states: &StateSpace,
    shared: Option<&Targets>,
) -> Arc<[Ground]> {
    let task = problem.worst_task();
    let ground = |&memory| {
        Ground::new(problem.grid(), shared, states.heads(), |cell| {
            match states.arrival(task, Some(memory), cell) {
                // A run that comes to a cell without any action is over.
                state if states.pair(state).is_some() && enabling.is_idle(cell) => FAILED,
                state => state,
            }
        })
    };
    states.memories().iter().map(ground).collect()
}
