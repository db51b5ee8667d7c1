//! A property answered: bounds at the initial states and a verdict.

use super::{Query, Solution, SolveError, SolverOptions, solve};
use crate::imdp::{IntervalMdp, StateId};
use crate::property::{Objective, Property, PropertyError, Verdict};

/// What a property's question came to.
#[derive(Clone, Debug)]
pub struct Answer {
    /// What was asked.
    pub objective: Objective,
    /// Bounds on the value of every state (for `G`, already those of the property, not of its negation).
    pub solution: Solution,
    /// The least lower bound of all initial states.
    pub lower: f64,
    /// The greatest upper bound of all initial states.
    pub upper: f64,
    /// For thresholds: whether they hold in all initial states.
    pub verdict: Option<Verdict>,
}

/// Why a property has no answer.
#[derive(Debug, thiserror::Error)]
pub enum AnswerError {
    /// The property does not fit the model.
    #[error(transparent)]
    Property(#[from] PropertyError),
    /// The solver cannot take the question.
    #[error(transparent)]
    Solve(#[from] SolveError),
}

impl Answer {
    /// Solves `property` on `model`.
    ///
    /// # Errors
    /// [`AnswerError`] if the property does not fit the model.
    pub fn new(
        model: &IntervalMdp,
        property: &Property,
        options: &SolverOptions<'_>,
    ) -> Result<Self, AnswerError> {
        let objective = property.resolve(model.kind())?;
        let query = objective.query(model)?;
        let mut solution = solve(model, &Query::from(&query.kind), query.resolution, options)?;
        if query.complement {
            solution.values = solution.values.complement();
        }
        let initial = || model.initial().ones();
        let lower = initial().map(|s| solution.values.lower[s]).fold(1.0, f64::min);
        let upper = initial().map(|s| solution.values.upper[s]).fold(0.0, f64::max);
        let mut answer = Self { objective, solution, lower, upper, verdict: None };
        let verdicts: Option<Vec<Verdict>> = initial().map(|s| answer.verdict_of(s as StateId)).collect();
        answer.verdict = verdicts.map(|verdicts| all(&verdicts));
        Ok(answer)
    }

    /// Whether the threshold holds in one state; `None` if there is no threshold.
    pub fn verdict_of(&self, state: StateId) -> Option<Verdict> {
        let values = &self.solution.values;
        let bounds = (values.lower[state as usize], values.upper[state as usize]);
        self.objective.threshold.as_ref().map(|threshold| threshold.decide(bounds.0, bounds.1))
    }
}

/// Whether something holds everywhere.
fn all(verdicts: &[Verdict]) -> Verdict {
    if verdicts.contains(&Verdict::Fails) {
        Verdict::Fails
    } else if verdicts.contains(&Verdict::Unknown) {
        Verdict::Unknown
    } else {
        Verdict::Holds
    }
}
