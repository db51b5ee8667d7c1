//! A number in every state.

use crate::numeric::{Rational, to_f64_down, to_f64_up};
use crate::solver::ValueBounds;
use num_traits::One;
use std::collections::BTreeMap;

/// A number in every state, exactly or between bounds.
#[derive(Clone, Debug)]
pub enum Numbers {
    /// The same number in all of so many states.
    Constant(Rational, usize),
    /// A number for each state.
    Exact(Vec<Rational>),
    /// Bounds for each state, and exact numbers where they were asked for.
    Bounds(Known),
}

/// What is known about a number in every state.
#[derive(Clone, Debug)]
pub struct Known {
    /// Bounds; they may be infinite.
    pub bounds: ValueBounds,
    /// The number itself, where a comparison asked for it and it could be had.
    pub exact: BTreeMap<usize, Rational>,
}

impl Known {
    /// Bounds alone.
    pub(super) fn within(lower: Vec<f64>, upper: Vec<f64>) -> Self {
        Self { bounds: ValueBounds { lower, upper }, exact: BTreeMap::new() }
    }

    /// 1 minus the number, rounded outwards.
    pub(super) fn complement(&self) -> Self {
        let exact = self.exact.iter().map(|(&state, value)| (state, Rational::one() - value)).collect();
        Self { bounds: self.bounds.complement(), exact }
    }
}

impl Numbers {
    /// The number of states.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Constant(_, states) => *states,
            Self::Exact(values) => values.len(),
            Self::Bounds(known) => known.bounds.lower.len(),
        }
    }

    /// The number in a state, if it is known exactly.
    pub(super) fn exact(&self, state: usize) -> Option<&Rational> {
        match self {
            Self::Constant(value, _) => Some(value),
            Self::Exact(values) => values.get(state),
            Self::Bounds(known) => known.exact.get(&state),
        }
    }

    /// Whether the number is known exactly in every state.
    pub(super) fn is_exact(&self) -> bool {
        !matches!(self, Self::Bounds(_))
    }

    /// Bounds on the number in a state.
    pub fn bounds(&self, state: usize) -> (f64, f64) {
        match (self, self.exact(state)) {
            (Self::Bounds(Known { bounds, .. }), None) => (bounds.lower[state], bounds.upper[state]),
            (_, Some(exact)) => (to_f64_down(exact), to_f64_up(exact)),
            (_, None) => (f64::NEG_INFINITY, f64::INFINITY),
        }
    }

    /// A number that is the same in all of so many states.
    pub(super) fn constant_bounds((lower, upper): (f64, f64), states: usize) -> Self {
        Self::Bounds(Known::within(vec![lower; states], vec![upper; states]))
    }
}
