//! The controller's tables for NumPy.

use super::archive::Archive;
use super::tables::{ExportError, Tables};
use crate::controller::Controller;

/// The tables that exported code computes with as NumPy's `.npz`, with the sizes `states`, `inputs`, `group_steps`,
/// `horizon` (0: none) and `memories` (0: none), and the text `promise`.
///
/// # Errors
/// [`ExportError`] if the horizon is longer than the tables' numbers, or a table too large for the format.
pub fn npz(controller: &Controller) -> Result<Vec<u8>, ExportError> {
    let tables = Tables::new(controller)?;
    let mut archive = Archive::default();
    for (name, size) in tables.sizes() {
        archive.add(&format!("{name}.npy"), &array("<u4", "", &size.to_le_bytes()))?;
    }
    let promise = controller.promise().join(" ");
    let characters: Vec<u8> = promise.chars().flat_map(|c| u32::from(c).to_le_bytes()).collect();
    archive.add("promise.npy", &array(&format!("<U{}", characters.len() / 4), "", &characters))?;
    for table in &tables.all {
        let shape = match table.columns {
            None => format!("{},", table.rows),
            Some(columns) => format!("{}, {columns}", table.rows),
        };
        archive.add(&format!("{}.npy", table.name), &array(table.width().dtype(), &shape, &table.bytes()))?;
    }
    Ok(archive.finish()?)
}

/// A file of NumPy's format 1.0: the header ends on a multiple of 64 bytes.
fn array(dtype: &str, shape: &str, bytes: &[u8]) -> Vec<u8> {
    let header = format!("{{'descr': '{dtype}', 'fortran_order': False, 'shape': ({shape}), }}");
    let length = (header.len() + 11).next_multiple_of(64) - 10;
    let mut file = b"\x93NUMPY\x01\x00".to_vec();
    file.extend((length as u16).to_le_bytes());
    file.extend(format!("{header:<width$}\n", width = length - 1).bytes());
    file.extend(bytes);
    file
}
