//! File formats of interval MDPs.

pub mod prism;
