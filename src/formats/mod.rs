//! File formats of interval MDPs.

pub mod drn;
mod import;
mod names;
pub mod native;
pub mod prism;
pub mod umb;

pub use import::{ImportError, Imported, Place, Position, Warning};
pub use names::NameError;
