//! Rows in exact rational arithmetic: what the solver asks for once, and the checker for everything.

mod exact_row;
mod support;
mod values;

pub(crate) use exact_row::{ExactRow, Nature, Numerators, common_multiple};
pub(crate) use support::maximal_support;
pub(crate) use values::{ExactValues, Replaced};
