//! Where a formula holds, as far as it is known.

use super::EvaluationError;
use crate::model::StateSet;
use crate::property::Verdict;

/// The states in which a formula holds for certain, and those in which it may.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Truth {
    pub(super) must: StateSet,
    pub(super) may: StateSet,
}

impl Truth {
    /// A formula that holds in exactly these states.
    pub(super) fn exact(states: StateSet) -> Self {
        Self { may: states.clone(), must: states }
    }

    /// The same everywhere.
    pub(super) fn constant(value: bool, states: usize) -> Self {
        let mut set = StateSet::with_capacity(states);
        set.set_range(.., value);
        Self::exact(set)
    }

    /// From what is known state by state.
    pub(super) fn of_verdicts(verdicts: impl ExactSizeIterator<Item = Verdict>) -> Self {
        let states = verdicts.len();
        let mut truth = Self { must: StateSet::with_capacity(states), may: StateSet::with_capacity(states) };
        for (state, verdict) in verdicts.enumerate() {
            truth.must.set(state, verdict == Verdict::Holds);
            truth.may.set(state, verdict != Verdict::Fails);
        }
        truth
    }

    /// What is known of a state.
    pub fn verdict(&self, state: usize) -> Verdict {
        match (self.must.contains(state), self.may.contains(state)) {
            (true, _) => Verdict::Holds,
            (false, true) => Verdict::Unknown,
            (false, false) => Verdict::Fails,
        }
    }

    /// Whether everything is known.
    pub(super) fn is_exact(&self) -> bool {
        self.must == self.may
    }

    /// The states in which it holds, if everything is known.
    pub(super) fn decided(&self) -> Result<&StateSet, EvaluationError> {
        match self.may.difference(&self.must).next() {
            None => Ok(&self.must),
            Some(state) => Err(EvaluationError::Undecided { state }),
        }
    }

    /// What follows from this and from something else that is known of the same formula.
    pub(super) fn refined(mut self, other: &Self) -> Self {
        self.must.union_with(&other.must);
        self.may.intersect_with(&other.may);
        self
    }

    /// Where it does not hold.
    pub(super) fn not(mut self) -> Self {
        self.must.toggle_range(..);
        self.may.toggle_range(..);
        Self { must: self.may, may: self.must }
    }

    /// Where both hold.
    pub(super) fn and(mut self, other: &Self) -> Self {
        self.must.intersect_with(&other.must);
        self.may.intersect_with(&other.may);
        self
    }

    /// Where one of both holds.
    pub(super) fn or(mut self, other: &Self) -> Self {
        self.must.union_with(&other.must);
        self.may.union_with(&other.may);
        self
    }

    /// Where both or neither hold.
    pub(super) fn iff(self, other: &Self) -> Self {
        let both = self.clone().and(other);
        both.or(&self.not().and(&other.clone().not()))
    }
}
