//! How far targets take a state, if there were no noise.

use crate::abstraction::Abstraction;
use crate::partition::{CellId, CellKind, CellLookup};
use crate::problem::Problem;

/// What can be reached by steering from target to target.
pub(super) struct Reach {
    /// The least number of grouped steps to a cell of the goal.
    pub(super) to_goal: Option<u64>,
    /// How many cells were come to, the first among them.
    pub(super) visited: usize,
}

impl Reach {
    /// From `start`, breadth first.
    pub(super) fn new(problem: &Problem, abstraction: &Abstraction, start: CellId) -> Self {
        let lookup = CellLookup::new(problem.grid());
        let mut point = vec![0.0; problem.grid().dimension()];
        let cell_of_target: Vec<Option<CellId>> = (0..abstraction.targets.len())
            .map(|target| {
                abstraction.targets.point(target, &mut point);
                lookup.locate(&point)
            })
            .collect();
        let choices = abstraction.model.choices();
        let mut seen = vec![false; problem.grid().num_cells() as usize];
        seen[start.index()] = true;
        let (mut front, mut visited, mut steps) = (vec![start], 1, 0);
        while !front.is_empty() {
            steps += 1;
            let mut next = Vec::new();
            for cell in front {
                for row in choices.rows(abstraction.state_of_cell[cell.index()]) {
                    let Some(end) = cell_of_target.get(row.index()).copied().flatten() else { continue };
                    if std::mem::replace(&mut seen[end.index()], true) {
                        continue;
                    }
                    visited += 1;
                    match problem.labels().kind(end) {
                        CellKind::Goal => return Self { to_goal: Some(steps), visited },
                        CellKind::Unsafe => {}
                        CellKind::Ordinary => next.push(end),
                    }
                }
            }
            front = next;
        }
        Self { to_goal: None, visited }
    }
}
