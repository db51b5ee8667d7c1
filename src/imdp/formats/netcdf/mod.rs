//! The files of IntervalMDP.jl: NetCDF-4 (which is HDF5) for the model and JSON for what is asked of it.
//!
//! Two sparse matrices hold the lower and upper bounds, compressed by column; a column is an action of a state and
//! `stateptr` says which columns are whose. Everything counts from 1. The states to be reached and to be avoided stand in
//! the specification, a `.json` file of the same name, and are the labels `reach` and `avoid` here.

mod read;
mod specification;
mod write;

pub use read::import;
pub use write::{NetcdfError, NetcdfWriter, specification};

/// The label of the states to be reached.
const REACH: &str = "reach";
/// The label of the states to be avoided.
const AVOID: &str = "avoid";
