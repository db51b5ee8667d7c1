//! Rows in exact rational arithmetic: what the solver asks for once, and the checker for everything.

mod expectation;
mod support;
mod values;

pub(crate) use expectation::Nature;
pub(crate) use support::maximal_support;
pub(crate) use values::{ExactValues, Replaced};
