//! What is known of one side of a comparison.

use super::results::status_name;
use super::{CrosscheckError, ModelDigest, PolicyFile, RecordedResult, Sizes};
use crate::imdp::IntervalMdp;
use crate::property::{Property, Verdict};
use crate::solver::{Query, Solution, SolverOptions, solve};

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
    pub values: Option<Values>,
    /// A policy for the first property.
    pub policy: Option<PolicyFile>,
    /// What the user should know about it.
    pub notes: Vec<String>,
}

/// The answer to a property in every state.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Lower bounds.
    Numbers(Vec<f64>),
    /// `true`, `false` or `undecided`, for thresholds.
    Verdicts(Vec<String>),
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
    /// [`CrosscheckError`] if a property is not about the model.
    pub fn solve(&mut self) -> Result<(), CrosscheckError> {
        for property in self.properties.clone() {
            self.solve_property(&property)?;
        }
        Ok(())
    }

    /// Solves a property if it has no result, or for values if there are none and it is the first.
    pub(super) fn solve_property(&mut self, property: &Property) -> Result<(), CrosscheckError> {
        let Some(model) = &self.model else { return Ok(()) };
        let text = property.to_string();
        let known = self.results.iter().any(|result| result.property == text);
        let first = self.properties.first().is_none_or(|first| first == property);
        if known && !(first && self.values.is_none()) {
            return Ok(());
        }
        let solved = Solved::new(model, property)?;
        if first && self.values.is_none() {
            self.values = Some(Values::Numbers(solved.lower.clone()));
        }
        if !known {
            let initial = || model.initial().ones();
            let lower = initial().map(|state| solved.lower[state]).fold(1.0, f64::min);
            let upper = initial().map(|state| solved.upper[state]).fold(0.0, f64::max);
            let objective = property.resolve(model.kind());
            let threshold = objective.ok().and_then(|objective| objective.threshold);
            let verdicts: Vec<_> = threshold
                .iter()
                .flat_map(|t| initial().map(|state| t.decide(solved.lower[state], solved.upper[state])))
                .collect();
            let satisfied = if verdicts.contains(&Verdict::Fails) {
                Some(false)
            } else {
                (!verdicts.is_empty() && verdicts.iter().all(|v| *v == Verdict::Holds)).then_some(true)
            };
            let status = Some(status_name(solved.solution.status).to_owned());
            self.results.push(RecordedResult { property: text, lower, upper, satisfied, status });
        }
        Ok(())
    }
}

/// A property with its query and the solution of that.
pub(super) struct Solved {
    pub query: crate::property::Query,
    pub solution: Solution,
    /// Bounds on the value asked for, by state.
    pub lower: Vec<f64>,
    /// See `lower`.
    pub upper: Vec<f64>,
}

impl Solved {
    pub fn new(model: &IntervalMdp, property: &Property) -> Result<Self, CrosscheckError> {
        let refuse = |error| CrosscheckError::Property { property: property.to_string(), error };
        let objective = property.resolve(model.kind()).map_err(refuse)?;
        let query = objective.query(model).map_err(refuse)?;
        let solution = solve(model, &Query::from(&query.kind), query.resolution, &SolverOptions::default())
            .map_err(|error| CrosscheckError::Solve { property: property.to_string(), error })?;
        let bounds = &solution.values;
        let (lower, upper) =
            bounds.lower.iter().zip(&bounds.upper).map(|(&l, &u)| query.value_bounds(l, u)).unzip();
        Ok(Self { query, solution, lower, upper })
    }
}
