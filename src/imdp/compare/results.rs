//! Answers to properties as they are recorded, in JSON.

use crate::formats::json_number;
use crate::model::StateId;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The answer to a property, as `dynabs-check solve --json` prints it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RecordedResult {
    /// The property in PRISM's syntax.
    pub property: String,
    /// The least lower bound of all initial states; none for formulas that have no value.
    #[serde(with = "json_number::option")]
    pub lower: Option<f64>,
    /// The greatest upper bound of all initial states; none for formulas that have no value.
    #[serde(with = "json_number::option")]
    pub upper: Option<f64>,
    /// For thresholds: whether they hold in all initial states; `null` if undecided or not asked.
    #[serde(default)]
    pub satisfied: Option<bool>,
    /// How the computation ended.
    #[serde(default)]
    pub status: Option<String>,
    /// The number of iterations.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steps: Option<u64>,
    /// How long it took.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f64>,
    /// If there are several initial states: what holds in each.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub initial: Vec<InitialResult>,
    /// Why a threshold that lies between the bounds is not decided, if so.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub undecided: Option<String>,
    /// Why there is no answer, if there is none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
}

/// The answer in one initial state.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct InitialResult {
    /// The state.
    pub state: StateId,
    /// The lower bound of the value; none for formulas that have no value.
    #[serde(with = "json_number::option")]
    pub lower: Option<f64>,
    /// The upper bound of the value; none for formulas that have no value.
    #[serde(with = "json_number::option")]
    pub upper: Option<f64>,
    /// For formulas and thresholds: whether they hold; `null` if undecided or not asked.
    pub satisfied: Option<bool>,
}

/// The object that `dynabs-check solve --json` prints, with results that may say more than is recorded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ResultsFile<R> {
    /// The version of the program.
    #[serde(default)]
    pub version: String,
    /// The number of states of the model.
    pub states: Option<u64>,
    /// The number of its choices.
    pub choices: Option<u64>,
    /// The number of its transitions.
    pub transitions: Option<u64>,
    /// The number of its different rows.
    pub rows: Option<u64>,
    /// The answers, in the order of the questions.
    pub results: Vec<R>,
    /// What there is to know about the model.
    #[serde(default)]
    pub warnings: Vec<String>,
    /// How long the phases took.
    #[serde(default)]
    pub seconds: BTreeMap<String, f64>,
}
