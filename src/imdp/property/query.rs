//! The normal form that a solver computes.

use super::evaluate::{all_states, complement};
use super::{Objective, PathFormula, PropertyError, Resolution};
use crate::model::{IntervalMdp, StateSet};
use crate::numeric::{one_minus_down, one_minus_up};

/// A value to compute: the probability of an event, or 1 minus it.
///
/// `G φ` is the complement of `F ¬φ`, for which both players change direction:
/// `Pmaxmin[G φ] = 1 − Pminmax[F ¬φ]`, and so on for the other three. The resolution here is the one
/// to compute the event with, so that of `Pmaxmin[G φ]` is `Pminmax`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Query {
    /// Who maximises and who minimises the probability of the event.
    pub resolution: Resolution,
    /// The event.
    pub kind: QueryKind,
    /// Whether the value asked for is 1 minus the probability of the event.
    pub complement: bool,
}

/// An event in terms of sets of states.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum QueryKind {
    /// Reaching `goal` within `steps` steps through `safe` states only.
    Until {
        /// Where a path may be before it reaches the goal; it may contain goal states.
        safe: StateSet,
        /// Where a path succeeds, safe or not.
        goal: StateSet,
        /// The number of steps, if bounded; with 0 only the goal itself succeeds.
        steps: Option<u64>,
    },
    /// Being in `goal` after exactly one step.
    Next {
        /// Where a path succeeds.
        goal: StateSet,
    },
}

impl Objective {
    /// The objective in terms of the states of `model`.
    ///
    /// # Errors
    /// [`PropertyError`] if a formula names what the model does not have.
    pub fn query(&self, model: &IntervalMdp) -> Result<Query, PropertyError> {
        let (kind, complement) = match &self.path {
            PathFormula::Next(formula) => (QueryKind::Next { goal: formula.evaluate(model)? }, false),
            PathFormula::Finally { formula, steps } => {
                (reach(formula.evaluate(model)?, *steps, model), false)
            }
            PathFormula::Globally { formula, steps } => {
                (reach(complement(formula.evaluate(model)?), *steps, model), true)
            }
            PathFormula::Until { left, right, steps } => {
                let (safe, goal) = (left.evaluate(model)?, right.evaluate(model)?);
                (QueryKind::Until { safe, goal, steps: *steps }, false)
            }
        };
        let resolution = if complement { self.resolution.flipped() } else { self.resolution };
        Ok(Query { resolution, kind, complement })
    }
}

impl Query {
    /// Bounds on the value asked for, from bounds on the probability of the event.
    ///
    /// `[l, u]` stays or becomes `[1 − u, 1 − l]`, rounded outwards.
    pub fn value_bounds(&self, lower: f64, upper: f64) -> (f64, f64) {
        if !self.complement {
            return (lower, upper);
        }
        (one_minus_down(upper), one_minus_up(lower))
    }
}

fn reach(goal: StateSet, steps: Option<u64>, model: &IntervalMdp) -> QueryKind {
    QueryKind::Until { safe: all_states(model), goal, steps }
}
