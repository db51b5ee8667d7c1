//! Why two sides cannot be compared.

use crate::evaluation::EvaluationError;
use crate::files::is_fault_of_input;
use crate::formats::{Format, ImportError};
use crate::property::{ParseError, PropertyError};
use crate::solver::SolveError;
use std::io;

/// Why two sides cannot be compared.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CompareError {
    /// There is nothing of this name.
    #[error(
        "{path}: found nothing; expected a run directory, a file that ends in {}, results in JSON or a reference file",
        Format::endings(Format::all())
    )]
    Missing {
        /// The path.
        path: String,
    },
    /// There is something, but nothing that could be compared.
    #[error("{path}: found {found}; expected {expected}")]
    Unusable {
        /// The path.
        path: String,
        /// What is there.
        found: String,
        /// What would be of use.
        expected: String,
    },
    /// A file cannot be read.
    #[error("{path}: {error}")]
    Io {
        /// The path.
        path: String,
        /// What the system said.
        error: io::Error,
    },
    /// The file of a model is refused.
    #[error(transparent)]
    Import(#[from] ImportError),
    /// A property cannot be read.
    #[error("{path}: {error}")]
    Properties {
        /// The file, or the side, it comes from.
        path: String,
        /// Why.
        error: ParseError,
    },
    /// A property is not about the model.
    #[error("{property}: {error}")]
    Property {
        /// The property.
        property: String,
        /// Why.
        error: PropertyError,
    },
    /// A property cannot be solved.
    #[error("{property}: {error}")]
    Solve {
        /// The property.
        property: String,
        /// Why.
        error: SolveError,
    },
    /// An expression cannot be evaluated.
    #[error("{property}: {error}")]
    Expression {
        /// The expression.
        property: String,
        /// Why.
        error: EvaluationError,
    },
    /// A policy takes an action that its model does not have.
    #[error(
        "{side}: found a policy that takes \"{action}\" in state {state}; expected a choice of that state"
    )]
    Action {
        /// The side with the policy.
        side: String,
        /// The state.
        state: u32,
        /// The action.
        action: String,
    },
    /// What a strategy leaves of a model is no model.
    #[error("the engine's strategy: {error}")]
    Strategy {
        /// Why.
        error: crate::model::ImdpError,
    },
    /// What is compared does not fit into memory.
    #[error("{0}; compare smaller models, or files of results or values instead of models")]
    Memory(#[from] crate::model::MemoryError),
    /// There is no model to make a reference of.
    #[error("{path}: found no model; expected a run directory or a model file to make a reference of")]
    NoModel {
        /// The path.
        path: String,
    },
    /// The two sides have no part in common.
    #[error(
        "{left} and {right}: found nothing in common that could be compared: {notes}; expected models, results, values or policies on both sides"
    )]
    NothingInCommon {
        /// The left side.
        left: String,
        /// The right side.
        right: String,
        /// What only one of them has.
        notes: String,
    },
}

impl CompareError {
    /// Whether the system failed rather than the input.
    pub fn is_io(&self) -> bool {
        match self {
            Self::Io { error, .. } => !is_fault_of_input(error),
            Self::Import(error) => error.is_io(),
            _ => false,
        }
    }
}
