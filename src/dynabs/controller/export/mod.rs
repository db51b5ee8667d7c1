//! The controller as files: JSON and CSV to read, C to deploy.

mod c_memory;
mod c_source;
mod csv;
mod input_c_source;
mod input_tables;
mod json;

pub use c_source::{CSourceError, c_source};
pub use csv::write_csv;
pub use input_c_source::input_c_source;
pub use input_tables::{write_input_csv, write_input_json};
pub use json::write_json;
