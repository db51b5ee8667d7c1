//! Matrices of rationals: everything that follows from a model file by `+ − × ÷` is exact.

mod exact_matrix;

pub use exact_matrix::{Definiteness, ExactMatrix, LdlFactors};
