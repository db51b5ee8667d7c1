//! The controller of a problem whose actions are inputs, as JSON and as a table.

use super::csv::{geometry, join};
use crate::controller::{Entry, InputController};
use crate::partition::{CellId, CellKind, Grid};
use crate::task::{HalfSpace, Memory, Standing};
use imdp::numeric::shortest_decimal;
use serde_json::json;
use std::io::{self, Write};

/// Writes the controller with everything needed to apply it, and what is promised about it.
///
/// # Errors
/// What writing gives.
pub fn write_input_json(controller: &InputController, name: &str, mut out: impl Write) -> io::Result<()> {
    let (n, p) = (controller.state_dimension(), controller.num_inputs());
    let cells = || (0..controller.num_cells()).map(CellId);
    let of_kind = |kind| -> Vec<u32> {
        cells().filter(|&cell| controller.kind(cell) == kind).map(|cell| cell.0).collect()
    };
    let entries = |memory: Memory, cell: CellId| -> Vec<[u64; 2]> {
        controller.entries(memory, cell).iter().map(|entry| [entry.steps_left, entry.target.into()]).collect()
    };
    let of_memory = |memory| cells().map(|cell| entries(memory, cell)).collect::<Vec<_>>();
    let mut value = json!({
        "format": "dynabs controller",
        "format_version": 1,
        "version": env!("CARGO_PKG_VERSION"),
        "name": name,
        "actions": "inputs",
        "promise": {"text": controller.promise().join(" "), "bound": controller.promised(), "guarantee": controller.guarantee()},
        "law": {
            "about": "u = nominal input of the action - K (x - center of the cell)",
            "nominal": if p == 0 { vec![] } else { controller.inputs.chunks_exact(p).collect::<Vec<_>>() },
            "K": controller.feedback.nearest_gain().chunks_exact(n).collect::<Vec<_>>(),
        },
        "grid": {
            "about": "cell (i1, i2, ...) is [faces[0][i1], faces[0][i1 + 1]) x ..., its number the sum of i_j * strides[j]; \
                      first x_j is moved into [faces[0], faces[-1]) by multiples of period[j] where that is not 0",
            "faces": controller.lookup.faces(),
            "centers": controller.centers,
            "strides": controller.lookup.strides(),
            "period": controller.periods,
        },
        "cells": {
            "about": "in goal cells the task is done; in unsafe cells and outside the grid it has failed",
            "goal": of_kind(CellKind::Goal),
            "unsafe": of_kind(CellKind::Unsafe),
            "bounds_about": "the guaranteed probability of success from each cell at the start",
            "bounds": cells().map(|cell| controller.bound(cell)).collect::<Vec<_>>(),
        },
        "policy": {
            "about": "by cell, ascending pairs [steps left, action]: each holds from that many steps left upwards",
            "horizon": controller.horizon(),
            "entries": of_memory(0),
        },
    });
    if let Some(memory) = memory_tables(controller) {
        value["policy"]["about"] =
            "by memory and cell, ascending pairs [steps left, action]: each holds from that many steps left upwards".into();
        value["policy"]["entries"] = (0..controller.task().memories()).map(of_memory).collect();
        value["memory"] = memory;
    }
    serde_json::to_writer(&mut out, &value)?;
    writeln!(out)
}

/// How memories change, if the task is an automaton.
fn memory_tables(controller: &InputController) -> Option<serde_json::Value> {
    let task = controller.task();
    let letters = task.letters()?;
    let standing = |standing: &Standing| match *standing {
        Standing::Open(memory) => json!(memory),
        Standing::Reached => json!("done"),
        Standing::Failed => json!("failed"),
    };
    let half_space = |half_space: &HalfSpace| json!({"normal": half_space.normal, "offset": half_space.offset, "strict": half_space.strict});
    let shape = |shape: &Vec<HalfSpace>| shape.iter().map(half_space).collect::<Vec<_>>();
    let region = |shapes: &Vec<Vec<HalfSpace>>| shapes.iter().map(shape).collect::<Vec<_>>();
    Some(json!({
        "about": "a run begins in the last row of next; at every state, memory = next[memory][letter], where bit r of letter says \
                  whether the state is in region r: the bits certain[class of the cell], and those of possible[class] whose \
                  region contains the state (all half-spaces of one of its shapes: normal * x < offset if strict, else <=)",
        "memories": task.memories(),
        "next": letters.next.iter().map(|row| row.iter().map(standing).collect::<Vec<_>>()).collect::<Vec<_>>(),
        "class_of_cell": (0..controller.num_cells()).map(|cell| task.class(CellId(cell))).collect::<Vec<_>>(),
        "certain": letters.labels.iter().map(|label| label.certain).collect::<Vec<_>>(),
        "possible": letters.labels.iter().map(|label| label.possible).collect::<Vec<_>>(),
        "regions": controller.memory.letters().regions().iter().map(region).collect::<Vec<_>>(),
    }))
}

/// Writes one line per cell and range of steps with the same action.
///
/// Columns: `from_step`, `to_step` (steps elapsed, inclusive; both empty where time does not matter), `cell`, `kind`
/// (`ordinary`, `goal`, `unsafe`), `lower…`, `upper…`, `center…` of the cell, `action` (empty where there is none), the
/// nominal input `u…`, and `bound`, the guaranteed probability of success from the cell at the start. If the task is an
/// automaton a first column `memory` says for which memory the line is; cells in which a memory has nothing to do are left out.
///
/// # Errors
/// What writing gives.
pub fn write_input_csv(controller: &InputController, grid: &Grid, mut out: impl Write) -> io::Result<()> {
    let named = |name: &str, count: usize| (1..=count).map(|j| format!("{name}{j},")).collect::<String>();
    let (n, p) = (controller.state_dimension(), controller.num_inputs());
    let [lower, upper, center] = ["lower", "upper", "center"].map(|name| named(name, n));
    let has_memory = controller.task().letters().is_some();
    let first = if has_memory { "memory," } else { "" };
    writeln!(out, "{first}from_step,to_step,cell,kind,{lower}{upper}{center}action,{}bound", named("u", p))?;
    for memory in 0..controller.task().memories() {
        let first = if has_memory { format!("{memory},") } else { String::new() };
        for cell in (0..controller.num_cells()).map(CellId) {
            if has_memory && !controller.task().open(cell.index()).contains(&memory) {
                continue;
            }
            let (bounds, bound) = (geometry(grid, cell), shortest_decimal(controller.bound(cell)));
            let kind = match controller.kind(cell) {
                CellKind::Ordinary => "ordinary",
                CellKind::Goal => "goal",
                CellKind::Unsafe => "unsafe",
            };
            let entries = controller.entries(memory, cell);
            if entries.is_empty() {
                writeln!(out, "{first},,{},{kind},{bounds},,{}{bound}", cell.0, ",".repeat(p))?;
            }
            for (i, entry) in entries.iter().enumerate().rev() {
                let later = entries.get(i + 1).map(|next| next.steps_left);
                let (from, to) = steps(controller.horizon(), entry, later);
                let input = join(controller.nominal(entry.target).iter().copied());
                let input = if p == 0 { input } else { input + "," };
                let bound = if later.is_none() { bound.as_str() } else { "" };
                let cell = cell.0;
                writeln!(out, "{first}{from},{to},{cell},{kind},{bounds},u_{},{input}{bound}", entry.target)?;
            }
        }
    }
    Ok(())
}

/// From which to which step an entry holds.
fn steps(horizon: Option<u64>, entry: &Entry, later: Option<u64>) -> (String, String) {
    match horizon {
        None => (String::new(), String::new()),
        Some(horizon) => {
            let from = later.map_or(0, |left| horizon + 1 - left);
            (from.to_string(), (horizon - entry.steps_left).to_string())
        }
    }
}
