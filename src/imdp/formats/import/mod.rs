//! What reading a model has in common in all formats: errors with positions, numbers as they are written, rows
//! that are checked and stored once.

mod assembly;
mod bounds;
mod decimal;
mod error;
mod exact_sum;
mod interval;
mod lines;
mod pending_row;
mod row_table;
mod text;
mod variables;

pub(crate) use assembly::{Assembly, AssemblyError, Expected, Transitions};
pub(crate) use bounds::{Judgement, written_bounds};
pub(crate) use error::Fault;
pub use error::{ImportError, Place, Position, Warning};
pub(crate) use interval::{Interval, read_interval};
pub(crate) use lines::Lines;
pub(crate) use pending_row::{PendingRow, RowFault};
pub(crate) use row_table::hash_row;
pub(crate) use text::{Cursor, counted, describe};
pub(crate) use variables::read_variable_value;

use crate::model::IntervalMdp;

/// A model read from a file.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The model.
    pub model: IntervalMdp,
    /// What was accepted although it deserves a look, at most one warning of each kind.
    pub warnings: Vec<Warning>,
}
