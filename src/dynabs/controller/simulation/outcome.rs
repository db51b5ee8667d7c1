//! What one run came to.

use super::Violation;
use crate::controller::Decision;
use serde::Serialize;

/// How a run ended, as the abstraction sees it: at grouped instants, in cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// In a goal cell.
    Reached,
    /// In a cell that meets the unsafe region.
    Unsafe,
    /// Outside the partition.
    Outside,
    /// In a cell without an enabled action.
    NoAction,
    /// The horizon passed.
    Over,
    /// An unbounded task was given up.
    Unfinished,
}

/// What one run came to.
#[derive(Clone, Debug, PartialEq)]
pub struct RunOutcome {
    /// How it ended.
    pub end: End,
    /// Whether the task was done in the true sets, at grouped instants, and nothing unsafe met at any original step before.
    pub satisfied: bool,
    /// Whether the task was done in the true sets, looked at in grouped instants only.
    pub satisfied_at_instants: bool,
    /// Whether something unsafe was met between grouped instants, before the task was decided.
    pub unsafe_between: bool,
    /// The number of grouped steps taken.
    pub steps: u64,
    /// How many inputs, of one step each, were outside `U`.
    pub violations: u64,
    /// The first of them.
    pub first_violation: Option<Violation>,
}

impl RunOutcome {
    /// Before the first step.
    pub(super) fn begin() -> Self {
        Self {
            end: End::Unfinished,
            satisfied: false,
            satisfied_at_instants: false,
            unsafe_between: false,
            steps: 0,
            violations: 0,
            first_violation: None,
        }
    }
}

impl From<Decision> for End {
    /// How a run ends that goes no further with this decision.
    fn from(decision: Decision) -> Self {
        match decision {
            Decision::Act { .. } => Self::Unfinished,
            Decision::Reached => Self::Reached,
            Decision::Unsafe => Self::Unsafe,
            Decision::Outside => Self::Outside,
            Decision::NoAction => Self::NoAction,
            Decision::Over => Self::Over,
        }
    }
}
