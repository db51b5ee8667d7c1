//! What the command-line tools share: errors with exit codes, progress bars, tables.

mod choices;
mod colour;
pub mod commands;
mod crosscheck_table;
mod ending;
mod error;
mod exit;
mod exports;
mod extensions;
mod input_run_source;
mod input_summary;
mod limits;
mod model_source;
mod model_text;
#[cfg(feature = "mpi")]
mod mpi;
mod other_samples;
mod output;
mod phases;
mod progress;
mod pruning;
mod questions;
mod resources;
mod results;
mod run_source;
mod schemas;
mod signals;
mod simulation_noise;
mod simulation_report;
mod simulation_start;
mod start;
mod summary;
mod threads;
mod together;
mod trajectories;
mod unasked;

pub use choices::{EncodingName, NamesChoice};
pub use dynabs::report::thousands;
pub use error::CliError;
pub use exit::exit_with;
pub use output::{print, print_json, warn};
pub use progress::Bars;
pub use results::PropertyResult;
pub use start::start;
pub use threads::use_threads;
