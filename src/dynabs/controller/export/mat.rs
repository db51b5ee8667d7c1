//! The controller's tables for MATLAB and Octave: MAT-file, level 5.

use super::table::{Table, Width};
use super::tables::{ExportError, Tables};
use crate::controller::Controller;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::{self, Write};

/// Types of data (`mi…`) and of arrays (`mx…`), as the format numbers them.
const INT8: u32 = 1;
const UINT8: u32 = 2;
const UINT16: u32 = 4;
const INT32: u32 = 5;
const UINT32: u32 = 6;
const DOUBLE: u32 = 9;
const MATRIX: u32 = 14;
const COMPRESSED: u32 = 15;
const CHARACTERS: u32 = 4;
const DOUBLE_CLASS: u32 = 6;

/// The tables that exported code computes with as a MAT-file, with the sizes `states`, `inputs`, `group_steps`, `horizon` (0:
/// none) and `memories` (0: none), and the text `promise`. Lists are columns; the numbers in tables count from 0.
///
/// # Errors
/// [`ExportError`] if the horizon is longer than the tables' numbers, or a table too large for the format.
pub fn mat(controller: &Controller) -> Result<Vec<u8>, ExportError> {
    let tables = Tables::new(controller)?;
    let mut file = vec![];
    let about = concat!("MATLAB 5.0 MAT-file, written by dynabs ", env!("CARGO_PKG_VERSION"));
    file.extend(format!("{about:<124}").bytes());
    // Version 1.0, little-endian.
    file.extend(b"\x00\x01IM");
    for (name, size) in tables.sizes() {
        variable(&mut file, name, (DOUBLE_CLASS, DOUBLE), [1, 1], &f64::from(size).to_le_bytes())?;
    }
    let promise: Vec<u8> = controller.promise().join(" ").encode_utf16().flat_map(u16::to_le_bytes).collect();
    variable(&mut file, "promise", (CHARACTERS, UINT16), [1, promise.len() / 2], &promise)?;
    for table in &tables.all {
        let Table { name, rows, columns, .. } = *table;
        let by_columns = table.by_columns();
        variable(&mut file, name, types(table.width()), [rows, columns.unwrap_or(1)], &by_columns.bytes())?;
    }
    Ok(file)
}

/// The type of an array and of its data.
fn types(width: Width) -> (u32, u32) {
    match width {
        Width::Double => (DOUBLE_CLASS, DOUBLE),
        Width::Byte => (9, UINT8),
        Width::Short => (11, UINT16),
        Width::Word => (13, UINT32),
    }
}

fn variable(
    out: &mut Vec<u8>,
    name: &str,
    (class, data): (u32, u32),
    [rows, columns]: [usize; 2],
    bytes: &[u8],
) -> io::Result<()> {
    let mut content = vec![];
    element(&mut content, UINT32, &[class.to_le_bytes(), [0; 4]].concat())?;
    element(&mut content, INT32, &[size(rows)?, size(columns)?].concat())?;
    element(&mut content, INT8, name.as_bytes())?;
    element(&mut content, data, bytes)?;
    let mut matrix = vec![];
    element(&mut matrix, MATRIX, &content)?;
    let mut packed = ZlibEncoder::new(vec![], Compression::best());
    packed.write_all(&matrix)?;
    // What is compressed is not padded.
    let packed = packed.finish()?;
    out.extend(COMPRESSED.to_le_bytes());
    out.extend(size(packed.len())?);
    out.extend(packed);
    Ok(())
}

/// Data with its type and size, padded to 8 bytes.
fn element(out: &mut Vec<u8>, data: u32, bytes: &[u8]) -> io::Result<()> {
    out.extend(data.to_le_bytes());
    out.extend(size(bytes.len())?);
    out.extend(bytes);
    out.resize(out.len().next_multiple_of(8), 0);
    Ok(())
}

fn size(bytes: usize) -> io::Result<[u8; 4]> {
    let counted = i32::try_from(bytes).map_err(|_| {
        io::Error::new(io::ErrorKind::FileTooLarge, "a table is larger than the 2 GiB that the format counts")
    })?;
    Ok(counted.to_le_bytes())
}
