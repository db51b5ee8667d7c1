//! The controller as one self-contained C99 file.

use super::c_law::LawSource;
use super::c_memory::MemorySource;
use super::c_text::{comment, double, filled, identifier, list, promise};
use crate::controller::Controller;
use crate::controller::law::Law;
use crate::partition::{CellId, CellKind};
use crate::rendered::ended;
use askama::Template;

/// Why there is no C file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CSourceError {
    /// The horizon does not fit the generated code's counter of 32 bits.
    #[error(
        "found a horizon of {steps} grouped steps; expected at most 4294967295, up to which the C code counts"
    )]
    HorizonTooLong {
        /// The horizon.
        steps: u64,
    },
    /// The template cannot be rendered: a mistake in this program.
    #[error("the template of the C code cannot be rendered: {found}")]
    Template {
        /// What the template engine says.
        found: String,
    },
}

/// The file, field by field as the template names them.
#[derive(Template)]
#[template(path = "controller.c", escape = "none")]
struct ControllerSource {
    name: String,
    version: &'static str,
    promise: String,
    file: String,
    function: String,
    upper: String,
    prefix: String,
    states: usize,
    inputs: usize,
    group: usize,
    horizon: u32,
    num_faces: usize,
    faces: String,
    first_face: String,
    stride: String,
    num_cells: u32,
    kind: String,
    memory: Option<MemorySource>,
    num_starts: usize,
    first_entry: String,
    num_entries: usize,
    steps_left: String,
    actions: String,
    law: LawSource,
    /// What the tables and variables of this kind of actions are called.
    act: &'static str,
    action_of: &'static str,
    array: String,
    state: &'static str,
}

/// The controller as C99; `name` is the model's, `file` how the file will be called.
///
/// The function `<name>_control` gives the same inputs as [`Controller::control`], bit by bit if products
/// and sums are not contracted, with a status for every other [`Decision`](crate::controller::Decision).
///
/// # Errors
/// [`CSourceError`] if the horizon is longer than C's counter.
pub fn c_source(controller: &Controller, name: &str, file: &str) -> Result<String, CSourceError> {
    let steps = controller.horizon().unwrap_or(0);
    let horizon = u32::try_from(steps).map_err(|_| CSourceError::HorizonTooLong { steps })?;
    let prefix = identifier(name);
    let upper = prefix.to_uppercase();
    let faces = controller.lookup.faces();
    let first_face = faces.iter().scan(0, |sum, faces| {
        *sum += faces.len();
        Some(*sum)
    });
    let kind = |cell| match controller.kind(CellId(cell)) {
        CellKind::Ordinary => 0,
        CellKind::Goal => 1,
        CellKind::Unsafe => 2,
    };
    let entries = &controller.schedule.entries;
    let steps_left: Vec<u64> = entries.iter().map(|entry| entry.steps_left).collect();
    let (law, actions) = LawSource::new(controller);
    let (act, action_of, state, array) = match &law {
        LawSource::Steering(_) => ("STEER", "target_of", "x", format!("u[{upper}_GROUP][{upper}_INPUTS]")),
        LawSource::Centered(law) => ("APPLY", "input_of", "y", format!("u[{}]", law.array_inputs)),
    };
    let mut sentences = controller.promise();
    if let Law::Centered(law) = &controller.law {
        sentences.push(comment(&law.words()));
    }
    let source = ControllerSource {
        name: comment(name),
        version: env!("CARGO_PKG_VERSION"),
        promise: promise(&sentences),
        file: comment(file),
        function: format!("{prefix}_control"),
        states: controller.state_dimension(),
        inputs: controller.step_inputs(),
        group: controller.group_steps(),
        horizon,
        num_faces: faces.iter().map(Vec::len).sum(),
        faces: list(faces.iter().flatten().map(double)),
        first_face: list(std::iter::once(0).chain(first_face)),
        stride: list(controller.lookup.strides().iter()),
        num_cells: controller.num_cells(),
        kind: list((0..controller.num_cells()).map(kind)),
        memory: MemorySource::new(controller),
        num_starts: controller.schedule.starts.len() - 1,
        first_entry: list(controller.schedule.starts.iter()),
        num_entries: entries.len().max(1),
        steps_left: list(filled(steps_left, 0).into_iter()),
        actions: list(filled(actions, 0).into_iter()),
        law,
        act,
        action_of,
        array,
        state,
        upper,
        prefix,
    };
    source.render().map(ended).map_err(|error| CSourceError::Template { found: error.to_string() })
}
