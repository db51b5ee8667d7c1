//! Why there is no abstraction.

use crate::Diagnostic;
use crate::landing::LandingError;
use crate::memory::TooLarge;
use crate::partition::GridError;
use crate::statistics::BudgetError;
use crate::system::ImageError;

/// Why there is no abstraction.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum InputsError {
    /// The dynamics are undefined somewhere.
    #[error("{error}\n  {remedy}", error = .0, remedy = ImageError::REMEDY)]
    Image(Box<ImageError>),
    /// The lattice or the list of images is too large.
    #[error("{0}\n  Use fewer cells or inputs, or a coarser /partition/resolution.")]
    Landing(#[from] LandingError),
    /// The machine is too small.
    #[error("{}", Diagnostic::from(.0))]
    Memory(#[from] TooLarge),
    /// No input is enabled in any cell.
    #[error(
        "found no input that leaves room for the feedback in any cell; expected one in some cell\n  Use smaller cells, a smaller gain or a larger U."
    )]
    NothingEnabled,
    /// Nothing can stay in the partition.
    #[error(
        "found inputs that all lead from every cell out of the partition, with no noise that leads back: {which}; expected some that stay\n  \
         Check the signs and units of the dynamics, or enlarge the partition."
    )]
    LeavesPartition {
        /// Where images lie, and where the partition.
        which: String,
    },
    /// The samples prove too little.
    #[error(
        "found {samples} samples, which leave {unseen} of the probability unseen; expected enough for at most half of it\n  Take more samples, or a lower confidence."
    )]
    TooFewSamples {
        /// The number of samples.
        samples: u64,
        /// The bound on the unseen mass.
        unseen: f64,
    },
    /// The budget was overspent: a mistake in this program.
    #[error(transparent)]
    Budget(#[from] BudgetError),
    /// The lattice makes no grid: a mistake in this program.
    #[error(transparent)]
    Grid(#[from] GridError),
}
