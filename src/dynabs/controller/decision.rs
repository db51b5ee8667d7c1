//! What a controller does in a state.

/// What the controller does in a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Decision {
    /// It takes an action: steers to a target, or applies an input with feedback about the center of the cell.
    Act {
        /// The target, as numbered by [`Targets`](crate::abstraction::Targets), or the input.
        action: u32,
    },
    /// The goal is reached: the task is done.
    Reached,
    /// The cell meets the unsafe region: the task has failed.
    Unsafe,
    /// The state is outside the partition: the task has failed.
    Outside,
    /// No action is enabled in this cell.
    NoAction,
    /// The horizon has passed.
    Over,
}

impl Decision {
    /// Its number in exported code: 0 where there are inputs.
    pub fn status(self) -> u8 {
        match self {
            Self::Act { .. } => 0,
            Self::Reached => 1,
            Self::Unsafe => 2,
            Self::Outside => 3,
            Self::NoAction => 4,
            Self::Over => 5,
        }
    }
}
