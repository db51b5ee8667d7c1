//! Why there is no abstraction.

use crate::memory::TooLarge;
use crate::statistics::BudgetError;
use crate::system::GroupingTrial;
use imdp::model::ImdpError;

/// Why a valid problem has no abstraction.
#[derive(Debug, thiserror::Error)]
pub enum AbstractionError {
    /// No action is enabled in any cell.
    #[error("no action is enabled in any cell")]
    NothingEnabled {
        /// Whether there is a lower layer, which may be to blame.
        stabilized: bool,
        /// What numbers of grouped steps could do.
        grouping: Vec<GroupingTrial>,
    },
    /// No cell has a plan.
    #[error("a plan leads from no cell to anything")]
    NothingPlanned,
    /// Every action may meet something unsafe at a step in between.
    #[error("in every cell every action may meet something unsafe between grouped instants")]
    NothingClear {
        /// How many steps are grouped.
        group_steps: usize,
    },
    /// The samples prove too little.
    #[error("{samples} samples leave {unseen} of the probability unseen")]
    TooFewSamples {
        /// The number of samples.
        samples: u64,
        /// How many would be enough.
        needed: u64,
        /// The bound on the unseen mass.
        unseen: f64,
    },
    /// The model does not fit into memory.
    #[error(transparent)]
    Memory(#[from] TooLarge),
    /// The budget was overspent: a mistake in this program.
    #[error(transparent)]
    Budget(#[from] BudgetError),
    /// Windows cannot be compared.
    #[error(transparent)]
    Scout(#[from] imdp::solver::AnswerError),
    /// The result is not an interval MDP: a mistake in this program.
    #[error("the abstraction is not an interval MDP: {0}")]
    Invalid(#[from] ImdpError),
    /// A model was given that this problem does not have.
    #[error("the model is not the one that this version of dynabs makes of the problem")]
    Foreign,
    /// `B` has no right inverse: a mistake in this program, since problems are validated.
    #[error("the grouped B has no right inverse")]
    NotSteerable,
}
