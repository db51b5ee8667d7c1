//! What counts as a difference.

use super::Tolerance;

/// What counts as a difference, and how many are described.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DiffOptions {
    /// How far two numbers may be apart.
    pub tolerance: Tolerance,
    /// How many differences of each part are described.
    pub most: usize,
}

impl Default for DiffOptions {
    fn default() -> Self {
        Self { tolerance: Tolerance::default(), most: 10 }
    }
}
