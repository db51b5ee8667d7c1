//! What the command-line tools share: errors with exit codes, progress bars, tables.

pub mod compile;
pub mod diff;
mod error;
mod output;
mod progress;
mod summary;

pub use error::{CliError, exit_with};
pub use output::{print, thousands};
pub use progress::Bars;
