//! A number in every state.

use crate::numeric::{Rational, to_f64_down, to_f64_up};
use crate::solver::ValueBounds;

/// A number in every state, exactly or between bounds.
#[derive(Clone, Debug)]
pub enum Numbers {
    /// The same number in all of so many states.
    Constant(Rational, usize),
    /// A number for each state.
    Exact(Vec<Rational>),
    /// Bounds for each state; they may be infinite.
    Bounds(ValueBounds),
}

impl Numbers {
    /// The number of states.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Constant(_, states) => *states,
            Self::Exact(values) => values.len(),
            Self::Bounds(bounds) => bounds.lower.len(),
        }
    }

    /// The number in a state, if it is known exactly.
    pub(super) fn exact(&self, state: usize) -> Option<&Rational> {
        match self {
            Self::Constant(value, _) => Some(value),
            Self::Exact(values) => values.get(state),
            Self::Bounds(_) => None,
        }
    }

    /// Bounds on the number in a state.
    pub fn bounds(&self, state: usize) -> (f64, f64) {
        match (self, self.exact(state)) {
            (Self::Bounds(bounds), _) => (bounds.lower[state], bounds.upper[state]),
            (_, Some(exact)) => (to_f64_down(exact), to_f64_up(exact)),
            (_, None) => (f64::NEG_INFINITY, f64::INFINITY),
        }
    }

    /// A number that is the same in all of so many states.
    pub(super) fn constant_bounds((lower, upper): (f64, f64), states: usize) -> Self {
        Self::Bounds(ValueBounds { lower: vec![lower; states], upper: vec![upper; states] })
    }
}
