//! The controller as a table.

use crate::controller::law::Law;
use crate::controller::{Controller, Entry};
use crate::partition::{CellId, CellKind, Grid, GridAxis};
use crate::task::Memory;
use imdp::numeric::{Rational, shortest_decimal, to_f64};
use std::io::{self, Write};

/// Writes one line per cell and range of steps with the same action.
///
/// Columns: `from_step`, `to_step` (grouped steps elapsed, inclusive; both empty where time does not matter),
/// `cell`, `kind` (`ordinary`, `goal`, `unsafe`), `lower…`, `upper…`, `center…` of the cell, `action` (empty
/// where there is none), `target…` or the nominal input `u…`, and `bound`, the guaranteed probability of success from the
/// cell at the start (on the line of step 0). If the task is an automaton a first column `memory` says for which memory the
/// line is; cells in which a memory has nothing to do are left out.
///
/// # Errors
/// What writing gives.
pub fn write_csv(controller: &Controller, grid: &Grid, mut out: impl Write) -> io::Result<()> {
    let named = |name: &str, count: usize| (1..=count).map(|j| format!("{name}{j},")).collect::<String>();
    let n = controller.state_dimension();
    let (name, width, action) = match &controller.law {
        Law::Steering(_) => ("target", n, "a"),
        Law::Centered(law) => ("u", law.inputs, "u"),
    };
    let [lower, upper, center] = ["lower", "upper", "center"].map(|name| named(name, n));
    let has_memory = controller.task().letters().is_some();
    let first = if has_memory { "memory," } else { "" };
    let numbers = named(name, width);
    writeln!(out, "{first}from_step,to_step,cell,kind,{lower}{upper}{center}action,{numbers}bound")?;
    for memory in 0..controller.task().memories() {
        let first = if has_memory { format!("{memory},") } else { String::new() };
        for cell in (0..controller.num_cells()).map(CellId) {
            if has_memory && !controller.task().open(cell.index()).contains(&memory) {
                continue;
            }
            let (place, bound) = (geometry(grid, cell), shortest_decimal(controller.bound(cell)));
            let kind = match controller.kind(cell) {
                CellKind::Ordinary => "ordinary",
                CellKind::Goal => "goal",
                CellKind::Unsafe => "unsafe",
            };
            let described = format!("{},{kind},{place}", cell.0);
            let lines = lines(controller, memory, cell);
            if lines.is_empty() {
                writeln!(out, "{first},,{described},,{}{bound}", ",".repeat(width))?;
            }
            for (i, (steps, entry)) in lines.iter().enumerate() {
                let numbers: String =
                    controller.action(entry.action).iter().map(|&x| shortest_decimal(x) + ",").collect();
                let bound = if i == 0 { bound.as_str() } else { "" };
                writeln!(out, "{first}{steps},{described},{action}_{},{numbers}{bound}", entry.action)?;
            }
        }
    }
    Ok(())
}

/// The entries of a cell in the order of time, each with the first and the last step that it holds for.
fn lines(controller: &Controller, memory: Memory, cell: CellId) -> Vec<(String, Entry)> {
    let entries = controller.entries(memory, cell);
    let line = |(i, entry): (usize, &Entry)| {
        let later = entries.get(i + 1).map(|next| next.steps_left);
        let steps = controller.horizon().map_or_else(
            || ",".to_owned(),
            |horizon| {
                let from = later.map_or(0, |left| horizon + 1 - left);
                format!("{from},{}", horizon - entry.steps_left)
            },
        );
        (steps, *entry)
    };
    entries.iter().enumerate().map(line).rev().collect()
}

/// The sides and the center of a cell.
fn geometry(grid: &Grid, cell: CellId) -> String {
    let at = |place: &dyn Fn(&GridAxis, u32) -> Rational| {
        let axes = grid.axes().iter().enumerate();
        let numbers = axes.map(|(j, axis)| shortest_decimal(to_f64(&place(axis, grid.coordinate(cell, j)))));
        numbers.collect::<Vec<_>>().join(",")
    };
    [at(&|axis, i| axis.face(i)), at(&|axis, i| axis.face(i + 1)), at(&|axis, i| axis.center(i))].join(",")
}
