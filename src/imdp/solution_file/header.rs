//! The first line, and what can be wrong with a file.

use crate::solver::Status;
use serde::{Deserialize, Serialize};

/// What the first line says it is.
pub(super) const FORMAT: &str = "dynabs solution 2";

/// The first line.
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Header {
    pub(super) format: String,
    /// The property, in PRISM's syntax.
    pub(super) property: String,
    /// The SHA-256 of the native model, or of the problem where there is none, in hexadecimal.
    pub(super) model: String,
    pub(super) states: usize,
    pub(super) status: Status,
    pub(super) iterations: u64,
    /// The horizon of the policy; none if it is stationary.
    pub(super) horizon: Option<u64>,
    pub(super) changes: usize,
    pub(super) history: usize,
}

/// Why a file is not the solution that is wanted.
#[derive(Debug, thiserror::Error)]
pub enum SolutionFileError {
    /// The first line is none of ours.
    #[error("found a first line that is none of a solution ({0}); expected \"{FORMAT}\"")]
    Header(String),
    /// It is about something else.
    #[error("found a solution of {found}; expected {expected}")]
    Other {
        /// What it is about.
        found: String,
        /// What it should be about.
        expected: String,
    },
    /// It is too short or too long.
    #[error("found {found} bytes of numbers; expected {expected}")]
    Length {
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: u64,
    },
    /// A number is out of its range.
    #[error("state {state}: found {found}; expected {expected}")]
    Number {
        /// The state it is about.
        state: usize,
        /// What it is.
        found: String,
        /// What it should be.
        expected: &'static str,
    },
}
