//! Answers to properties as they were recorded.

use serde::{Deserialize, Serialize};

/// The answer to a property, as `dynabs-check solve --json` prints it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordedResult {
    /// The property in PRISM's syntax.
    pub property: String,
    /// The least lower bound of all initial states.
    pub lower: f64,
    /// The greatest upper bound of all initial states.
    pub upper: f64,
    /// For thresholds: whether they hold in all initial states.
    #[serde(default)]
    pub satisfied: Option<bool>,
    /// How the computation ended.
    #[serde(default)]
    pub status: Option<String>,
}
