//! The file formats in which interval MDPs are exchanged.

pub mod native;
pub mod prism;
