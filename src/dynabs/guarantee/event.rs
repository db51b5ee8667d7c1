//! What is promised to happen.

use crate::problem::{InputProblem, Problem};
use crate::task::{Aim, Safety};
use serde::{Deserialize, Serialize};

/// Reaching the goal in time and avoiding the unsafe region until then, or staying in the safe region.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Event {
    /// What an automaton wants, in words: "the run ...".
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub task: Option<String>,
    /// Whether something is to be reached or to be kept.
    #[serde(default)]
    pub aim: Aim,
    /// The number of original steps that the task is about; none for unbounded tasks.
    pub horizon: Option<u64>,
    /// How many original steps are one step of the model.
    pub group_steps: u64,
    /// When the unsafe region is avoided.
    pub safety: Safety,
    /// When the outside of the partition is avoided: like the unsafe region where the task says so.
    pub outside: Safety,
}

impl Event {
    /// The task of a problem.
    pub fn of(problem: &Problem) -> Self {
        let group_steps = problem.group_steps() as u64;
        let outside_everywhere = group_steps == 1 || problem.outside_is_unsafe();
        Self {
            task: problem.objective().statement(),
            aim: problem.objective().aim(),
            horizon: problem.horizon().map(|steps| steps * group_steps),
            group_steps,
            safety: problem.safety(),
            outside: if outside_everywhere { problem.safety() } else { Safety::GroupedInstants },
        }
    }

    /// The task of a problem whose actions are inputs.
    pub fn of_inputs(problem: &InputProblem) -> Self {
        Self {
            task: problem.objective().statement(),
            aim: problem.objective().aim(),
            horizon: problem.horizon(),
            group_steps: 1,
            safety: Safety::EveryStep,
            outside: Safety::EveryStep,
        }
    }
}
