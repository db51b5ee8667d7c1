//! Where and why a text is not an expression.

/// A text is not an expression.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("column {column}: found {found}; expected {expected}")]
pub struct ExpressionError {
    /// The character at which it is noticed, from 1.
    pub column: usize,
    /// What was found.
    pub found: String,
    /// What is expected.
    pub expected: String,
    /// What to do about it, if that is not obvious.
    pub remedy: Option<String>,
}

impl ExpressionError {
    pub(super) fn new(column: usize, found: impl Into<String>, expected: impl Into<String>) -> Self {
        Self { column, found: found.into(), expected: expected.into(), remedy: None }
    }

    pub(super) fn remedy(mut self, remedy: impl Into<String>) -> Self {
        self.remedy = Some(remedy.into());
        self
    }
}
