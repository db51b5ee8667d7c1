//! What the probabilities of a model rest on.

use crate::problem::Components;
use crate::statistics::Allocation;
use serde::{Deserialize, Serialize};

/// What the intervals of a model are made from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "from", rename_all = "kebab-case")]
pub enum Evidence {
    /// Samples of the noise, whose distribution is unknown.
    Samples(SampleEvidence),
    /// Known distributions.
    Known {
        /// The most mass that is not listed: of a component of the noise, which may do anything, or of the cells that a row to a
        /// target leaves out, which fail.
        unlisted: f64,
        /// Whether bounds from above are claims too: not where what is not listed counts as failed.
        #[serde(default = "claimed")]
        both_sides: bool,
    },
    /// The published tool's formulas, which prove nothing.
    Published {
        /// The failure probability of one interval by itself.
        beta_per_interval: f64,
    },
}

/// Samples, and what was made of the probability that they mislead.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SampleEvidence {
    /// The number of samples, of the noise of one step of the model.
    pub number: u64,
    /// The probability that something that is promised of any setting of the sweep is wrong, at most: `β`.
    pub beta: f64,
    /// The number of settings that are compiled with these samples: each may spend `β / sweep`.
    pub sweep: u64,
    /// What this setting spent its part on.
    pub budget: Vec<Allocation>,
    /// The bound on the probability outside the window of cells that a row lists.
    pub unseen_mass: f64,
    /// For actions that are inputs: what is assumed of the components of the noise.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub components: Option<Components>,
    /// Whether the actions of the model are those near a plan.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub follows_plan: bool,
}

impl SampleEvidence {
    /// Whether the components of the noise are assumed to be independent of each other.
    pub fn are_independent(&self) -> bool {
        matches!(self.components, Some(Components::Intervals | Components::Bands))
    }
}

/// What manifests that do not say it mean.
fn claimed() -> bool {
    true
}
