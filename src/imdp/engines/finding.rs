//! What a cross-check found.

use serde::Serialize;

/// What asking one engine about one property came to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// The engine.
    pub engine: &'static str,
    /// Its version, as far as it said.
    pub version: Option<String>,
    /// The property.
    pub property: String,
    /// The engine's least and greatest value of the initial states.
    pub value: Option<[f64; 2]>,
    /// Our least lower and greatest upper bound of the initial states.
    pub ours: [f64; 2],
    /// No state's value is further from the exact one than this.
    pub difference: Option<f64>,
    /// The state with the largest difference.
    pub state: Option<usize>,
    /// What was allowed, and why.
    pub tolerance: String,
    /// What the engine's strategy is worth, if it gave one.
    pub strategy: Option<StrategyFinding>,
    /// How long the engine took, in seconds, reading the model included.
    pub seconds: Option<f64>,
    /// The most memory that it had, in MiB.
    pub peak_mib: Option<u64>,
    /// What it came to.
    pub agreement: Agreement,
    /// What the user should know about it.
    pub notes: Vec<String>,
}

/// Whether an engine agrees with us.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
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
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct StrategyFinding {
    /// The number of its decisions.
    pub decisions: usize,
    /// How much worse than the engine's own values it is, in the worst state; 0 if it is as good or better.
    pub shortfall: f64,
}

impl std::fmt::Display for Agreement {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Agrees => "agrees",
            Self::Disagrees => "DISAGREES",
            Self::Undecided => "undecided",
            Self::Failed => "failed",
        })
    }
}
