//! The controller as one self-contained C99 file, its header, and a block of Simulink around it.

use super::tables::{ExportError, Tables};
use super::text::{c_table, comment, identifier, lines};
use crate::controller::Controller;
use crate::controller::law::Law;
use crate::rendered::ended;
use askama::Template;

/// The file, field by field as the template names them.
#[derive(Template)]
#[template(path = "controller.c", escape = "none")]
struct ControllerSource {
    names: Names,
    name: String,
    version: &'static str,
    promise: String,
    file: String,
    tables: Tables,
    /// The state whose cell it is.
    state: &'static str,
}

#[derive(Template)]
#[template(path = "controller.h", escape = "none")]
struct Header {
    names: Names,
    name: String,
    version: &'static str,
    promise: String,
    tables: Tables,
}

#[derive(Template)]
#[template(path = "s_function.c", escape = "none")]
struct SFunction {
    names: Names,
    tables: Tables,
    file: String,
    block: String,
    controller: String,
}

/// What things are called.
struct Names {
    function: String,
    upper: String,
    prefix: String,
    /// The status with which there are inputs.
    act: &'static str,
    /// The parameter for the inputs.
    array: String,
}

impl ControllerSource {
    fn new(controller: &Controller, name: &str, file: &str) -> Result<Self, ExportError> {
        let tables = Tables::new(controller)?;
        Ok(Self {
            names: Names::new(name, &tables),
            name: comment(name),
            version: env!("CARGO_PKG_VERSION"),
            promise: promise(controller),
            file: comment(file),
            state: if tables.steers { "x" } else { "y" },
            tables,
        })
    }

    fn table(&self, name: &str) -> askama::Result<String> {
        self.tables.get(name).map(c_table)
    }
}

impl Names {
    fn new(name: &str, tables: &Tables) -> Self {
        let prefix = identifier(name);
        let upper = prefix.to_uppercase();
        let array = if tables.steers {
            format!("u[{upper}_GROUP][{upper}_INPUTS]")
        } else {
            format!("u[{}]", tables.inputs.max(1))
        };
        let act = if tables.steers { "STEER" } else { "APPLY" };
        Self { function: format!("{prefix}_control"), upper, prefix, act, array }
    }
}

fn promise(controller: &Controller) -> String {
    let mut sentences = controller.promise();
    if let Law::Centered(law) = &controller.law {
        sentences.push(comment(&law.words()));
    }
    lines(&sentences, " *")
}

/// The controller as C99; `name` is the model's, `file` how the file will be called.
///
/// The function `<name>_control` gives the same inputs as [`Controller::control`], bit by bit if products
/// and sums are not contracted, with a status for every other [`Decision`](crate::controller::Decision).
///
/// # Errors
/// [`ExportError`] if the horizon is longer than the code's counter.
pub fn c_source(controller: &Controller, name: &str, file: &str) -> Result<String, ExportError> {
    Ok(ended(ControllerSource::new(controller, name, file)?.render()?))
}

/// What [`c_source`] defines for other files: sizes, statuses and the function.
///
/// # Errors
/// [`ExportError`] if the horizon is longer than the code's counter.
pub fn c_header(controller: &Controller, name: &str) -> Result<String, ExportError> {
    let source = ControllerSource::new(controller, name, "")?;
    let ControllerSource { names, name, version, promise, tables, .. } = source;
    Ok(ended(Header { names, name, version, promise, tables }.render()?))
}

/// The controller as a level-2 S-function of Simulink in C; `block` is what the file is called without its ending.
///
/// One parameter: the time of one step. Input: the state. Outputs: the input of this step, and the status. It looks at the
/// state once in `d` steps and hands out the inputs of each of them.
///
/// # Errors
/// [`ExportError`] if the horizon is longer than the code's counter.
pub fn s_function_source(controller: &Controller, name: &str, block: &str) -> Result<String, ExportError> {
    let file = format!("{block}.c");
    let source = ControllerSource::new(controller, name, &file)?;
    let controller = ended(source.render()?);
    let ControllerSource { names, tables, file, .. } = source;
    Ok(ended(SFunction { names, tables, file, block: block.to_owned(), controller }.render()?))
}
