//! File formats of interval MDPs.

pub mod drn;
mod names;
pub mod native;
pub mod prism;

pub use names::NameError;
