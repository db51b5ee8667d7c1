//! Expressions of PRISM's language on a model: everything that a properties file can ask.
//!
//! Formulas are evaluated to the states in which they hold for certain and those in which they may hold: a threshold within
//! the bounds of a value is not decided. Numbers are exact as long as no probability or reward is involved, and bounds from
//! then on, rounded outwards in every operation.

mod automaton;
mod checker;
mod cosafe;
mod derivation;
mod directions;
mod error;
mod exact;
mod expression;
mod filter;
mod interval;
mod numbers;
mod omega;
mod operator;
mod path;
mod product;
mod syntax;
mod truth;
mod values;

pub use derivation::check_derivation;
pub use directions::direct;
pub use error::EvaluationError;
pub use numbers::{Known, Numbers};
pub use truth::Truth;
pub use values::Values;

use crate::certificate::{Derivation, Evidence, FileDigest};
use crate::model::{IntervalMdp, StateId};
use crate::property::{Compound, Nature, Verdict};
use crate::solver::{Inexact, Policy, SolverOptions, Status, ValueBounds};
use expression::Evaluator;

/// An expression answered.
#[derive(Clone, Debug)]
pub struct Evaluation {
    /// What it comes to.
    pub values: Values,
    /// How the computations ended: the least satisfactory of all of them.
    pub status: Status,
    /// The number of iterations of all of them.
    pub iterations: u64,
    /// Why an exact value that a comparison asked for could not be had, if so.
    pub inexact: Option<Inexact>,
    /// The policy, if the expression is a single operator and it was asked for.
    pub policy: Option<Policy>,
    /// What proves the values of the operators in it, in the order of their evaluation, if that was asked for and there is
    /// something for all of them.
    pub evidence: Option<Vec<Evidence>>,
}

impl Evaluation {
    /// Evaluates an expression.
    ///
    /// # Errors
    /// [`EvaluationError`] if it does not fit the model, or cannot be solved.
    pub fn new(
        model: &IntervalMdp,
        compound: &Compound,
        nature: Option<Nature>,
        options: &SolverOptions<'_>,
    ) -> Result<Self, EvaluationError> {
        let mut evaluator = Evaluator::new(model, nature, *options);
        let values = evaluator.values(&compound.root)?;
        let evidence =
            (options.evidence && !evaluator.is_unproved).then(|| std::mem::take(&mut evaluator.evidence));
        let Evaluator { status, iterations, inexact, .. } = evaluator;
        Ok(Self { values, status, iterations, inexact, policy: evaluator.finish(), evidence })
    }

    /// The certificate of this evaluation of `compound`, for a model read from `files`; none if something in it has no proof.
    ///
    /// The evidence, which may be large, moves into it.
    pub fn derivation(
        &mut self,
        compound: &Compound,
        nature: Option<Nature>,
        model: &IntervalMdp,
        files: Vec<FileDigest>,
    ) -> Option<Derivation> {
        let proofs = self.evidence.take()?;
        let (expression, states) = (compound.resolved(), model.num_states() as u64);
        Some(Derivation { expression, nature, files, states, claim: self.values.claim(model), proofs })
    }

    /// Bounds on the value in a state; none if it is a formula.
    pub fn bounds(&self, state: StateId) -> Option<(f64, f64)> {
        match &self.values {
            Values::Numbers(numbers) => Some(numbers.bounds(state.index())),
            Values::Truth(_) => None,
        }
    }

    /// Bounds in every state; of a formula, 1 where it holds and 0 where it does not.
    pub fn value_bounds(&self, states: usize) -> ValueBounds {
        let of_verdict = |verdict| match verdict {
            Verdict::Holds => (1.0, 1.0),
            Verdict::Fails => (0.0, 0.0),
            Verdict::Unknown => (0.0, 1.0),
        };
        let of_state = |state| match &self.values {
            Values::Numbers(numbers) => numbers.bounds(state),
            Values::Truth(truth) => of_verdict(truth.verdict(state)),
        };
        let (lower, upper) = (0..states).map(of_state).unzip();
        ValueBounds { lower, upper }
    }

    /// Whether the formula holds in a state; none if it is a number.
    pub fn verdict(&self, state: StateId) -> Option<Verdict> {
        match &self.values {
            Values::Truth(truth) => Some(truth.verdict(state.index())),
            Values::Numbers(_) => None,
        }
    }
}

#[cfg(test)]
mod tests;
