//! The controller as self-describing JSON.

use super::memory_json::memory_tables;
use crate::controller::Controller;
use crate::controller::law::Law;
use crate::partition::{CellId, CellKind};
use crate::problem::{Problem, Stabilizer};
use crate::task::Memory;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::{self, Write};

/// Writes the controller of a problem whose actions are targets with everything needed to apply it, and what is promised
/// about it.
///
/// # Errors
/// What writing gives.
pub fn write_json(controller: &Controller, problem: &Problem, mut out: impl Write) -> io::Result<()> {
    let system = problem.step_system();
    let mut value = json!({
        "format": "dynabs controller",
        "format_version": 1,
        "version": env!("CARGO_PKG_VERSION"),
        "name": problem.name(),
        "units": "states, inputs and times are in the units of the model file; one step is one step of its dynamics",
        "promise": {
            "text": controller.promise().join(" "),
            "numbers": controller.promised(),
            "guarantee": controller.guarantee(),
        },
        "system": {
            "about": "x+ = A x + B u + q + noise, one step",
            "A": matrix(&system.a().to_f64()),
            "B": matrix(&system.b().to_f64()),
            "q": matrix(&system.q().to_f64().transpose())[0],
            "input": {
                "about": "U = {u : G u <= g}, one step",
                "G": matrix(&problem.step_input().normals().to_f64()),
                "g": problem.step_input().offsets().iter().map(imdp::numeric::to_f64).collect::<Vec<_>>(),
            },
            "stabilizer": problem.stabilizer().map(stabilizer),
        },
        "law": law(controller),
        "grid": {
            "about": "cell (i1, i2, ...) is [faces[0][i1], faces[0][i1 + 1]) x ..., its number the sum of i_j * strides[j]",
            "faces": controller.lookup.faces(),
            "strides": controller.lookup.strides(),
        },
        "cells": {
            "about": "in goal cells the task is done; in unsafe cells and outside the grid it has failed; cells \
                      without an action are those that the policy does not list",
            "goal": of_kind(controller, CellKind::Goal),
            "unsafe": of_kind(controller, CellKind::Unsafe),
            "bounds_about": "the guaranteed probability of success from each cell at the start",
            "bounds": bounds(controller),
        },
        "policy": policy(controller, 0),
        "targets": targets(controller),
    });
    if let Some(memory) = memory_tables(controller) {
        let by_memory = (0..controller.task().memories()).map(|memory| policy(controller, memory));
        value["policy"] = json!({"about": "one for each memory", "by_memory": by_memory.collect::<Vec<_>>()});
        value["memory"] = memory;
    }
    serde_json::to_writer(&mut out, &value)?;
    writeln!(out)
}

/// What is done without being asked.
fn stabilizer(stabilizer: &Stabilizer) -> Value {
    match stabilizer {
        Stabilizer::Feedback(feedback) => json!({
            "about": "u = -K (x - about) + u', on the grouped system; contained in the law below",
            "K": matrix(&feedback.layers.gain().to_f64()),
            "at": matrix(&feedback.layers.about().to_f64().transpose())[0],
        }),
        Stabilizer::Tracking(tracking) => json!({
            "about": "u = u_plan(x) + u' with u' in U' = {u : G u <= g}, on the grouped system; contained in the law below, \
                      whose targets are near those of the plan",
            "G": matrix(&tracking.abstract_input().normals().to_f64()),
            "g": tracking.abstract_input().offsets().iter().map(imdp::numeric::to_f64).collect::<Vec<_>>(),
        }),
    }
}

/// How an action and a state give inputs.
pub(super) fn law(controller: &Controller) -> Value {
    let (n, p) = (controller.state_dimension(), controller.step_inputs());
    match &controller.law {
        Law::Steering(law) => json!({
            "about": "u = c + M d + N x: the inputs of `group_steps` steps, those of the first step first, that \
                      steer from x to the target d",
            "group_steps": controller.group_steps(),
            "inputs_per_step": p,
            "M": table(&law.target_gain, n),
            "N": table(&law.state_gain, n),
            "c": law.constant,
        }),
        Law::Centered(law) => json!({
            "about": "u = nominal input of the action - K (x - center of the cell)",
            "x": law.coordinates[0],
            "u": law.coordinates[1],
            "nominal": if p == 0 { vec![] } else { table(&law.nominal, p) },
            "K": table(law.feedback.nearest_gain(), n),
        }),
    }
}

/// The numbers of all cells of a kind.
pub(super) fn of_kind(controller: &Controller, kind: CellKind) -> Vec<u32> {
    (0..controller.num_cells()).filter(|&cell| controller.kind(CellId(cell)) == kind).collect()
}

/// The guaranteed probability of success from each cell.
pub(super) fn bounds(controller: &Controller) -> Vec<f64> {
    (0..controller.num_cells()).map(|cell| controller.bound(CellId(cell))).collect()
}

/// The actions of a memory at the start and what changes from step to step.
fn policy(controller: &Controller, memory: Memory) -> Value {
    let cells = || (0..controller.num_cells()).map(CellId);
    let first =
        |cell: CellId| controller.entries(memory, cell).last().map(|entry| json!([cell.0, entry.action]));
    let mut changes: BTreeMap<u64, Vec<Value>> = BTreeMap::new();
    if let Some(horizon) = controller.horizon() {
        for cell in cells() {
            let entries = controller.entries(memory, cell);
            for pair in entries.windows(2) {
                let step = horizon + 1 - pair[1].steps_left;
                changes.entry(step).or_default().push(json!([cell.0, pair[0].action]));
            }
            // From here on nothing leads to the goal in time.
            if let Some(entry) = entries.first().filter(|entry| entry.steps_left > 1) {
                changes.entry(horizon + 1 - entry.steps_left).or_default().push(json!([cell.0, null]));
            }
        }
    }
    let changes: Vec<Value> =
        changes.into_iter().map(|(step, cells)| json!({"step": step, "cells": cells})).collect();
    json!({
        "about": "pairs [cell, target]; `start` holds at grouped step 0, each change from its step on (target null: \
                  none any more); without a horizon `start` holds for ever",
        "horizon": controller.horizon(),
        "start": cells().filter_map(first).collect::<Vec<_>>(),
        "changes": changes,
    })
}

/// The points of the targets that are used.
fn targets(controller: &Controller) -> Value {
    let pairs = (0..controller.task().memories())
        .flat_map(|memory| (0..controller.num_cells()).map(move |cell| (memory, CellId(cell))));
    let entries = pairs.flat_map(|(memory, cell)| controller.entries(memory, cell));
    let points: BTreeMap<u32, &[f64]> =
        entries.map(|entry| (entry.action, controller.action(entry.action))).collect();
    points.into_iter().map(|(target, point)| (target.to_string(), json!(point))).collect()
}

fn matrix(m: &nalgebra::DMatrix<f64>) -> Vec<Vec<f64>> {
    m.row_iter().map(|row| row.iter().copied().collect()).collect()
}

fn table(entries: &[f64], columns: usize) -> Vec<&[f64]> {
    entries.chunks_exact(columns).collect()
}
