//! What it means to the task to land in a cell.

use crate::partition::{CellId, CellKind, CellLabels};

/// What a cell is to a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The task goes on.
    Open,
    /// The goal is reached.
    Reached,
    /// The goal will not be reached any more.
    Lost,
}

/// The outcome of every cell.
///
/// Known from the geometry alone, before any sample is looked at.
#[derive(Clone, Debug)]
pub struct Outcomes {
    of_cell: Vec<Outcome>,
}

impl Outcomes {
    /// Goal cells are reached; unsafe cells are lost, and so are ordinary ones that `is_blocked`.
    pub fn new(labels: &CellLabels, is_blocked: impl Fn(CellId) -> bool) -> Self {
        let outcome = |(cell, kind)| match kind {
            CellKind::Goal => Outcome::Reached,
            CellKind::Unsafe => Outcome::Lost,
            CellKind::Ordinary if is_blocked(cell) => Outcome::Lost,
            CellKind::Ordinary => Outcome::Open,
        };
        Self { of_cell: labels.iter().map(outcome).collect() }
    }

    /// The outcome of one cell.
    pub fn of(&self, cell: CellId) -> Outcome {
        self.of_cell[cell.index()]
    }
}
