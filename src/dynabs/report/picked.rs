//! What there is to know about one cell: the first one here, any other by the page's script.

use super::material::Material;
use super::numbers::{short, subscripted, tuple};
use crate::controller::Decision;
use crate::partition::{CellId, CellKind};

/// The names and values of the facts about a cell at a step, as the script writes them too.
pub(super) fn facts(
    material: &Material<'_>,
    cell: CellId,
    step: usize,
) -> Vec<(&'static str, &'static str, String)> {
    let problem = material.problem();
    let coordinates = problem.grid().coordinates(cell);
    let sides = coordinates.iter().enumerate().map(|(j, &i)| {
        let faces = &material.faces()[j];
        let (lower, upper) = (short(faces[i as usize]), short(faces[i as usize + 1]));
        format!("{} ∈ [{lower}, {upper})", subscripted("x", j + 1))
    });
    let kind = match material.controller.kind(cell) {
        CellKind::Ordinary => "ordinary",
        CellKind::Goal => "goal",
        CellKind::Unsafe => "unsafe",
    };
    let state = material.run.abstraction.state_of_cell[cell.index()];
    let enabled = match material.controller.kind(cell) {
        CellKind::Ordinary => material.run.abstraction.model.choices().rows(state).count().to_string(),
        _ => "none needed".to_owned(),
    };
    let (best, leads) = match material.controller.decide_in(cell, step as u64) {
        Decision::Act { action } => {
            let next = material.mean_successor(cell, step).unwrap_or_default();
            (format!("steer to d = {}", tuple(material.controller.action(action))), tuple(&next))
        }
        _ => ("none".to_owned(), "–".to_owned()),
    };
    let value = format!("{:.6}", floor_six(f64::from(material.values.at(step)[cell.index()])));
    vec![
        ("cell", "cell", sides.collect::<Vec<_>>().join(", ")),
        ("kind", "kind", kind.to_owned()),
        ("value", "value", value),
        ("enabled", "enabled actions", enabled),
        ("best", "best action", best),
        ("leads", "leads to, on average", leads),
    ]
}

/// A lower bound stays one when it is printed with six decimals.
fn floor_six(x: f64) -> f64 {
    (x * 1e6).floor() / 1e6
}
