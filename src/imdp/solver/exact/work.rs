//! The work that exact values may take.

use crate::solver::SolverOptions;
use num_bigint::BigUint;

/// Why there is no exact value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Inexact {
    /// It would take too much time or memory.
    #[error("exact arithmetic would take too long")]
    TooLarge,
    /// The computation was stopped.
    #[error("exact arithmetic was stopped")]
    Stopped,
    /// Rounding left some row no distribution, or strategies were found that prove nothing.
    #[error("exact arithmetic does not apply to this model")]
    Unproved,
}

/// The work that may still be done, in multiplications of 64 binary digits.
pub(super) struct Work<'a> {
    pub(super) left: u64,
    options: &'a SolverOptions<'a>,
}

impl<'a> Work<'a> {
    pub(super) fn new(options: &'a SolverOptions<'a>) -> Self {
        Self { left: options.exact_work, options }
    }

    /// Takes note of work that is about to be done.
    pub(super) fn spend(&mut self, work: u64) -> Result<(), Inexact> {
        if self.options.progress.is_interrupted() {
            return Err(Inexact::Stopped);
        }
        self.left = self.left.checked_sub(work).ok_or(Inexact::TooLarge)?;
        Ok(())
    }
}

/// The number of digits, 64 bits each, that a number takes.
pub(super) fn digits(number: &BigUint) -> u64 {
    number.bits() / 64 + 1
}
