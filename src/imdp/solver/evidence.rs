//! What is recorded for a certificate.

use crate::certificate::Step;
use crate::model::{GrowingMemory, MemoryError, StateId};

/// The steps of a bounded query, as far as they changed anything.
pub(super) struct Recorder {
    states: usize,
    steps: Vec<Step>,
    /// How much memory the steps take.
    used: u64,
    memory: GrowingMemory,
}

impl Recorder {
    /// For so many states that can change.
    pub(super) fn new(states: usize) -> Self {
        Self { states, steps: vec![], used: 0, memory: GrowingMemory::new("the certificate") }
    }

    /// Begins a step.
    ///
    /// # Errors
    /// [`MemoryError`] if it may not fit into memory.
    pub(super) fn begin(&mut self) -> Result<(), MemoryError> {
        // Two bounds and a choice for every state; a list that grows may take twice what it holds.
        let next = size_of::<Step>() as u64 + 2 * 40 * self.states as u64;
        self.memory.make_room(self.used, next)?;
        self.steps.push(Step::default());
        Ok(())
    }

    /// Notes a new lower bound in the present step.
    pub(super) fn lower(&mut self, state: StateId, value: f64) {
        self.present().lower.push((state, value));
    }

    /// Notes a new upper bound in the present step.
    pub(super) fn upper(&mut self, state: StateId, value: f64) {
        self.present().upper.push((state, value));
    }

    fn present(&mut self) -> &mut Step {
        if self.steps.is_empty() {
            self.steps.push(Step::default());
        }
        let last = self.steps.len() - 1;
        &mut self.steps[last]
    }

    /// Ends the present step.
    pub(super) fn end(&mut self) {
        let step = self.present();
        step.lower.shrink_to_fit();
        step.upper.shrink_to_fit();
        let items = step.lower.len() + step.upper.len() + step.choices.len();
        self.used += (size_of::<Step>() + 16 * items) as u64;
    }

    /// Replaces the upper bounds by 1 from the first step on.
    pub(super) fn give_up_upper(&mut self, states: &[StateId]) {
        self.steps.iter_mut().for_each(|step| step.upper = vec![]);
        let ones = states.iter().map(|&s| (s, 1.0)).collect();
        match self.steps.first_mut() {
            Some(step) => step.upper = ones,
            None => self.steps.push(Step { upper: ones, ..Step::default() }),
        }
    }

    /// The steps, with a policy given as `(state, steps left, choice)`, ascending in the steps left.
    pub(super) fn finish(mut self, choices: &[(StateId, u64, u32)]) -> Vec<Step> {
        for &(state, left, choice) in choices {
            if let Some(step) = self.steps.get_mut(left as usize - 1) {
                step.choices.push((state, choice));
            }
        }
        while self.steps.last().is_some_and(|step| *step == Step::default()) {
            self.steps.pop();
        }
        self.steps
    }
}

/// The items of a table by state that are not the usual ones.
pub(super) fn unlike<T: Copy + PartialEq>(
    table: &[T],
    states: impl Iterator<Item = usize>,
    usual: T,
) -> Vec<(StateId, T)> {
    states.filter(|&s| table[s] != usual).map(|s| (StateId::from_index(s), table[s])).collect()
}
