//! The controller as a function of MATLAB and Octave.

use super::table::{Numbers, Table};
use super::tables::{ExportError, Tables};
use super::text::{comment, double, lines, list};
use crate::controller::Controller;
use crate::rendered::ended;
use askama::Template;

#[derive(Template)]
#[template(path = "controller.m", escape = "none")]
struct Function {
    function: String,
    name: String,
    version: &'static str,
    promise: String,
    tables: Tables,
}

/// The controller as a function of MATLAB and Octave; `name` is the model's, `function` what the file is called without its
/// ending.
///
/// It gives the inputs of one state or of several, a row each, bit by bit those of [`Controller::control`].
///
/// # Errors
/// [`ExportError`] if the horizon is longer than the code's counter.
pub fn matlab_source(controller: &Controller, name: &str, function: &str) -> Result<String, ExportError> {
    let source = Function {
        function: function.to_owned(),
        name: comment(name),
        version: env!("CARGO_PKG_VERSION"),
        promise: lines(&controller.promise(), "%"),
        tables: Tables::new(controller)?,
    };
    Ok(ended(source.render()?))
}

/// A table as a matrix; lists are columns.
fn matlab_table(table: &Table) -> String {
    let by_columns = table.by_columns();
    let numbers = match &by_columns.numbers {
        Numbers::Doubles(all) => list(all.iter().map(double), " ..."),
        Numbers::Whole(all) => list(all.iter(), " ..."),
    };
    let (rows, columns) = (table.rows, table.columns.unwrap_or(1));
    format!("    t.{} = reshape([ ...\n{numbers}], {rows}, {columns});", table.name)
}
