//! The controller as one self-contained C99 file.

use crate::controller::Controller;
use crate::partition::{CellId, CellKind};
use crate::problem::Problem;
use crate::rendered::ended;
use askama::Template;
use std::collections::BTreeMap;
use std::fmt::Display;

/// The width of a line of C.
const WIDTH: usize = 110;

/// Why there is no C file.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CSourceError {
    /// The horizon does not fit the generated code's counter of 32 bits.
    #[error("a horizon of {steps} grouped steps; the C code counts up to 4294967295")]
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
    version: String,
    promise: String,
    file: String,
    function: String,
    upper: String,
    prefix: String,
    states: String,
    inputs: String,
    group: String,
    horizon: String,
    constant: String,
    target_gain: String,
    state_gain: String,
    num_faces: String,
    faces: String,
    first_face: String,
    stride: String,
    num_cells: String,
    kind: String,
    first_entry: String,
    num_entries: String,
    steps_left: String,
    target_of: String,
    num_targets: String,
    target: String,
}

/// The controller as C99; `file` is how the file will be called.
///
/// The function `<name>_control` gives the same inputs as [`Controller::control`], bit by bit if products
/// and sums are not contracted, with a status for every other [`Decision`](crate::controller::Decision).
///
/// # Errors
/// [`CSourceError`] if the horizon is longer than C's counter.
pub fn c_source(controller: &Controller, problem: &Problem, file: &str) -> Result<String, CSourceError> {
    let steps = controller.horizon().unwrap_or(0);
    let horizon = u32::try_from(steps).map_err(|_| CSourceError::HorizonTooLong { steps })?;
    let n = controller.state_dimension();
    let prefix = identifier(problem.name());
    let policy = Tables::new(controller);
    let faces = controller.lookup.faces();
    let first_face = faces.iter().scan(0, |sum, faces| {
        *sum += faces.len();
        Some(*sum)
    });
    let kind = |kind: &CellKind| match kind {
        CellKind::Ordinary => 0,
        CellKind::Goal => 1,
        CellKind::Unsafe => 2,
    };
    let source = ControllerSource {
        name: comment(problem.name()),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        promise: promise(&controller.promise()),
        file: comment(file),
        function: format!("{prefix}_control"),
        upper: prefix.to_uppercase(),
        states: n.to_string(),
        inputs: controller.step_inputs().to_string(),
        group: controller.group_steps().to_string(),
        horizon: horizon.to_string(),
        constant: list(controller.law.constant.iter().map(double)),
        target_gain: rows(&controller.law.target_gain, n),
        state_gain: rows(&controller.law.state_gain, n),
        num_faces: faces.iter().map(Vec::len).sum::<usize>().to_string(),
        faces: list(faces.iter().flatten().map(double)),
        first_face: list(std::iter::once(0).chain(first_face)),
        stride: list(controller.lookup.strides().iter()),
        num_cells: controller.num_cells().to_string(),
        kind: list(controller.kinds.iter().map(kind)),
        first_entry: list(controller.schedule.starts.iter()),
        num_entries: policy.steps_left.len().to_string(),
        steps_left: list(policy.steps_left.iter()),
        target_of: list(policy.target_of.iter()),
        num_targets: (policy.points.len() / n).to_string(),
        target: rows(&policy.points, n),
        prefix,
    };
    source.render().map(ended).map_err(|error| CSourceError::Template { found: error.to_string() })
}

/// The schedule with targets renumbered: only those that are used.
struct Tables {
    steps_left: Vec<u64>,
    target_of: Vec<u32>,
    points: Vec<f64>,
}

impl Tables {
    fn new(controller: &Controller) -> Self {
        let entries = (0..controller.num_cells()).flat_map(|cell| controller.entries(CellId(cell)));
        let mut number: BTreeMap<u32, u32> = entries.clone().map(|entry| (entry.target, 0)).collect();
        number.values_mut().zip(0..).for_each(|(number, i)| *number = i);
        let mut tables = Self {
            steps_left: entries.clone().map(|entry| entry.steps_left).collect(),
            target_of: entries.map(|entry| number[&entry.target]).collect(),
            points: number.keys().flat_map(|&target| controller.target_point(target)).copied().collect(),
        };
        if tables.target_of.is_empty() {
            // C has no empty arrays; nothing refers to this entry.
            tables.steps_left.push(0);
            tables.target_of.push(0);
            tables.points.resize(controller.state_dimension(), 0.0);
        }
        tables
    }
}

/// The shortest literal that a C compiler reads as this double.
pub(super) fn double(x: &f64) -> String {
    format!("{x:?}")
}

/// Items separated by commas, on lines of readable width.
pub(super) fn list(items: impl Iterator<Item = impl Display>) -> String {
    let mut text = String::from("   ");
    let mut column = text.len();
    for (i, item) in items.enumerate() {
        let item = item.to_string();
        if i > 0 {
            text.push(',');
            if column + item.len() + 2 > WIDTH {
                text.push_str("\n   ");
                column = 3;
            }
        }
        text.push(' ');
        text.push_str(&item);
        column += item.len() + 2;
    }
    text
}

/// A table with rows of `n` doubles.
pub(super) fn rows(table: &[f64], n: usize) -> String {
    let row = |row: &[f64]| format!("    {{{}}}", row.iter().map(double).collect::<Vec<_>>().join(", "));
    table.chunks_exact(n).map(row).collect::<Vec<_>>().join(",\n")
}

/// A C identifier made of a name.
pub(super) fn identifier(name: &str) -> String {
    let mut text: String =
        name.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' }).collect();
    if !text.starts_with(|c: char| c.is_ascii_alphabetic()) {
        // Names that start with a digit are none, those with an underscore are reserved.
        text.insert(0, 'c');
    }
    text
}

/// Text that neither ends a comment nor means anything else to a C compiler.
pub(super) fn comment(text: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || " _.,:;()=<>+-".contains(c);
    text.chars().map(|c| if plain(c) { c } else { '_' }).collect()
}

/// Sentences as lines of a comment.
pub(super) fn promise(sentences: &[String]) -> String {
    let mut lines = vec![];
    let mut line = String::from(" *");
    for word in sentences.iter().flat_map(|sentence| sentence.split(' ')) {
        if line.len() + word.len() + 1 > WIDTH {
            lines.push(std::mem::replace(&mut line, String::from(" *")));
        }
        line.push(' ');
        line.push_str(word);
    }
    lines.push(line);
    lines.join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_harmless() {
        assert_eq!(identifier("Räume 2*/"), "r_ume_2__");
        assert_eq!(
            (identifier("2-D"), identifier("_x"), identifier("")),
            ("c2_d".into(), "c_x".into(), "c".into())
        );
        assert_eq!(comment("a*/ b??/\n\"é\""), "a__ b_______");
    }

    #[test]
    fn doubles_are_double_literals() {
        for (x, text) in
            [(1.0, "1.0"), (0.1, "0.1"), (1e300, "1e300"), (-5e-324, "-5e-324"), (1e15, "1000000000000000.0")]
        {
            assert_eq!(double(&x), text);
        }
    }
}
