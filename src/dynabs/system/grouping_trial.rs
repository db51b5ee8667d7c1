//! What a number of grouped steps could do.

use serde::Serialize;

/// What a number of grouped steps could do.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GroupingTrial {
    /// The number of steps.
    pub steps: usize,
    /// The input of one step, from 0, which is worst.
    pub input: usize,
    /// The share of its range that it takes to steer all states of one cell to one target. If it is more than
    /// 1, nothing is enabled anywhere: cells must shrink, or its range must grow, by this factor.
    pub share: f64,
    /// Whether some target can be steered to from the cell of the initial state; `None` if there is none.
    pub leaves_start: Option<bool>,
    /// Whether a target in the goal can be steered to from somewhere; `None` if nothing is to be reached.
    pub meets_goal: Option<bool>,
}

impl GroupingTrial {
    /// Whether everything that can be seen beforehand is as it must be.
    pub fn works(&self) -> bool {
        self.share <= 1.0 && self.leaves_start != Some(false) && self.meets_goal != Some(false)
    }
}
