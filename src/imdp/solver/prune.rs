//! Keeping only what matters: the choices that an optimal policy makes.
//!
//! Let `M` be a model, `φ` a path formula, and `π` a policy of which the solver has proved that it guarantees
//! `L ≤ V_π` against the nature that `φ`'s operator asks for; `π` may depend on the number of steps left. Let
//! `M'` be `M` with only those choices that `π` makes at some time. For a maximising policy
//!
//! ```text
//! L ≤ V_π(M') ≤ V(M') ≤ V(M) ≤ U
//! ```
//!
//! - `V_π(M')` is `V_π(M)`: the choices that `π` makes are all there, with the same rows, and nature chooses
//!   from these rows only.
//! - `V_π(M') ≤ V(M')` because `π` is one of the policies of `M'`.
//! - `V(M') ≤ V(M)` because every policy of `M'` is one of `M`: to restrict choices can only lower a maximum.
//!
//! So `M'` has the value of `M` to within the distance of the solver's bounds: rounding errors with a bound on
//! the steps, `epsilon` without. For a minimising policy the inequalities turn round. In a bounded computation
//! `π` takes the first choice that is best for the lower bounds and keeps it as long as it stays best. Without
//! a bound on the steps the greedy choice can be wrong (a loop may look as good as the way out of it), so `π`
//! takes the choices by which the lower bounds were raised. Where `π` has nothing to decide, the
//! first choice stays, so that no state becomes a deadlock.
//!
//! Nothing is said about other formulas or operators: their values may be anything in `M'`.
//!
//! That `M'` keeps the value is not left to this argument alone: it is solved again and compared.

use super::{Answer, AnswerError, SolverOptions, Status};
use crate::model::{ImdpError, IntervalMdp, restrict};
use crate::property::Property;

/// How far rounding may move a bound of a step-bounded value.
const ROUNDING: f64 = 1e-12;

/// A model reduced to the choices of an optimal policy for one property.
#[derive(Clone, Debug)]
pub struct Pruned {
    /// What is left.
    pub model: IntervalMdp,
    /// The answer of the whole model.
    pub before: Answer,
    /// The answer of what is left.
    pub after: Answer,
}

/// Why a model cannot be pruned.
#[derive(Debug, thiserror::Error)]
pub enum PruneError {
    /// The property has no answer.
    #[error(transparent)]
    Answer(#[from] AnswerError),
    /// The computation was stopped before its policy was optimal.
    #[error(
        "found a computation that ended early ({status}); expected its end, to know which actions matter"
    )]
    Unfinished {
        /// How it ended.
        status: Status,
    },
    /// The reduced model does not have the value that it must have.
    #[error("found the value [{}, {}] of the pruned model; expected that of the whole one, [{}, {}]", .after.0, .after.1, .before.0, .before.1)]
    Value {
        /// Bounds for the whole model.
        before: (f64, f64),
        /// Bounds for what is left of it.
        after: (f64, f64),
    },
    /// What is left is no model.
    #[error(transparent)]
    Model(#[from] ImdpError),
}

impl Pruned {
    /// Solves `property` and keeps the choices that the policy found makes at some time.
    ///
    /// # Errors
    /// [`PruneError`] if the property does not fit, the computation is stopped, or the value would change.
    pub fn new(
        model: &IntervalMdp,
        property: &Property,
        options: &SolverOptions<'_>,
    ) -> Result<Self, PruneError> {
        let before = finished(Answer::new(model, property, &SolverOptions { policy: true, ..*options })?)?;
        let pruned = match &before.solution.policy {
            Some(policy) => restrict(model, |state, choice| {
                let changes = policy.changes(state);
                changes.iter().any(|&(_, made)| made == choice) || (changes.is_empty() && choice == 0)
            })?,
            None => model.clone(),
        };
        let after = finished(Answer::new(&pruned, property, options)?)?;
        let pruned = Self { model: pruned, before, after };
        pruned.check(options.epsilon)?;
        Ok(pruned)
    }

    /// Checks every state's value, as far as the bounds tell.
    fn check(&self, epsilon: f64) -> Result<(), PruneError> {
        let bounded = self.before.solution.policy.as_ref().is_some_and(|policy| policy.horizon().is_some());
        let slack = if bounded { ROUNDING } else { epsilon.max(self.before.values.gap()) };
        let (before, after) = (&self.before.values, &self.after.values);
        let states = 0..self.model.num_states();
        let apart = |s: usize| (before.lower[s] - after.upper[s]).max(after.lower[s] - before.upper[s]);
        let loose = |s: usize| after.upper[s] - after.lower[s] - (before.upper[s] - before.lower[s]);
        match states.into_iter().find(|&s| apart(s) > slack || loose(s) > slack) {
            None => Ok(()),
            Some(s) => Err(PruneError::Value {
                before: (before.lower[s], before.upper[s]),
                after: (after.lower[s], after.upper[s]),
            }),
        }
    }
}

fn finished(answer: Answer) -> Result<Answer, PruneError> {
    match answer.solution.status {
        Status::HorizonReached | Status::Converged | Status::PrecisionLimit => Ok(answer),
        status => Err(PruneError::Unfinished { status }),
    }
}
