//! What a cross-check found.

use crate::certificate::FileDigest;
use crate::formats::json_number;
use serde::{Deserialize, Serialize};

/// What asking one engine about one property came to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// The engine.
    pub engine: String,
    /// Its version, as far as it said.
    #[serde(default)]
    pub version: Option<String>,
    /// The property.
    pub property: String,
    /// The engine's least and greatest value of the initial states; 1 and 0 for what holds and does not.
    #[serde(default, with = "json_number::option_pair")]
    pub value: Option<[f64; 2]>,
    /// Our least lower and greatest upper bound of the initial states.
    #[serde(with = "json_number::pair")]
    pub ours: [f64; 2],
    /// No state's value is further from the exact one than this.
    #[serde(default, with = "json_number::option")]
    pub difference: Option<f64>,
    /// The state with the largest difference.
    #[serde(default)]
    pub state: Option<usize>,
    /// What was allowed, and why.
    #[serde(default)]
    pub tolerance: String,
    /// What the engine's strategy is worth, if it gave one.
    #[serde(default)]
    pub strategy: Option<StrategyFinding>,
    /// How long the engine took, in seconds, reading the model included.
    #[serde(default)]
    pub seconds: Option<f64>,
    /// The most memory that it had, in MiB.
    #[serde(default)]
    pub peak_mib: Option<u64>,
    /// What it came to.
    pub agreement: Agreement,
    /// What the user should know about it.
    #[serde(default)]
    pub notes: Vec<String>,
}

/// The object that `dynabs-check crosscheck --json` prints.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CrossCheckFile {
    /// The version of the program.
    #[serde(default)]
    pub version: String,
    /// Where the model was.
    #[serde(default)]
    pub path: String,
    /// The files of the model that was asked about.
    #[serde(default)]
    pub model: Vec<FileDigest>,
    /// Whether every engine that was to be asked agrees.
    #[serde(default)]
    pub agree: bool,
    /// What each engine said about each property.
    pub findings: Vec<Finding>,
    /// The engines that are not there.
    #[serde(default)]
    pub missing: Vec<String>,
}

/// Whether an engine agrees with us.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Agreement {
    /// In every state, and what it calls a strategy attains what it says.
    Agrees,
    /// In some state it is wrong, or we are.
    Disagrees,
    /// It cannot be told: one of us stopped early.
    Undecided,
    /// It gave no answer.
    Failed,
}

/// What an engine's strategy is worth on our model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StrategyFinding {
    /// The number of its decisions.
    pub decisions: usize,
    /// How much worse than the engine's own values it is, in the worst state; 0 if it is as good or better.
    pub shortfall: f64,
}

impl Agreement {
    /// The word that JSON has for it.
    pub fn word(self) -> &'static str {
        match self {
            Self::Agrees => "agrees",
            Self::Disagrees => "disagrees",
            Self::Undecided => "undecided",
            Self::Failed => "failed",
        }
    }
}

impl std::fmt::Display for Agreement {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            // What nobody may miss.
            Self::Disagrees => f.write_str("DISAGREES"),
            other => f.write_str(other.word()),
        }
    }
}
