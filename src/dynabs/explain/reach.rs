//! How far targets take a state, if there were no noise.

use crate::abstraction::Abstraction;
use crate::partition::{CellId, CellLookup};
use crate::problem::Problem;
use imdp::model::StateId;
use std::collections::HashSet;

/// What can be reached by steering from target to target.
pub(super) struct Reach {
    /// The least number of grouped steps to a cell of the goal.
    pub(super) to_goal: Option<u64>,
    /// How many cells were come to in which the task is open, the first among them.
    pub(super) visited: usize,
}

impl Reach {
    /// From `start`, breadth first.
    pub(super) fn new(problem: &Problem, abstraction: &Abstraction, start: CellId) -> Self {
        let lookup = CellLookup::new(problem.grid());
        let mut point = vec![0.0; problem.grid().dimension()];
        let cell_of_target: Vec<Option<CellId>> = (abstraction.targets.ids())
            .map(|target| {
                abstraction.targets.point(target, &mut point);
                lookup.locate(&point)
            })
            .collect();
        let (choices, labels) = (abstraction.model.choices(), abstraction.model.labels());
        let is_done =
            |state: StateId| labels.get("reached").is_some_and(|reached| reached.contains(state.index()));
        let mut seen = vec![false; abstraction.model.num_states()];
        let start = abstraction.state_of_cell[start.index()];
        seen[start.index()] = true;
        let mut visited = HashSet::from([abstraction.pair(start).map(|(_, cell)| cell)]);
        let (mut front, mut steps) = (vec![start], 0);
        while !front.is_empty() {
            steps += 1;
            let mut next = Vec::new();
            for state in front {
                let memory = abstraction.pair(state).map(|(memory, _)| memory);
                for row in choices.rows(state) {
                    let target = abstraction.target(row).index();
                    let Some(cell) = cell_of_target.get(target).copied().flatten() else { continue };
                    let end = abstraction.arrival(problem, memory, cell);
                    if std::mem::replace(&mut seen[end.index()], true) {
                        continue;
                    }
                    if is_done(end) {
                        return Self { to_goal: Some(steps), visited: visited.len() };
                    }
                    if let Some((_, cell)) = abstraction.pair(end) {
                        visited.insert(Some(cell));
                        next.push(end);
                    }
                }
            }
            front = next;
        }
        Self { to_goal: None, visited: visited.len() }
    }
}
