//! The controller as files: JSON and CSV to read, C, Python and MATLAB to deploy, tables for anything else.
//!
//! Whatever is deployed computes with the same tables, in the same order of operations, as [`Controller::control`] does.
//!
//! [`Controller::control`]: crate::controller::Controller::control

mod archive;
mod c_source;
mod csv;
mod input_json;
mod json;
mod law_tables;
mod mat;
mod matlab_source;
mod memory_json;
mod memory_tables;
mod npz;
mod python_source;
mod table;
mod tables;
mod text;

pub use c_source::{c_header, c_source, s_function_source};
pub use csv::write_csv;
pub use input_json::write_input_json;
pub use json::write_json;
pub use mat::mat;
pub use matlab_source::matlab_source;
pub use npz::npz;
pub use python_source::{python_source, ros2_source};
pub use tables::ExportError;

use super::Controller;

impl Controller {
    /// How many bytes the tables take that an exported controller looks up, in their narrowest types.
    ///
    /// # Errors
    /// [`ExportError::HorizonTooLong`].
    pub fn table_bytes(&self) -> Result<u64, ExportError> {
        let tables = tables::Tables::new(self)?;
        Ok(tables.all.iter().map(|table| table.bytes().len() as u64).sum())
    }
}
