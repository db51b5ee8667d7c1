//! The controller as a Python module that needs NumPy alone, and a node of ROS 2 around it.

use super::table::Table;
use super::tables::{ExportError, Tables};
use super::text::{comment, lines};
use crate::controller::Controller;
use crate::rendered::ended;
use askama::Template;
use data_encoding::BASE64;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::Write;

#[derive(Template)]
#[template(path = "controller.py", escape = "none")]
struct Module {
    name: String,
    version: &'static str,
    promise: String,
    tables: Tables,
}

#[derive(Template)]
#[template(path = "ros2_node.py", escape = "none")]
struct Node {
    module: String,
    memory: bool,
}

/// The controller as a Python module; `name` is the model's.
///
/// Its function `control` gives the inputs of one state or of an array of states, bit by bit those of
/// [`Controller::control`].
///
/// # Errors
/// [`ExportError`] if the horizon is longer than the code's counter.
pub fn python_source(controller: &Controller, name: &str) -> Result<String, ExportError> {
    let tables = Tables::new(controller)?;
    let harmless = |sentence: &String| sentence.replace('\\', "/").replace('"', "'");
    let sentences: Vec<String> = controller.promise().iter().map(harmless).collect();
    let version = env!("CARGO_PKG_VERSION");
    let module = Module { name: comment(name), version, promise: lines(&sentences, ""), tables };
    Ok(ended(module.render()?))
}

/// [`python_source`] with a node of ROS 2 that runs it, to begin with.
///
/// # Errors
/// [`ExportError`] if the horizon is longer than the code's counter.
pub fn ros2_source(controller: &Controller, name: &str) -> Result<String, ExportError> {
    let module = python_source(controller, name)?;
    let memory = controller.task().letters().is_some();
    Ok(ended(Node { module: module.trim_end().to_owned(), memory }.render()?))
}

/// A table as its type, its shape and its bytes.
fn python_table(table: &Table) -> askama::Result<String> {
    let mut packed = ZlibEncoder::new(vec![], Compression::best());
    packed.write_all(&table.bytes())?;
    let text = BASE64.encode(&packed.finish()?);
    let wrapped: Vec<&str> =
        text.as_bytes().chunks(100).filter_map(|line| std::str::from_utf8(line).ok()).collect();
    let shape = match table.columns {
        None => format!("{},", table.rows),
        Some(columns) => format!("{}, {columns}", table.rows),
    };
    let name = table.name.to_uppercase();
    Ok(format!(
        "{name} = _table(\"{}\", ({shape}), \"\"\"\n{}\"\"\")",
        table.width().dtype(),
        wrapped.join("\n")
    ))
}
