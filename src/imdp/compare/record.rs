//! What is known of one side of a comparison.

use super::{CompareError, ModelDigest, PolicyFile, RecordedResult, Sizes};
use crate::formats::StateValues;
use crate::model::IntervalMdp;
use crate::property::Property;
use crate::solver::{Answer, AnswerError, SolverOptions};

/// What is known of one side of a comparison; any part may be missing.
#[derive(Clone, Debug, Default)]
pub struct Record {
    /// Where it comes from.
    pub name: String,
    /// What it is about.
    pub title: String,
    /// The model.
    pub model: Option<IntervalMdp>,
    /// How large the model is.
    pub sizes: Option<Sizes>,
    /// The digest of the model, where there is only that.
    pub digest: Option<ModelDigest>,
    /// The model's properties.
    pub properties: Vec<Property>,
    /// Answers to properties.
    pub results: Vec<RecordedResult>,
    /// The answer in every state, to the first property.
    pub values: Option<StateValues>,
    /// A policy for the first property.
    pub policy: Option<PolicyFile>,
    /// What the user should know about it.
    pub notes: Vec<String>,
}

impl Record {
    /// A model and its properties.
    pub fn of_model(name: impl Into<String>, model: IntervalMdp, properties: Vec<Property>) -> Self {
        let name = name.into();
        let (title, sizes) = (name.clone(), Some(Sizes::new(&model)));
        Self { name, title, model: Some(model), sizes, properties, ..Self::default() }
    }

    /// Solves the model's properties that have no result yet, and the first one for values.
    ///
    /// # Errors
    /// [`CompareError`] if a property is not about the model.
    pub fn solve(&mut self) -> Result<(), CompareError> {
        for property in self.properties.clone() {
            self.solve_property(&property)?;
        }
        Ok(())
    }

    /// Solves a property if it has no result, or for values if there are none and it is the first.
    pub(super) fn solve_property(&mut self, property: &Property) -> Result<(), CompareError> {
        let Some(model) = &self.model else { return Ok(()) };
        let text = property.to_string();
        let known = self.results.iter().any(|result| result.property == text);
        let first = self.properties.first().is_none_or(|first| first == property);
        if known && !(first && self.values.is_none()) {
            return Ok(());
        }
        let answer = answer(model, property)?;
        if first && self.values.is_none() {
            self.values = Some(StateValues::Numbers(answer.values.lower.clone()));
        }
        if !known {
            self.results.push(RecordedResult {
                property: text,
                lower: Some(answer.lower),
                upper: Some(answer.upper),
                satisfied: answer.satisfied(),
                status: Some(answer.solution.status.to_string()),
                ..RecordedResult::default()
            });
        }
        Ok(())
    }
}

/// The answer to a property with the solver's defaults.
pub(super) fn answer(model: &IntervalMdp, property: &Property) -> Result<Answer, CompareError> {
    answer_within(model, property, &SolverOptions::default())
}

/// The answer to a property.
pub(crate) fn answer_within(
    model: &IntervalMdp,
    property: &Property,
    options: &SolverOptions<'_>,
) -> Result<Answer, CompareError> {
    let property_text = || property.to_string();
    Answer::new(model, property, options).map_err(|error| match error {
        AnswerError::Property(error) => CompareError::Property { property: property_text(), error },
        AnswerError::Solve(error) => CompareError::Solve { property: property_text(), error },
    })
}
