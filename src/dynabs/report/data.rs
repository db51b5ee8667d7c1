//! The numbers that a page's script redraws plots from.

use super::budget::fits;
use super::choice::plain;
use super::input_material::InputMaterial;
use super::material::Material;
use super::numbers::compact;
use super::outlines::Outlined;
use super::palette::{FIRST_LIGHT_LEVEL, LEVELS, colour};
use super::paths::class;
use super::scene::Scene;
use super::sides::sides;
use super::values::StepValues;
use super::view::{Axis, View};
use crate::partition::{CellId, CellKind, Region};
use crate::task::HalfSpace;
use data_encoding::BASE64;
use serde_json::{Value, json};

/// The most bytes of ranges of enabled actions.
const MOST_OF_RANGES: usize = 700_000;

/// What is embedded, and what is left out for its size.
pub(super) struct Embedded {
    /// JSON that may stand in a script element; `null` if the page is static.
    pub(super) json: String,
    pub(super) left_out: Vec<String>,
}

/// What the script needs to know about actions.
pub(super) struct EmbeddedActions {
    /// The fields.
    pub(super) fields: Value,
    pub(super) left_out: Vec<String>,
}

/// Everything that the script needs; `actions` is asked only if the page is not static.
pub(super) fn embed(scene: &Scene<'_>, view: &View, actions: impl FnOnce() -> EmbeddedActions) -> Embedded {
    if !scene.is_embedded() {
        let (cells, maps) = (scene.grid.num_cells(), 1 + scene.memories.len());
        let of_memories = if maps > 1 { format!(" with {} memories", maps - 1) } else { String::new() };
        return fixed(format!(
            "{cells} cells{of_memories} are too many to embed: the plots cannot be changed"
        ));
    }
    let embedded = everything(scene, view, actions());
    match fits(&embedded.json) {
        true => embedded,
        false => {
            fixed("values and actions of all cells are too much to embed: the plots cannot be changed".into())
        }
    }
}

/// Nothing, and why.
fn fixed(note: String) -> Embedded {
    Embedded { json: "null".into(), left_out: vec![note] }
}

fn everything(scene: &Scene<'_>, view: &View, actions: EmbeddedActions) -> Embedded {
    let maps = 1 + scene.memories.len();
    let mut left_out = vec![];
    // With several memories there may be none but those at the start; what was there and is not is missing anyway.
    let last = scene.values.last_step();
    let is_left_out = |horizon: &u64| *horizon > last as u64 && (maps == 1 || scene.values.has_forgotten());
    if let Some(horizon) = scene.horizon.filter(is_left_out) {
        left_out.push(format!("values after step {last} of {horizon}"));
    }
    left_out.extend(actions.left_out);
    let kind = |(before, cell)| match scene.actions.kind(before, cell) {
        CellKind::Ordinary => 0,
        CellKind::Goal => 1,
        CellKind::Unsafe => 2,
    };
    let range = |end: fn((f64, f64)) -> f64| -> Vec<f64> {
        (0..scene.dimension()).map(|j| end(scene.range(j))).collect()
    };
    let values = scene.values.all().chain(scene.memories.iter().flat_map(StepValues::all));
    let bytes: Vec<u8> = values.flat_map(f32::to_le_bytes).collect();
    let mut value = json!({
        "names": scene.names,
        "titles": (0..scene.dimension()).map(|j| scene.title(j)).collect::<Vec<_>>(),
        "valueName": scene.value_name(),
        "time": scene.time_name(),
        "group": scene.group_steps,
        "horizon": scene.horizon,
        "lastStep": scene.last_step(),
        "lower": range(|(lower, _)| lower),
        "upper": range(|(_, upper)| upper),
        "cells": scene.grid.axes().iter().map(|axis| axis.cells()).collect::<Vec<_>>(),
        "strides": scene.grid.strides(),
        "plain": (0..scene.dimension()).map(|j| plain(scene, j)).collect::<Vec<_>>(),
        "units": scene.units,
        "periods": scene.periods,
        "scale": [scene.scale.from, scene.scale.to],
        "scaleLabels": scene.scale.labels(),
        "colours": (0..LEVELS).map(colour).collect::<Vec<_>>(),
        "firstLight": FIRST_LIGHT_LEVEL,
        "values": {"type": "f32", "data": BASE64.encode(&bytes)},
        "kinds": packed(scene.arrivals().map(kind)),
        "policy": policy(scene),
        "goal": regions(scene.wanted, scene.dimension()),
        "unsafe": regions(scene.unsafe_, scene.dimension()),
        "named": named(scene),
        "threshold": scene.threshold,
        "runs": runs(scene),
        "start": scene.start,
        "view": {
            "across": match view.across { Axis::Time => -1, Axis::State(j) => j as i64 },
            "up": view.up,
            "slice": view.slice,
            "step": view.step,
        },
    });
    if maps > 1 {
        value["memories"] = scene.memories.len().into();
    }
    if let (Value::Object(value), Value::Object(fields)) = (&mut value, actions.fields) {
        value.extend(fields);
    }
    if scene.trajectories.len() < scene.wanted_runs as usize {
        let (drawn, wanted) = (scene.trajectories.len(), scene.wanted_runs);
        left_out.push(format!("runs after the first {drawn} of {wanted}, which have many steps"));
    }
    // Texts are as they are, and the script makes them safe where they become markup; nothing in its element may look like the end.
    Embedded { json: value.to_string().replace('<', "\\u003c"), left_out }
}

/// The actions of every cell by the steps left.
fn policy(scene: &Scene<'_>) -> Value {
    let entries: Vec<_> = scene.arrivals().map(|(before, cell)| scene.shown_entries(before, cell)).collect();
    let all = entries.concat();
    json!({
        "counts": packed(entries.iter().map(|entries| entries.len() as u32)),
        "left": packed(all.iter().map(|(left, _)| u32::try_from(*left).unwrap_or(u32::MAX))),
        "target": packed(all.iter().map(|(_, action)| *action)),
    })
}

/// The targets that actions steer to, and which are enabled where.
pub(super) fn steering(material: &Material<'_>) -> EmbeddedActions {
    let ranges = ranges(material);
    let left_out = match ranges {
        None => vec!["which actions are enabled in each cell".into()],
        Some(_) => vec![],
    };
    let fields = json!({"targets": targets(material), "mean": material.noise_mean, "ranges": ranges});
    EmbeddedActions { fields, left_out }
}

/// The inputs, and where those of the policy lead.
pub(super) fn inputs(material: &InputMaterial<'_>) -> EmbeddedActions {
    let scene = &material.scene;
    let mut bytes = vec![];
    for (before, cell) in scene.arrivals() {
        for (_, action) in scene.shown_entries(before, cell) {
            let to = scene.actions.successor(cell, action);
            bytes.extend(to.iter().flat_map(|&x| (x as f32).to_le_bytes()));
        }
    }
    let words = (0..material.run.problem.inputs().len() as u32).map(|input| scene.actions.words(input));
    let successors = json!({"type": "f32", "data": BASE64.encode(&bytes)});
    let fields = json!({
        "targets": null, "ranges": null, "inputs": words.collect::<Vec<_>>(), "successors": successors
    });
    EmbeddedActions { fields, left_out: vec![] }
}

fn targets(material: &Material<'_>) -> Value {
    let targets = &material.run.abstraction.targets;
    match targets.axes() {
        Some(axes) => json!({"axes": axes}),
        None => {
            let points = (0..targets.len() as u32).map(|target| material.controller.action(target));
            json!({"points": points.collect::<Vec<_>>()})
        }
    }
}

/// The enabled actions of every cell, as ranges.
fn ranges(material: &Material<'_>) -> Option<Value> {
    let abstraction = &material.run.abstraction;
    let of = |cell: u32| abstraction.ranges(CellId(cell));
    let cells = 0..material.problem().grid().num_cells();
    let all = || cells.clone().flat_map(of);
    let ranges = json!({
        "counts": packed(cells.clone().map(|cell| of(cell).len() as u32)),
        "first": packed(all().map(|range| abstraction.target(range.first).0)),
        "length": packed(all().map(|range| range.len() as u32)),
    });
    (ranges.to_string().len() <= MOST_OF_RANGES).then_some(ranges)
}

fn regions(regions: &[Region], dimension: usize) -> Value {
    // Open sides are infinite, which JSON calls null.
    regions.iter().map(|region| json!((0..dimension).map(|j| sides(region, j)).collect::<Vec<_>>())).collect()
}

/// Regions with names, by shape their half-spaces: the normal, then the offset.
fn named(scene: &Scene<'_>) -> Value {
    let side = |side: &HalfSpace| json!((&side.normal, side.offset));
    let shape = |shape: &Vec<HalfSpace>| shape.iter().map(side).collect::<Value>();
    let region = |region: &Outlined| json!({"name": region.name, "shapes": region.shapes.iter().map(shape).collect::<Value>()});
    scene.named.iter().map(region).collect()
}

fn runs(scene: &Scene<'_>) -> Value {
    let d = scene.group_steps as f64;
    let run = |trajectory: &crate::controller::Trajectory| {
        let points = trajectory.steps.iter().map(|step| {
            let time = std::iter::once(compact(step.step as f64 / d));
            time.chain(step.state.iter().map(|&x| compact(x))).collect::<Vec<_>>()
        });
        let asked = trajectory.steps.iter().enumerate().filter(|(_, step)| step.decision.is_some());
        json!({
            "class": class(trajectory),
            "points": points.collect::<Vec<_>>(),
            "satisfied": trajectory.outcome.satisfied,
            "asked": asked.map(|(i, _)| i).collect::<Vec<_>>(),
        })
    };
    scene.trajectories.iter().map(run).collect()
}

/// Whole numbers in as few bytes as they need, little-endian.
fn packed(numbers: impl Iterator<Item = u32>) -> Value {
    let numbers: Vec<u32> = numbers.collect();
    let (name, width) = match numbers.iter().max() {
        Some(&most) if most > u32::from(u16::MAX) => ("u32", 4),
        Some(&most) if most > u32::from(u8::MAX) => ("u16", 2),
        _ => ("u8", 1),
    };
    let bytes: Vec<u8> = numbers.iter().flat_map(|n| n.to_le_bytes().into_iter().take(width)).collect();
    json!({"type": name, "data": BASE64.encode(&bytes)})
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_take_the_bytes_they_need() {
        assert_eq!(packed([1, 255].into_iter())["type"], "u8");
        assert_eq!(packed([256].into_iter()), json!({"type": "u16", "data": "AAE="}));
        assert_eq!(packed([65536].into_iter())["type"], "u32");
    }
}
