//! Why a file is no model of the native format.

use crate::model::{ImdpError, MemoryError};
use std::io;

/// Why a file of the native format was refused.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NativeError {
    /// The file cannot be opened or read.
    #[error("cannot read the model: {0}")]
    Io(#[from] io::Error),
    /// The file does not start like this format.
    #[error("found first bytes that are not `DYNABS`, so this is not a dynabs model; expected one")]
    NotNative,
    /// The file is of another version of this format.
    #[error("found a model of format version {found}; expected version {expected}\n  Write it anew.")]
    Version {
        /// The version of the file.
        found: u32,
        /// The version that can be read.
        expected: u32,
    },
    /// The file ends early, or its length changed while it was read.
    #[error(
        "found a model that is damaged: it is not as long as it says; expected all of it\n  Copy it anew."
    )]
    Truncated,
    /// A section is not what it should be.
    #[error("found a model that is damaged in section {section}: {problem}; expected it as it was written")]
    Section {
        /// The section.
        section: String,
        /// What is wrong with it.
        problem: String,
    },
    /// Everything looks right, but some bytes are not those that were written.
    #[error(
        "found a model that is damaged, for its checksum is another one; expected it as it was written\n  Copy it anew."
    )]
    Checksum,
    /// The model does not fit into memory.
    #[error(transparent)]
    Memory(#[from] MemoryError),
    /// The parts do not make an interval MDP.
    #[error("the file does not describe an interval MDP: {0}")]
    Model(#[from] ImdpError),
}
