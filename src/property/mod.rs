//! Properties in PRISM's syntax.

mod syntax;

pub use syntax::{Objective, PathFormula, Property, Resolution, StateFormula};
