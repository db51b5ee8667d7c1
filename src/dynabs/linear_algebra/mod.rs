//! Matrices of rationals: everything that follows from a model file by `+ − × ÷` is exact.

mod exact_matrix;
mod modular;

pub use exact_matrix::{Definiteness, ExactMatrix, LdlFactors};
pub use modular::{krylov_rank, rank};
