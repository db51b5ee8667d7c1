//! From continuous time to one step.

mod exponential;
mod taylor;
#[cfg(test)]
mod tests;

pub use exponential::{SampledLinear, SamplingError, accumulated_covariance};
pub use taylor::{TaylorError, TaylorStep};
