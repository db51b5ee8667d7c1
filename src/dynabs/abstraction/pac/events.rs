//! The events of cells, and their intervals.

use super::super::action_counts::ActionCounts;
use super::super::cell_box::CellBox;
use super::super::cell_counts::{CellCounts, Count};
use super::super::targets::Targets;
use super::bounds::{BoundTable, Interval};
use crate::problem::{Problem, TargetId};
use rayon::prelude::*;

/// The events of cells that occur: counts, and squared distances from the target's cell.
pub(super) fn cell_events(
    landings: &ActionCounts<'_>,
    targets: &Targets,
    problem: &Problem,
) -> impl Iterator<Item = (Count, u64)> {
    let grid = problem.grid();
    let events = |landing: &CellCounts, from: &[i32]| {
        let squares = squared_distances(landing.table(), from);
        landing.counts().iter().copied().zip(squares).collect::<Vec<_>>()
    };
    let all = match landings.shared() {
        Some(landing) => events(landing, &vec![0; grid.dimension()]),
        None => (0..targets.len())
            .into_par_iter()
            .flat_map_iter(|place| {
                let target = TargetId::from_index(place);
                let (landing, _) = landings.of(targets, target, grid, &mut vec![0; grid.dimension()]);
                let mut events = events(&landing, &landings.target_cell(targets, target));
                events.sort_unstable();
                events.dedup();
                events
            })
            .collect(),
    };
    all.into_iter()
}

/// The intervals of all cells of a landing's table.
pub(super) fn intervals(landing: &CellCounts, from: &[i32], cells: &BoundTable<u64>) -> Vec<Interval> {
    let squares = squared_distances(landing.table(), from);
    landing.counts().iter().zip(squares).map(|(&count, square)| cells.get(count, square)).collect()
}

/// The squared distances, in cells, of all cells of a table from one of them.
pub(super) fn squared_distances(table: &CellBox, from: &[i32]) -> Vec<u64> {
    let mut squares = Vec::with_capacity(table.volume());
    table.for_each(|cell| {
        let along = |(&a, &b): (&i32, &i32)| (i64::from(a) - i64::from(b)).pow(2) as u64;
        squares.push(cell.iter().zip(from).map(along).sum());
    });
    squares
}
