//! From continuous time to one step.

mod exponential;
mod taylor;
#[cfg(test)]
mod tests;

pub use exponential::{SampledLinear, SamplingError};
pub use taylor::{TaylorError, TaylorStep};
