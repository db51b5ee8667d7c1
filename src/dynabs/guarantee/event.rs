//! What is promised to happen.

use crate::problem::Problem;
use serde::{Deserialize, Serialize};

/// Reaching the goal in time and avoiding the unsafe region until then.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Event {
    /// The number of original steps within which the goal is reached; none for unbounded tasks.
    pub horizon: Option<u64>,
    /// How many original steps are one step of the model.
    pub group_steps: u64,
    /// When the unsafe region is avoided.
    pub safety: Safety,
}

/// When the unsafe region is avoided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Safety {
    /// At every step of the original system.
    EveryStep,
    /// After every group of steps only: it may be crossed in between.
    GroupedInstants,
}

impl Event {
    /// The task of a problem.
    pub fn of(problem: &Problem) -> Self {
        let group_steps = problem.group_steps() as u64;
        let everywhere = group_steps == 1 || problem.unsafe_regions().is_empty();
        Self {
            horizon: problem.horizon().map(|steps| steps * group_steps),
            group_steps,
            safety: if everywhere { Safety::EveryStep } else { Safety::GroupedInstants },
        }
    }
}
