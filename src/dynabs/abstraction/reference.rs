//! The rows of the published reference tool: for comparison only, not a guarantee.
//!
//! Only cells hit by at least one sample are listed, goal and unsafe cells one by one, and state 0 stands
//! for everything outside; every interval is that of [`ReferenceIntervals`]. Why this proves nothing: there
//! is no union over the intervals, cells without samples get upper bound 0, upper bounds are rounded
//! down, and zero lower bounds are raised to 10⁻⁴.

use super::action_counts::{ActionCounts, TargetPlacements, for_each_cell};
use super::count_table::CountTable;
use super::footprint::need_of_rows;
use super::states::{OUTSIDE, StateSpace};
use super::targets::Targets;
use crate::memory::TooLarge;
use crate::partition::Grid;
use crate::problem::Problem;
use crate::statistics::ReferenceIntervals;
use imdp::model::Rows;
use imdp::progress::Progress;
use rayon::prelude::*;

/// One row per target.
pub(super) fn build(
    problem: &Problem,
    beta_per_interval: f64,
    targets: &Targets,
    placements: TargetPlacements<'_>,
    states: &StateSpace,
    progress: &dyn Progress,
) -> Result<Rows, TooLarge> {
    let grid: &Grid = problem.grid();
    let landings = ActionCounts::new(&problem.noise().samples, placements);
    need_of_rows(problem, landings.most_entries(targets, grid)).check()?;
    let intervals = ReferenceIntervals::new(problem.noise().samples.len() as u64, beta_per_interval);
    let inside: Vec<u32> = (0..targets.len())
        .into_par_iter()
        .map_init(
            || vec![0; grid.dimension()],
            |origin, target| {
                let (landing, _) = landings.of(targets, target, grid, origin);
                let mut inside = 0;
                let table = landing.table();
                for_each_cell(table, table, origin, grid, |_, i| inside += landing.counts()[i].certain[0]);
                inside
            },
        )
        .collect();
    let of_cells = landings.distinct_counts(targets, grid);
    let of_cells = CountTable::new(of_cells.iter().map(|count| count.certain[0]), |k| intervals.of_cell(k));
    let of_outside = CountTable::new(inside.iter().copied(), |k| intervals.of_outside(k));
    Ok(super::row_tasks::build_rows(targets.len(), progress, |target, rows| {
        let mut origin = vec![0; grid.dimension()];
        let (landing, _) = landings.of(targets, target, grid, &mut origin);
        let (lower, upper) = of_outside.get(inside[target]);
        rows.push_entry(OUTSIDE, lower, upper);
        let table = landing.table();
        for_each_cell(table, table, &origin, grid, |cell, i| {
            let hits = landing.counts()[i].certain[0];
            if hits > 0 {
                let (lower, upper) = of_cells.get(hits);
                rows.push_entry(states.of_cell(cell), lower, upper);
            }
        });
        rows.finish_row();
    }))
}
