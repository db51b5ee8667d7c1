//! The value function at every step that is shown.

use crate::landing::LandingSolution;
use crate::run::Run;
use imdp::solver::Answer;

/// Lower bounds on the value of every cell, rounded down, for the first steps.
#[derive(Clone, Debug)]
pub(super) struct StepValues {
    /// By grouped steps elapsed, then by cell; a single entry if they stay the same for ever.
    by_step: Vec<Vec<f32>>,
}

impl StepValues {
    /// The values of an answer and of the earlier steps that came with it.
    pub(super) fn of_answer(run: &Run, answer: &Answer) -> Self {
        let mut by_step = vec![of_cells(run, &answer.values.lower)];
        if !answer.query.complement {
            by_step.extend(answer.solution.history.iter().map(|values| of_cells(run, values)));
        }
        Self { by_step }
    }

    /// The values on a lattice, and of the earlier steps that came with them.
    pub(super) fn of_lattice(solution: &LandingSolution) -> Self {
        let rounded = |values: &Vec<f64>| values.iter().map(|&value| rounded_down(value)).collect();
        let fewer = solution.history.iter().rev().skip(1);
        Self { by_step: std::iter::once(&solution.values.lower).chain(fewer).map(rounded).collect() }
    }

    /// The last step that is kept.
    pub(super) fn last_step(&self) -> usize {
        self.by_step.len() - 1
    }

    /// The values of all cells after so many steps; what comes after the last is like the last.
    pub(super) fn at(&self, step: usize) -> &[f32] {
        &self.by_step[step.min(self.last_step())]
    }

    /// All values, step after step.
    pub(super) fn all(&self) -> impl Iterator<Item = f32> + '_ {
        self.by_step.iter().flatten().copied()
    }
}

fn of_cells(run: &Run, values: &[f64]) -> Vec<f32> {
    run.abstraction.state_of_cell.iter().map(|&state| rounded_down(values[state.index()])).collect()
}

/// The greatest single that is at most `x`.
fn rounded_down(x: f64) -> f32 {
    let near = x as f32;
    if f64::from(near) > x { near.next_down() } else { near }
}
