//! The controller of a problem whose actions are inputs, as one self-contained C99 file.

use super::c_memory::MemorySource;
use super::c_source::{CSourceError, comment, double, identifier, list, promise, rows};
use crate::controller::InputController;
use crate::partition::{CellId, CellKind};
use crate::rendered::ended;
use askama::Template;

/// The file, field by field as the template names them.
#[derive(Template)]
#[template(path = "input_controller.c", escape = "none")]
struct InputControllerSource {
    name: String,
    version: String,
    promise: String,
    file: String,
    function: String,
    upper: String,
    prefix: String,
    states: String,
    inputs: String,
    array_inputs: String,
    horizon: String,
    period: String,
    num_faces: String,
    faces: String,
    first_face: String,
    num_centers: String,
    centers: String,
    stride: String,
    num_cells: String,
    kind: String,
    memory: Option<MemorySource>,
    num_starts: String,
    first_entry: String,
    num_entries: String,
    steps_left: String,
    input_of: String,
    num_nominal: String,
    nominal: String,
    gain: String,
}

/// The controller as C99; `name` is the model's, `file` how the file will be called.
///
/// The function `<name>_control` gives the same inputs as [`InputController::control`], bit by bit if products and sums are
/// not contracted.
///
/// # Errors
/// [`CSourceError`] if the horizon is longer than C's counter.
pub fn input_c_source(controller: &InputController, name: &str, file: &str) -> Result<String, CSourceError> {
    let steps = controller.horizon().unwrap_or(0);
    let horizon = u32::try_from(steps).map_err(|_| CSourceError::HorizonTooLong { steps })?;
    let (n, p) = (controller.state_dimension(), controller.num_inputs());
    let prefix = identifier(name);
    let faces = controller.lookup.faces();
    let first_face = faces.iter().scan(0, |sum, faces| {
        *sum += faces.len();
        Some(*sum)
    });
    let kind = |kind: CellKind| match kind {
        CellKind::Ordinary => 0,
        CellKind::Goal => 1,
        CellKind::Unsafe => 2,
    };
    // C has no empty arrays.
    let padded = |table: &[f64], width: usize| {
        let mut table = table.to_vec();
        if table.is_empty() {
            table.push(0.0);
        }
        rows(&table, width.max(1))
    };
    let entries = &controller.schedule.entries;
    let or_zero = |numbers: Vec<u64>| list(if numbers.is_empty() { vec![0] } else { numbers }.into_iter());
    let gain = controller.feedback.nearest_gain();
    let source = InputControllerSource {
        name: comment(name),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        promise: promise(&controller.promise()),
        file: comment(file),
        function: format!("{prefix}_control"),
        upper: prefix.to_uppercase(),
        states: n.to_string(),
        inputs: p.to_string(),
        array_inputs: p.max(1).to_string(),
        horizon: horizon.to_string(),
        period: list(controller.periods.iter().map(double)),
        num_faces: faces.iter().map(Vec::len).sum::<usize>().to_string(),
        faces: list(faces.iter().flatten().map(double)),
        first_face: list(std::iter::once(0).chain(first_face)),
        num_centers: controller.centers.iter().map(Vec::len).sum::<usize>().to_string(),
        centers: list(controller.centers.iter().flatten().map(double)),
        stride: list(controller.lookup.strides().iter()),
        num_cells: controller.num_cells().to_string(),
        kind: list((0..controller.num_cells()).map(|cell| kind(controller.kind(CellId(cell))))),
        memory: MemorySource::new(controller),
        num_starts: (controller.schedule.starts.len() - 1).to_string(),
        first_entry: list(controller.schedule.starts.iter()),
        num_entries: entries.len().max(1).to_string(),
        steps_left: or_zero(entries.iter().map(|entry| entry.steps_left).collect()),
        input_of: or_zero(entries.iter().map(|entry| entry.target.into()).collect()),
        num_nominal: (controller.inputs.len() / p.max(1)).max(1).to_string(),
        nominal: padded(&controller.inputs, p),
        gain: padded(gain, if p == 0 { 1 } else { n }),
        prefix,
    };
    source.render().map(ended).map_err(|error| CSourceError::Template { found: error.to_string() })
}
