//! Formulas and numbers that need no solver.

use super::expression::Evaluator;
use super::{EvaluationError, Numbers};
use crate::model::VariableValues;
use crate::numeric::Rational;
use crate::property::{PropertyError, numbers_states};

impl Evaluator<'_> {
    /// The values of a variable; without any variables, `x` is the number of the state, as it is for PRISM.
    pub(super) fn variable(&self, name: &str) -> Result<Numbers, EvaluationError> {
        let integer = |value: i64| Rational::from_integer(value.into());
        if numbers_states(name, self.model) {
            let states = self.model.num_states();
            self.require_numbers(states)?;
            return Ok(Numbers::Exact((0..states as i64).map(integer).collect()));
        }
        match self.model.variables().get(name).map(|variable| &variable.values) {
            Some(VariableValues::Int(values)) => {
                self.require_numbers(values.len())?;
                Ok(Numbers::Exact(values.iter().map(|&value| integer(value.into())).collect()))
            }
            Some(VariableValues::Bool(_)) => Err(PropertyError::NotInteger { name: name.to_owned() }.into()),
            None => {
                let known: Vec<_> =
                    self.model.variables().iter().map(|variable| variable.name.clone()).collect();
                let is_label = self.model.labels().get(name).is_some();
                let closest = is_label.then(|| format!("\"{name}\""));
                Err(PropertyError::UnknownVariable { name: name.to_owned(), closest, known }.into())
            }
        }
    }

    /// Exact numbers take about a hundred bytes each.
    pub(super) fn require_numbers(&self, states: usize) -> Result<(), EvaluationError> {
        crate::model::require_memory("the values of an expression", 100 * states as u64)?;
        Ok(())
    }
}
