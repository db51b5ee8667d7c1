//! An engine's strategy, and what it is worth on our model.

use super::EngineFailure;
use super::values::shortened;
use crate::compare::CompareError;
use crate::compare::backup::Backup;
use crate::formats::PolicyEntry;
use crate::model::{IntervalMdp, StateId, restrict};
use crate::property::{Query, QueryKind, Resolution};
use crate::solver::{Event, SolverOptions, solve};
use std::collections::HashMap;

/// The index of the choice taken in a state, always or after a number of steps.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Strategy {
    choices: HashMap<(StateId, Option<u64>), u32>,
}

impl Strategy {
    /// Reads lines `state=choice` or `state,step=choice`; a step counts the steps elapsed.
    ///
    /// # Errors
    /// [`EngineFailure::Strategy`] if a line is not of this form or names a choice that its state does not have.
    pub fn parse(text: &str, model: &IntervalMdp) -> Result<Self, EngineFailure> {
        let mut choices = HashMap::new();
        for (line, entry) in PolicyEntry::read(text) {
            let refuse = |found: &str, expected: &str| EngineFailure::Strategy {
                line,
                found: shortened(found),
                expected: expected.to_owned(),
            };
            let entry = entry.map_err(|error| refuse(&error.found, error.expected))?;
            let (state, choice) = (entry.state, entry.action.parse::<u32>().ok());
            let is_known = state.index() < model.num_states();
            let choice = choice.filter(|&choice| is_known && choice < num_choices(model, state));
            let Some(choice) = choice else {
                let expected = "a state of the model and the index of one of its choices";
                return Err(refuse(&entry.to_string(), expected));
            };
            choices.insert((state, entry.step), choice);
        }
        Ok(Self { choices })
    }

    /// The number of its decisions.
    pub fn len(&self) -> usize {
        self.choices.len()
    }

    /// Whether it decides nothing.
    pub fn is_empty(&self) -> bool {
        self.choices.is_empty()
    }

    fn choice(&self, state: StateId, step: u64) -> Option<u32> {
        self.choices.get(&(state, Some(step))).or_else(|| self.choices.get(&(state, None))).copied()
    }

    /// The probability of the query's event that the strategy attains in every state, whatever the policy does
    /// where the strategy does not say: those decisions are taken against it.
    ///
    /// # Errors
    /// [`CompareError`] if the query does not fit the model.
    pub fn attained(
        &self,
        model: &IntervalMdp,
        query: &Query,
        options: &SolverOptions<'_>,
    ) -> Result<Vec<f64>, CompareError> {
        match query.kind {
            QueryKind::Until { steps: None, .. } => self.attained_for_ever(model, query, options),
            QueryKind::Until { steps: Some(steps), .. } => Ok(self.attained_within(model, query, steps)),
            QueryKind::Next { .. } => Ok(self.attained_within(model, query, 1)),
        }
    }

    fn attained_within(&self, model: &IntervalMdp, query: &Query, steps: u64) -> Vec<f64> {
        let backup = Backup::new(model, query);
        let worst: fn(f64, f64) -> f64 =
            if query.resolution.policy_maximises() { f64::min } else { f64::max };
        let mut values = backup.initial();
        for elapsed in (0..steps).rev() {
            values = backup.step_by(&values, |state, row_value| {
                let mut rows = model.choices().rows(state);
                match self.choice(state, elapsed) {
                    Some(choice) => rows.nth(choice as usize).map(row_value),
                    None => rows.map(row_value).reduce(worst),
                }
            });
        }
        values
    }

    fn attained_for_ever(
        &self,
        model: &IntervalMdp,
        query: &Query,
        options: &SolverOptions<'_>,
    ) -> Result<Vec<f64>, CompareError> {
        let failure = |error| CompareError::Strategy { error };
        let keeps = |state, choice| self.choice(state, 0).is_none_or(|taken| taken == choice);
        let induced = restrict(model, keeps).map_err(failure)?;
        let solved = solve(&induced, &Event::from(&query.kind), against(query.resolution), options);
        let solved = solved
            .map_err(|error| CompareError::Solve { property: "the engine's strategy".into(), error })?;
        let maximises = query.resolution.policy_maximises();
        Ok(if maximises { solved.values.lower } else { solved.values.upper })
    }
}

/// The same nature, with a policy that pulls the other way.
fn against(resolution: Resolution) -> Resolution {
    match resolution {
        Resolution::Pmaxmin => Resolution::Pminmin,
        Resolution::Pmaxmax => Resolution::Pminmax,
        Resolution::Pminmin => Resolution::Pmaxmin,
        Resolution::Pminmax => Resolution::Pmaxmax,
    }
}

/// The number of choices as they are written: the self-loop of an absorbing state or a deadlock is one.
fn num_choices(model: &IntervalMdp, state: StateId) -> u32 {
    let rows: usize = model.choices().ranges(state).iter().map(|range| range.len()).sum();
    rows.max(1) as u32
}
