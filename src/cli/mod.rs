//! What the command-line tools share: errors with exit codes, progress bars, tables.

pub mod check;
pub mod compile;
pub mod controller;
pub mod convert;
pub mod crosscheck;
mod crosscheck_table;
pub mod diff;
mod error;
mod exports;
mod model_source;
mod output;
mod progress;
pub mod report;
mod results;
mod run_source;
pub mod simulate;
mod simulation_noise;
mod simulation_report;
pub mod solve;
mod staged_files;
mod summary;
mod threads;
mod trajectories;
pub mod verify;

pub use error::{CliError, exit_with};
pub use output::{print, thousands};
pub use progress::Bars;
pub use results::PropertyResult;
use staged_files::StagedFiles;
pub use threads::use_threads;
