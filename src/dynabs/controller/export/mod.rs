//! The controller as files: JSON and CSV to read, C to deploy.

mod c_source;
mod csv;
mod json;
mod template;

pub use c_source::{CSourceError, c_source};
pub use csv::write_csv;
pub use json::write_json;
pub(crate) use template::render;
