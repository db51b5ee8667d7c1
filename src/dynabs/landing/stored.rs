//! The solution of a task on the lattice as one of pairs of memory and cell, in which form it is kept.

use super::side::{Lower, Upper};
use super::solve::{LandingSolution, Question};
use imdp::solver::{Solution, ValueBounds};

impl LandingSolution {
    /// Bounds and policy of the pairs, state `memory · cells + cell`.
    pub fn of_pairs(&self) -> Solution {
        // Those of earlier steps are by cell: where there is one memory, that is the same.
        let is_by_pair =
            self.history.first().is_some_and(|first| first.len() == self.with_memory.lower.len());
        let earlier = self.history.iter().rev().skip(1).filter(|_| is_by_pair);
        Solution {
            values: self.with_memory.clone(),
            status: self.status,
            iterations: self.iterations,
            policy: Some(self.policy.clone()),
            evidence: None,
            history: earlier.cloned().collect(),
        }
    }
}

impl Question<'_> {
    /// The number of pairs of memory and cell.
    pub fn num_pairs(&self) -> usize {
        self.task.memories() as usize * self.task.num_cells()
    }

    /// The solution whose bounds and policy of the pairs are these; none without a policy.
    pub fn restored(&self, solution: Solution) -> Option<LandingSolution> {
        let Solution { values: with_memory, policy, status, iterations, history, .. } = solution;
        let values = ValueBounds {
            lower: self.arrivals::<Lower>(None, &with_memory.lower),
            upper: self.arrivals::<Upper>(None, &with_memory.upper),
        };
        let mut history: Vec<Vec<f64>> = history.into_iter().rev().collect();
        if !history.is_empty() {
            history.push(values.lower.clone());
        }
        Some(LandingSolution { values, with_memory, policy: policy?, history, status, iterations })
    }
}
