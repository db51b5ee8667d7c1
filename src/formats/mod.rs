//! File formats of interval MDPs.

pub mod native;
pub mod prism;
