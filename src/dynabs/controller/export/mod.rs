//! The controller as files: JSON and CSV to read, C to deploy.

mod c_law;
mod c_memory;
mod c_source;
mod c_text;
mod csv;
mod input_json;
mod json;
mod memory_json;

pub use c_source::{CSourceError, c_source};
pub use csv::write_csv;
pub use input_json::write_input_json;
pub use json::write_json;
