//! What reads words letter by letter and accepts or rejects them.

use super::LtlError;

/// A deterministic automaton, whose states may be made as they are met; it starts in state 0.
pub(crate) trait Acceptor {
    /// The state after a letter.
    ///
    /// # Errors
    /// [`LtlError::Size`] if there are too many states.
    fn step(&mut self, state: u32, letter: u64) -> Result<u32, LtlError>;

    /// Whether every continuation is accepted (`Some(true)`) or none (`Some(false)`), as far as it is known.
    fn decided(&self, state: u32) -> Option<bool>;

    /// Whether the letter that led here belongs to a check.
    fn decides(&self, state: u32, check: usize) -> bool;

    /// A run is accepted if it satisfies one of these conditions, or is decided to be.
    fn conditions(&self) -> &[Condition];
}

/// What a run must do: some checks are decided finitely often, others infinitely often.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Condition {
    /// Checks that are decided finitely often.
    pub(crate) finitely: Vec<usize>,
    /// Checks that are decided infinitely often.
    pub(crate) infinitely: Vec<usize>,
}
