//! The value function at every step that is shown.

use crate::landing::LandingSolution;
use crate::partition::CellId;
use crate::run::{InputRun, Run};
use crate::task::{Aim, Memory};
use imdp::model::StateId;
use imdp::numeric::one_minus_down;
use imdp::solver::Answer;
use std::borrow::Cow;

/// Lower bounds on the value of every cell, rounded down, for the first steps.
#[derive(Clone, Debug)]
pub(super) struct StepValues {
    /// By grouped steps elapsed, then by cell; a single entry if they stay the same for ever.
    by_step: Vec<Vec<f32>>,
    /// Whether there were more.
    has_forgotten: bool,
}

impl StepValues {
    fn new(by_step: impl Iterator<Item = Vec<f32>>) -> Self {
        Self { by_step: by_step.collect(), has_forgotten: false }
    }

    /// The values of an answer and of the earlier steps that came with it.
    pub(super) fn of_answer(run: &Run, answer: &Answer) -> Self {
        let states = &run.abstraction.state_of_cell;
        Self::new(with_earlier(answer).map(|values| of_states(states, &values)))
    }

    /// The same on arrival with each memory before, if there are several.
    pub(super) fn of_memories(run: &Run, answer: &Answer) -> Vec<Self> {
        let (problem, abstraction) = (&run.problem, &run.abstraction);
        let (memories, cells) = (problem.cell_task().memories(), problem.grid().num_cells());
        if memories <= 1 {
            return vec![];
        }
        let arrivals = |before| -> Vec<StateId> {
            (0..cells).map(|cell| abstraction.arrival(problem, Some(before), CellId(cell))).collect()
        };
        let of_memory = |memory: Memory| match (problem.cell_task().aim(), problem.horizon()) {
            (Aim::End, Some(horizon)) => {
                // Memories of the model count the steps, so the values after a step are those of later states.
                let kept = answer.solution.history.len() as u64;
                let after = |step: u64| arrivals(step.max(1) as Memory * memories - memories + memory);
                let steps = 0..=kept.min(horizon);
                Self::new(steps.map(|step| of_states(&after(step), &answer.values.lower)))
            }
            _ => {
                let states = arrivals(memory);
                Self::new(with_earlier(answer).map(|values| of_states(&states, &values)))
            }
        };
        (0..memories).map(of_memory).collect()
    }

    /// The values on a lattice, and of the earlier steps that came with them.
    pub(super) fn of_lattice(solution: &LandingSolution) -> Self {
        let rounded = |values: &Vec<f64>| values.iter().map(|&value| rounded_down(value)).collect();
        let fewer = solution.history.iter().rev().skip(1);
        Self::new(std::iter::once(&solution.values.lower).chain(fewer).map(rounded))
    }

    /// The values on a lattice on arrival with each memory before, if there are several.
    pub(super) fn of_lattice_memories(run: &InputRun, solution: &LandingSolution) -> Vec<Self> {
        let (question, memories) = (run.abstraction.question(), run.problem.cell_task().memories());
        let of_memory = |memory| {
            let values = question.lower_on_arrival(memory, solution);
            Self::new(std::iter::once(values.into_iter().map(rounded_down).collect()))
        };
        if memories <= 1 { vec![] } else { (0..memories).map(of_memory).collect() }
    }

    /// Forgets the values after a step.
    pub(super) fn forget_after(&mut self, step: usize) {
        self.has_forgotten |= step < self.last_step();
        self.by_step.truncate(step + 1);
    }

    /// Whether values of later steps were forgotten.
    pub(super) fn has_forgotten(&self) -> bool {
        self.has_forgotten
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

/// The values of the states of cells.
fn of_states(states: &[StateId], values: &[f64]) -> Vec<f32> {
    states.iter().map(|&state| rounded_down(values[state.index()])).collect()
}

/// The values of an answer, then those with fewer steps left that came with it.
fn with_earlier(answer: &Answer) -> impl Iterator<Item = Cow<'_, [f64]>> {
    let of_property = |values: &Vec<f64>| values.iter().map(|&value| one_minus_down(value)).collect();
    let earlier = answer.solution.history.iter().map(move |values| match answer.query.complement {
        true => Cow::Owned(of_property(values)),
        false => Cow::Borrowed(&values[..]),
    });
    std::iter::once(Cow::Borrowed(&answer.values.lower[..])).chain(earlier)
}

/// The greatest single that is at most `x`.
fn rounded_down(x: f64) -> f32 {
    let near = x as f32;
    if f64::from(near) > x { near.next_down() } else { near }
}
