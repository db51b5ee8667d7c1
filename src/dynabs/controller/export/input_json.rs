//! The controller of a problem whose actions are inputs, as self-describing JSON.

use super::json::{bounds, law, of_kind};
use super::memory_json::memory_tables;
use crate::controller::Controller;
use crate::controller::law::Law;
use crate::partition::{CellId, CellKind};
use crate::task::Memory;
use serde_json::json;
use std::io::{self, Write};

/// Writes the controller with everything needed to apply it, and what is promised about it.
///
/// # Errors
/// What writing gives.
pub fn write_input_json(controller: &Controller, name: &str, mut out: impl Write) -> io::Result<()> {
    let cells = || (0..controller.num_cells()).map(CellId);
    let entries = |memory: Memory, cell: CellId| -> Vec<[u64; 2]> {
        controller.entries(memory, cell).iter().map(|entry| [entry.steps_left, entry.action.into()]).collect()
    };
    let of_memory = |memory| cells().map(|cell| entries(memory, cell)).collect::<Vec<_>>();
    let mut value = json!({
        "format": "dynabs controller",
        "format_version": 1,
        "version": env!("CARGO_PKG_VERSION"),
        "name": name,
        "actions": "inputs",
        "promise": {"text": controller.promise().join(" "), "bound": controller.promised(), "guarantee": controller.guarantee()},
        "law": law(controller),
        "grid": {
            "about": "cell (i1, i2, ...) is [faces[0][i1], faces[0][i1 + 1]) x ..., its number the sum of i_j * strides[j]; \
                      first x_j is moved into [faces[0], faces[-1]) by multiples of period[j] where that is not 0",
            "faces": controller.lookup.faces(),
            "centers": centers(controller),
            "strides": controller.lookup.strides(),
            "period": controller.periods.lengths,
        },
        "cells": {
            "about": "in goal cells the task is done; in unsafe cells and outside the grid it has failed",
            "goal": of_kind(controller, CellKind::Goal),
            "unsafe": of_kind(controller, CellKind::Unsafe),
            "bounds_about": "the guaranteed probability of success from each cell at the start",
            "bounds": bounds(controller),
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

fn centers(controller: &Controller) -> &[Vec<f64>] {
    match &controller.law {
        Law::Centered(law) => &law.centers,
        Law::Steering(_) => &[],
    }
}
