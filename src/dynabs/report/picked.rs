//! What there is to know about one cell: the first one here, any other by the page's script.

use super::numbers::{short, tuple};
use super::scene::Scene;
use crate::partition::{CellId, CellKind};

/// The names and values of the facts about a cell at a step, as the script writes them too.
pub(super) fn facts(
    scene: &Scene<'_>,
    cell: CellId,
    step: usize,
) -> Vec<(&'static str, &'static str, String)> {
    let coordinates = scene.grid.coordinates(cell);
    let sides = coordinates.iter().enumerate().map(|(j, &i)| {
        let faces = &scene.faces()[j];
        let (lower, upper) = (short(faces[i as usize]), short(faces[i as usize + 1]));
        format!("{} ∈ [{lower}, {upper})", scene.names[j])
    });
    let kind = scene.actions.kind(None, cell);
    let enabled = match kind {
        CellKind::Ordinary => scene.actions.enabled(cell).to_string(),
        _ => "none needed".to_owned(),
    };
    let kind = match (kind, scene.memories.is_empty()) {
        (CellKind::Ordinary, true) => "ordinary",
        (CellKind::Ordinary, false) => "open",
        (CellKind::Goal, true) => "goal",
        (CellKind::Goal, false) => "done",
        (CellKind::Unsafe, true) => "unsafe",
        (CellKind::Unsafe, false) => "failed",
    };
    let (best, leads) = match scene.action(cell, step) {
        Some(action) => (scene.actions.words(action), tuple(&scene.actions.successor(cell, action))),
        None => ("none".to_owned(), "–".to_owned()),
    };
    let value = format!("{:.6}", floor_six(f64::from(scene.values.at(step)[cell.index()])));
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
