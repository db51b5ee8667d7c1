//! Why a directory cannot be opened as a run.

use crate::Diagnostic;
use crate::abstraction::AbstractionError;
use crate::abstraction::inputs::InputsError;
use imdp::formats::native::NativeError;
use imdp::solution_file::SolutionFileError;
use std::io;

/// Why a directory is no run that can be used.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// It was not written by `dynabs-compile`.
    #[error("{path}: found {found}; expected a directory written by dynabs-compile")]
    NoRun {
        /// The path.
        path: String,
        /// What is there.
        found: String,
    },
    /// A file is not the one that was written.
    #[error(
        "{path}: found other bytes than the manifest's hash is of; expected the file as it was written\n  Compile the model again."
    )]
    Changed {
        /// The path of the file.
        path: String,
    },
    /// The problem names a file elsewhere.
    #[error(
        "{path}: found the file \"{found}\"; expected \"noise.csv\", for a run refers to nothing outside of its directory\n  Compile the model again."
    )]
    ForeignFile {
        /// The path of the problem.
        path: String,
        /// The file that it names.
        found: String,
    },
    /// The model was pruned.
    #[error(
        "{path}: found a pruned model; expected the whole one, whose actions are compared with the law\n  Compile the whole model: the value and the policy are the same."
    )]
    Pruned {
        /// The directory.
        path: String,
    },
    /// The system does not let us read a file.
    #[error("{path}: {error}")]
    Io {
        /// The path of the file.
        path: String,
        /// What the system said.
        error: io::Error,
    },
    /// The problem is not one.
    #[error(transparent)]
    Problem(#[from] Diagnostic),
    /// The native model cannot be read.
    #[error("{path}: {error}")]
    Model {
        /// The path of the model.
        path: String,
        /// What is wrong with it.
        error: NativeError,
    },
    /// The solution cannot be read.
    #[error("{path}: {error}\n  Compile the model again.")]
    Solution {
        /// The path of the solution.
        path: String,
        /// What is wrong with it.
        error: SolutionFileError,
    },
    /// A problem whose actions are inputs has no abstraction any more.
    #[error("{path}: {error}")]
    Inputs {
        /// The directory.
        path: String,
        /// Why.
        error: Box<InputsError>,
    },
    /// Problem and model do not fit.
    #[error("{path}: {error}\n  Compile the model again with this version of dynabs.")]
    Abstraction {
        /// The directory.
        path: String,
        /// What does not fit.
        error: AbstractionError,
    },
}
