//! A property answered: bounds at the initial states and a verdict.

use super::exact::settle;
use super::extremes::Extremes;
use super::{Event, Inexact, Solution, SolveError, SolverOptions, Status, ValueBounds, solve};
use crate::certificate::{Certificate, FileDigest};
use crate::model::{IntervalMdp, StateId, StateSet};
use crate::numeric::Rational;
use crate::property::{Objective, Property, PropertyError, Query, Threshold, Verdict};
use num_traits::One;
use std::collections::BTreeMap;

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
    /// The exact values, by state, where the threshold lies between the bounds.
    pub exact: BTreeMap<StateId, Rational>,
    /// Why the threshold is not decided, if so.
    pub inexact: Option<Inexact>,
    /// Where the value is 0 and where it is 1, if that decides the threshold and exact values would have been too long.
    extremes: Option<Extremes>,
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
        Ok(Self::assemble(model, objective, query, solution, options))
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
        Ok(Self::assemble(model, objective, query, solution, &SolverOptions::default()))
    }

    fn assemble(
        model: &IntervalMdp,
        objective: Objective,
        query: Query,
        solution: Solution,
        options: &SolverOptions<'_>,
    ) -> Self {
        let values = ValueBounds { lower: vec![], upper: vec![] };
        let (lower, upper, verdict, exact, inexact) = (0.0, 1.0, None, BTreeMap::new(), None);
        let extremes = None;
        let mut answer =
            Self { objective, query, solution, values, lower, upper, verdict, exact, inexact, extremes };
        answer.summarise(model);
        if answer.verdict == Some(Verdict::Unknown) {
            answer.inexact = answer.decide(model, options).err();
            let by_graph = |threshold: &Threshold| threshold.is_extreme();
            if matches!(answer.inexact, Some(Inexact::TooLarge | Inexact::Unproved))
                && answer.objective.threshold.as_ref().is_some_and(by_graph)
            {
                let event = Event::from(&answer.query.kind);
                answer.extremes = Some(Extremes::new(model, &event, answer.query.resolution));
                answer.inexact = None;
            }
            answer.summarise(model);
        }
        answer
    }

    /// What follows from the solution for the value of the property.
    fn summarise(&mut self, model: &IntervalMdp) {
        let values = &self.solution.values;
        self.values = if self.query.complement { values.complement() } else { values.clone() };
        let initial = || model.initial().ones();
        self.lower = initial().map(|s| self.values.lower[s]).fold(1.0, f64::min);
        self.upper = initial().map(|s| self.values.upper[s]).fold(0.0, f64::max);
        let verdicts: Option<Vec<Verdict>> =
            initial().map(|s| self.verdict_of(StateId::from_index(s))).collect();
        self.verdict = verdicts.map(Verdict::in_all);
    }

    /// Computes the values of the states in which the threshold lies between the bounds exactly; if that is too much, only
    /// those of initial states.
    fn decide(&mut self, model: &IntervalMdp, options: &SolverOptions<'_>) -> Result<(), Inexact> {
        if matches!(self.solution.status, Status::IterationLimit | Status::TimeLimit | Status::Interrupted) {
            return Err(Inexact::Stopped);
        }
        let undecided = |s: &usize| self.verdict_of(StateId::from_index(*s)) == Some(Verdict::Unknown);
        let mut wanted = StateSet::with_capacity(model.num_states());
        (0..model.num_states()).filter(undecided).for_each(|s| wanted.insert(s));
        let (event, players) = (Event::from(&self.query.kind), self.query.resolution.into());
        // What evidence and policy there is tells what is wanted of them.
        let options = SolverOptions {
            policy: self.solution.policy.is_some(),
            evidence: self.solution.evidence.is_some(),
            ..*options
        };
        let mut settle =
            |wanted: &StateSet| settle(model, &event, players, (&mut self.solution, wanted), &options);
        let values = settle(&wanted).or_else(|reason| {
            let all = wanted.clone();
            wanted.intersect_with(model.initial());
            if reason == Inexact::TooLarge && wanted != all { settle(&wanted) } else { Err(reason) }
        })?;
        let value = |value| if self.query.complement { Rational::one() - value } else { value };
        self.exact = values.into_iter().map(|(s, exact)| (s, value(exact))).collect();
        Ok(())
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
        let threshold = self.objective.threshold.as_ref()?;
        Some(match (self.exact.get(&state), &self.extremes) {
            (Some(value), _) => threshold.decide_exactly(value, value),
            (None, Some(extremes)) => {
                let value = extremes.stand_in(state.index());
                let value = if self.query.complement { Rational::one() - value } else { value };
                threshold.decide_exactly(&value, &value)
            }
            _ => threshold.decide(self.values.lower[state.index()], self.values.upper[state.index()]),
        })
    }
}
