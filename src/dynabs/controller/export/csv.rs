//! The controller as a table.

use crate::controller::Controller;
use crate::partition::{CellId, CellKind, Grid};
use imdp::numeric::shortest_decimal;
use imdp::numeric::to_f64;
use std::io::{self, Write};

/// Writes one line per cell and range of steps with the same action.
///
/// Columns: `from_step`, `to_step` (grouped steps elapsed, inclusive; both empty where time does not matter),
/// `cell`, `kind` (`ordinary`, `goal`, `unsafe`), `lower…`, `upper…`, `center…` of the cell, `action` (empty
/// where there is none), `target…`, and `bound`, the guaranteed probability of success from the cell at the
/// start (on the line of step 0).
///
/// # Errors
/// What writing gives.
pub fn write_csv(controller: &Controller, grid: &Grid, mut out: impl Write) -> io::Result<()> {
    let n = controller.state_dimension();
    let named = |name: &str| (1..=n).map(|j| format!("{name}{j}")).collect::<Vec<_>>().join(",");
    let [lower, upper, center, target] = ["lower", "upper", "center", "target"].map(named);
    writeln!(out, "from_step,to_step,cell,kind,{lower},{upper},{center},action,{target},bound")?;
    let no_target = ",".repeat(n - 1);
    for cell in (0..controller.num_cells()).map(CellId) {
        let bounds = geometry(grid, cell);
        let bound = shortest_decimal(controller.bound(cell));
        let kind = match controller.kind(cell) {
            CellKind::Ordinary => "ordinary",
            CellKind::Goal => "goal",
            CellKind::Unsafe => "unsafe",
        };
        let entries = controller.entries(cell);
        if entries.is_empty() {
            writeln!(out, ",,{},{kind},{bounds},,{no_target},{bound}", cell.0)?;
        }
        for (i, entry) in entries.iter().enumerate().rev() {
            let target = join(controller.target_point(entry.target).iter().copied());
            let later = entries.get(i + 1).map(|next| next.steps_left);
            let (from, to) = match controller.horizon() {
                None => (String::new(), String::new()),
                Some(horizon) => {
                    let from = later.map_or(0, |left| horizon + 1 - left);
                    (from.to_string(), (horizon - entry.steps_left).to_string())
                }
            };
            let bound = if later.is_none() { bound.as_str() } else { "" };
            writeln!(out, "{from},{to},{},{kind},{bounds},a_{},{target},{bound}", cell.0, entry.target)?;
        }
    }
    Ok(())
}

pub(super) fn geometry(grid: &Grid, cell: CellId) -> String {
    let at = |place: &dyn Fn(&crate::partition::GridAxis, u32) -> imdp::numeric::Rational| {
        join(grid.axes().iter().enumerate().map(|(j, axis)| to_f64(&place(axis, grid.coordinate(cell, j)))))
    };
    [at(&|axis, i| axis.face(i)), at(&|axis, i| axis.face(i + 1)), at(&|axis, i| axis.center(i))].join(",")
}

pub(super) fn join(numbers: impl Iterator<Item = f64>) -> String {
    numbers.map(shortest_decimal).collect::<Vec<_>>().join(",")
}
