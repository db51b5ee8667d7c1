//! What reading a model has in common in all formats: errors with positions, numbers as they are written, rows
//! that are checked and stored once.

mod assembly;
mod bounds;
mod decimal;
mod error;
mod exact_sum;
mod fields;
mod interval;
mod lines;
mod loose;
mod pending_row;
mod reward;
mod row_table;
mod source;
mod text;
mod variables;
mod written;

pub(crate) use assembly::{Assembly, AssemblyError, Expected, Transitions};
pub(crate) use bounds::{Judgement, written_bounds};
pub(crate) use error::Fault;
pub use error::{ImportError, Place, Position, Warning};
pub(in crate::formats) use fields::Fields;
pub(in crate::formats) use interval::{Interval, read_any_interval, read_interval};
pub(in crate::formats) use lines::Lines;
pub(in crate::formats) use loose::{LooseTransitions, TransitionHeader};
pub(in crate::formats) use pending_row::{PendingRow, RowFault};
pub(in crate::formats) use reward::{RewardValue, read_reward};
pub(in crate::formats) use row_table::hash_row;
pub(in crate::formats) use source::{Packing, Source, open, without_packing};
pub(in crate::formats) use text::{Cursor, counted, describe};
pub(in crate::formats) use variables::{Value, read_value, read_variable_value};
pub(in crate::formats) use written::enclose;

use crate::model::IntervalMdp;

/// A model read from a file.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The model.
    pub model: IntervalMdp,
    /// What was accepted although it deserves a look, at most one warning of each kind.
    pub warnings: Vec<Warning>,
    /// What the files ask, in PRISM's syntax; empty if they ask nothing.
    pub properties: String,
}
