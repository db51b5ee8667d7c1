//! A property answered: bounds at the initial states and a verdict.

use super::{Event, Solution, SolveError, SolverOptions, ValueBounds, solve};
use crate::certificate::{Certificate, FileDigest};
use crate::model::{IntervalMdp, StateId};
use crate::property::{Objective, Property, PropertyError, Query, Verdict};

/// What a property's question came to.
#[derive(Clone, Debug)]
pub struct Answer {
    /// What was asked.
    pub objective: Objective,
    /// The query that it became.
    pub query: Query,
    /// The solution of the query: for `G`, that of the complement.
    pub solution: Solution,
    /// Bounds on the value of every state.
    pub values: ValueBounds,
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
        let solution = solve(model, &Event::from(&query.kind), query.resolution, options)?;
        Ok(Self::assemble(model, objective, query, solution))
    }

    /// What a solution that was computed before says about `property` on `model`.
    ///
    /// # Errors
    /// [`AnswerError`] if the property does not fit the model.
    pub fn of_solution(
        model: &IntervalMdp,
        property: &Property,
        solution: Solution,
    ) -> Result<Self, AnswerError> {
        let objective = property.resolve(model.kind())?;
        let query = objective.query(model)?;
        Ok(Self::assemble(model, objective, query, solution))
    }

    fn assemble(model: &IntervalMdp, objective: Objective, query: Query, solution: Solution) -> Self {
        let values = if query.complement { solution.values.complement() } else { solution.values.clone() };
        let initial = || model.initial().ones();
        let lower = initial().map(|s| values.lower[s]).fold(1.0, f64::min);
        let upper = initial().map(|s| values.upper[s]).fold(0.0, f64::max);
        let mut answer = Self { objective, query, solution, values, lower, upper, verdict: None };
        let verdicts: Option<Vec<Verdict>> =
            initial().map(|s| answer.verdict_of(StateId::from_index(s))).collect();
        answer.verdict = verdicts.map(Verdict::in_all);
        answer
    }

    /// The certificate of this answer to `property`, for a model read from `files`.
    ///
    /// The evidence, which may be large, moves into it: `None` the second time, or if the options did not
    /// ask for evidence.
    pub fn certificate(&mut self, property: &Property, files: Vec<FileDigest>) -> Option<Certificate> {
        let evidence = self.solution.evidence.take()?;
        let (property, states) = (property.clone(), self.values.lower.len() as u64);
        Some(Certificate { property, files, states, lower: self.lower, upper: self.upper, evidence })
    }

    /// Whether the threshold holds in all initial states; `None` if undecided or if there is no threshold.
    pub fn satisfied(&self) -> Option<bool> {
        match self.verdict? {
            Verdict::Holds => Some(true),
            Verdict::Fails => Some(false),
            Verdict::Unknown => None,
        }
    }

    /// Whether the threshold holds in one state; `None` if there is no threshold.
    pub fn verdict_of(&self, state: StateId) -> Option<Verdict> {
        let bounds = (self.values.lower[state.index()], self.values.upper[state.index()]);
        self.objective.threshold.as_ref().map(|threshold| threshold.decide(bounds.0, bounds.1))
    }
}
