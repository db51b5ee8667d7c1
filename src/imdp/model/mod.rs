//! Interval Markov decision processes with shared rows.
//!
//! In state `s` a policy picks a choice; nature then picks a distribution `p` with `l ≤ p ≤ u` from the
//! row of that choice. Compiled models use one row in thousands of states, so a state holds *ranges of
//! row ids* and rows are stored once: memory follows rows, not transitions.

mod choices;
mod exact_bounds;
mod exact_row;
mod ids;
mod interval_mdp;
mod labels;
mod memory;
mod narrow;
mod restrict;
mod rewards;
mod row;
mod row_error;
mod row_set;
mod rows;

pub use choices::{Choices, ChoicesBuilder, RowRange};
pub use exact_bounds::{End, ExactBound};
pub use fixedbitset::FixedBitSet as StateSet;
pub use ids::{RowId, StateId};
pub use interval_mdp::{ActionNames, ImdpError, IntervalMdp, ModelKind, Parts, Size};
pub use labels::{Labels, StateVariable, StateVariables, VariableValues};
pub use memory::{
    GrowingMemory, MemoryError, MemoryLimit, available_memory, given_memory, limit_memory, peak_memory,
    require_memory,
};
pub use restrict::restrict;
pub use rewards::{RewardError, RewardStructure, Rewards};
pub use row::Row;
pub use row_error::RowError;
pub use row_set::{ComputedRows, RowBuffer, RowEntries, RowSet};
pub use rows::Rows;

pub(crate) use exact_row::{ExactRow, Mass, Numerators};
