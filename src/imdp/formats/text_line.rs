//! What is wrong with a line of a small text format.

/// A line that does not say what it should.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("line {line}: found \"{found}\"; expected {expected}")]
pub struct LineError {
    /// The line, counted from 1.
    pub line: usize,
    /// What is there.
    pub found: String,
    /// What should be.
    pub expected: &'static str,
}
