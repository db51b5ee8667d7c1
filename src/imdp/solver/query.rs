//! What is asked of the solver.

use crate::model::{IntervalMdp, MemoryError, StateSet};
use crate::property::{QueryKind, Resolution};

/// An event whose probability is wanted, for every initial state at once.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a> {
    /// `safe U goal`, or `safe U<=k goal`. A goal state counts whether it is safe or not.
    Until {
        /// The states allowed on the way.
        safe: &'a StateSet,
        /// The states to be reached.
        goal: &'a StateSet,
        /// The number of steps `k`, if bounded.
        steps: Option<u64>,
    },
    /// `X goal`: the next state is a goal state.
    Next {
        /// The states to be reached.
        goal: &'a StateSet,
    },
}

impl<'a> From<&'a QueryKind> for Event<'a> {
    fn from(kind: &'a QueryKind) -> Self {
        match kind {
            QueryKind::Until { safe, goal, steps } => Self::Until { safe, goal, steps: *steps },
            QueryKind::Next { goal } => Self::Next { goal },
        }
    }
}

/// What makes a question unanswerable.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// A set is not about the states of the model.
    #[error("the set of {what} states: found {found} states; expected {states}, as many as the model has")]
    Length {
        /// Which set.
        what: &'static str,
        /// How many states it covers.
        found: usize,
        /// The number of states of the model.
        states: usize,
    },
    /// Rewards are to be summed up for ever without a discount.
    #[error(
        "found rewards without end, which may have no finite sum; expected a bound on the steps, as in C<=10, or a discount, as in C, discount=0.9"
    )]
    Undiscounted,
    /// The wanted distance of the bounds is not a positive number.
    #[error("found the epsilon {epsilon}; expected a positive number, such as 1e-6")]
    Epsilon {
        /// What was given.
        epsilon: f64,
    },
    /// What the solution takes does not fit into memory.
    #[error("{0}; solve without a certificate, with fewer steps, or a smaller model")]
    Memory(#[from] MemoryError),
}

impl Event<'_> {
    pub(super) fn check(&self, model: &IntervalMdp) -> Result<(), SolveError> {
        let states = model.num_states();
        let check = |what, set: &StateSet| match set.len() {
            found if found != states => Err(SolveError::Length { what, found, states }),
            _ => Ok(()),
        };
        match self {
            Self::Until { safe, goal, .. } => check("safe", safe).and(check("goal", goal)),
            Self::Next { goal } => check("goal", goal),
        }
    }
}

/// Which way one of the two players pulls.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Direction {
    Min,
    Max,
}

/// The directions of both players.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Players {
    pub policy: Direction,
    pub nature: Direction,
}

impl From<Resolution> for Players {
    fn from(resolution: Resolution) -> Self {
        use Direction::{Max, Min};
        let (policy, nature) = match resolution {
            Resolution::Pmaxmin => (Max, Min),
            Resolution::Pmaxmax => (Max, Max),
            Resolution::Pminmin => (Min, Min),
            Resolution::Pminmax => (Min, Max),
        };
        Self { policy, nature }
    }
}

impl Direction {
    /// Whether `a` is strictly preferred to `b`.
    pub(super) fn prefers(self, a: f64, b: f64) -> bool {
        match self {
            Self::Min => a < b,
            Self::Max => a > b,
        }
    }

    /// The other direction.
    pub(super) fn flipped(self) -> Self {
        match self {
            Self::Min => Self::Max,
            Self::Max => Self::Min,
        }
    }

    /// The value that every other is preferred to.
    pub(super) fn worst(self) -> f64 {
        match self {
            Self::Min => f64::INFINITY,
            Self::Max => f64::NEG_INFINITY,
        }
    }
}
