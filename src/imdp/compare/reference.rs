//! Reference files: what a model and its values are known to be.

use super::compact_json::compact_json;
use super::{CompareError, ModelDigest, Record, RecordedResult, Sizes};
use crate::formats::StateValues;
use serde::{Deserialize, Serialize};

const FORMAT: &str = "dynabs reference";
const VERSION: u32 = 1;

/// A model and its values in a file small enough to be kept under version control.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// `dynabs reference`.
    format: String,
    /// The version of the format.
    format_version: u32,
    /// What it is a reference of.
    pub name: String,
    /// How large the model is.
    pub sizes: Sizes,
    /// Labels, intervals and choices.
    #[serde(flatten)]
    pub model: ModelDigest,
    /// The answers to the model's properties.
    pub results: Vec<RecordedResult>,
    /// The lower bound of the first property in every state, to 12 digits.
    pub values: Vec<f64>,
}

impl Reference {
    /// Digests a side that has a model, and solves what was not solved.
    ///
    /// # Errors
    /// [`CompareError::NoModel`] without a model; errors of the solver about its properties.
    pub fn new(record: &mut Record) -> Result<Self, CompareError> {
        record.solve()?;
        let model =
            record.model.as_ref().ok_or_else(|| CompareError::NoModel { path: record.name.clone() })?;
        let values = match &record.values {
            Some(StateValues::Numbers(values)) => values.iter().copied().map(twelve_digits).collect(),
            _ => vec![],
        };
        Ok(Self {
            format: FORMAT.to_owned(),
            format_version: VERSION,
            name: record.title.clone(),
            sizes: Sizes::new(model),
            model: ModelDigest::new(model),
            results: record.results.clone(),
            values,
        })
    }

    /// The text of the file.
    pub fn to_json(&self) -> String {
        // Numbers, texts and lists of them always have a JSON form.
        serde_json::to_value(self).map(|value| compact_json(&value)).unwrap_or_default()
    }

    /// Whether a JSON object says that it is a reference.
    pub(super) fn is_one(value: &serde_json::Value) -> bool {
        value["format"] == FORMAT
    }

    /// Checks what the types do not.
    pub(super) fn check(&self) -> Result<(), String> {
        if self.format_version != VERSION {
            return Err(format!("a reference of version {}", self.format_version));
        }
        let states = self.sizes.states;
        let lengths = [("choices", self.model.choices.len()), ("values", self.values.len())];
        match lengths.into_iter().find(|&(_, length)| length as u64 != states) {
            Some(("values", 0)) => Ok(()),
            Some((list, length)) => Err(format!("{length} {list} for {states} states")),
            None => Ok(()),
        }
    }
}

fn twelve_digits(x: f64) -> f64 {
    format!("{x:.11e}").parse().unwrap_or(x)
}
