//! The output directory of a run: staged, hashed, renamed into place, described by a manifest; and opened again.

mod appearance;
mod error;
mod files;
mod input_run;
mod manifest;
mod open;
mod pruning;
mod record;
mod row_states;
mod solution;
mod staging;
mod write;

pub use appearance::NATIVE_MODEL;
pub use error::OpenError;
pub use files::RunFiles;
pub use input_run::{InputRun, write_input_run};
pub use manifest::{Coordinates, GroupedHorizon, InputFile, LayerReport, Manifest, OutputFile};
pub use open::Run;
pub use pruning::PruningReport;
pub use record::{RecordError, open_record};
pub use row_states::RowStatesReport;
pub use solution::{input_solution_options, solution_options};
pub use staging::{RunDirectoryError, Staging};
pub use write::{WriteOptions, write_run};
