//! What takes memory, and which field of the model file makes it less.

use crate::Diagnostic;
use crate::partition::Grid;
use imdp::model::{MemoryError, require_memory};
use serde::Serialize;

/// What one part of a compilation takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Need {
    /// The part.
    pub what: &'static str,
    /// How many bytes it takes when it takes most, about.
    pub bytes: u64,
    /// The field of the model file that makes it less.
    pub field: &'static str,
}

/// A part would take more memory than there is.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{error}")]
pub struct TooLarge {
    /// The field of the model file that makes it less.
    pub field: &'static str,
    /// The estimate, and what there is.
    pub error: MemoryError,
}

/// Per cell: its kind, its state and outcome, and the bounds and tables of a solution.
const CELL_BYTES: u64 = 104;

/// And per cell and dimension, the variable of its state, in two models.
const VARIABLE_BYTES: u64 = 8;

impl Need {
    /// What the cells of a grid take, in all stages together.
    pub fn of_cells(grid: &Grid) -> Self {
        let per_cell = CELL_BYTES + VARIABLE_BYTES * grid.dimension() as u64;
        let bytes = u64::from(grid.num_cells()) * per_cell;
        Self { what: "the cells of the partition", bytes, field: "/partition/cells" }
    }

    /// Refuses what does not fit.
    ///
    /// # Errors
    /// [`TooLarge`] if there is less memory.
    pub fn check(&self) -> Result<(), TooLarge> {
        require_memory(self.what, self.bytes).map_err(|error| TooLarge { field: self.field, error })
    }
}

impl From<&TooLarge> for Diagnostic {
    fn from(TooLarge { field, error }: &TooLarge) -> Self {
        let found = format!("{} that would take about {} MiB of memory", error.what, error.needed_mib);
        let expected =
            format!("at most {} MiB, which is what is available ({})", error.available_mib, error.limit);
        Self::at(*field, found, expected).remedy("Make it smaller, or use a machine with more memory.")
    }
}
