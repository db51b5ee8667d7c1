//! The value function at every step that is shown.

use crate::run::Run;
use imdp::property::QueryKind;
use imdp::solver::{Answer, AnswerError, Event, SolverOptions, solve};

/// The most steps for which values are kept.
const MOST_STEPS: u64 = 60;

/// The most values that are kept for all steps together: 2.4 MB.
const MOST_VALUES: u64 = 600_000;

/// Lower bounds on the value of every cell, rounded down, for the first steps.
#[derive(Clone, Debug)]
pub(super) struct StepValues {
    /// By grouped steps elapsed, then by cell; a single entry if they stay the same for ever.
    by_step: Vec<Vec<f32>>,
}

impl StepValues {
    pub(super) fn new(run: &Run, answer: &Answer, options: &SolverOptions<'_>) -> Result<Self, AnswerError> {
        let mut by_step = vec![of_cells(run, &answer.values.lower)];
        if let QueryKind::Until { safe, goal, steps: Some(horizon) } = &answer.query.kind {
            let cells = u64::from(run.problem.grid().num_cells());
            let last = (*horizon).min(MOST_STEPS).min((MOST_VALUES / cells).saturating_sub(1));
            let options = SolverOptions { policy: false, evidence: false, ..*options };
            for step in 1..=last {
                let query = Event::Until { safe, goal, steps: Some(horizon - step) };
                let solution = solve(&run.abstraction.model, &query, answer.query.resolution, &options)?;
                by_step.push(of_cells(run, &solution.values.lower));
            }
        }
        Ok(Self { by_step })
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
    run.abstraction.state_of_cell.iter().map(|&state| rounded_down(values[state as usize])).collect()
}

/// The greatest single that is at most `x`.
fn rounded_down(x: f64) -> f32 {
    let near = x as f32;
    if f64::from(near) > x { near.next_down() } else { near }
}
