//! When what is unsafe has to be avoided.

use serde::{Deserialize, Serialize};

/// When the unsafe region is avoided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Safety {
    /// At every step of the original system.
    EveryStep,
    /// After every group of steps only: it may be crossed in between.
    GroupedInstants,
}
