//! The rows of the published reference tool: for comparison only, not a guarantee.
//!
//! Only cells hit by at least one sample are listed, goal and unsafe cells one by one, and state 0 stands
//! for everything outside; every interval is that of [`ReferenceIntervals`]. Why this proves nothing: there
//! is no union over the intervals, cells without samples get upper bound 0, upper bounds are rounded
//! down, and zero lower bounds are raised to 10⁻⁴.

use super::action_counts::{ActionCounts, TargetPlacements};
use super::cell_counts::CellCounts;
use super::count_table::CountTable;
use super::footprint::need_of_rows;
use super::row_tasks::build_rows;
use super::states::StateSpace;
use super::stencil::{Chosen, Ground, Runs, Special, Stencil, StencilRows};
use super::targets::Targets;
use crate::memory::TooLarge;
use crate::problem::{Problem, SampledNoise, TargetId};
use crate::statistics::ReferenceIntervals;
use imdp::model::{RowBuffer, RowId, RowSet};
use imdp::progress::Progress;
use rayon::prelude::*;
use std::borrow::Cow;
use std::sync::Arc;

/// One row per target.
pub(super) fn build(
    (problem, noise): (&Problem, &SampledNoise),
    beta_per_interval: f64,
    targets: &Targets,
    placements: TargetPlacements<'_>,
    states: &StateSpace,
    progress: &dyn Progress,
) -> Result<RowSet, TooLarge> {
    let grid = problem.grid();
    let landings = ActionCounts::new(&noise.samples, placements);
    if landings.shared().is_none() {
        need_of_rows(problem, targets.len() as u64 * u64::from(grid.num_cells())).check()?;
    }
    let ground =
        Ground::new(grid, landings.shared().map(|_| targets), states.heads(), |cell| states.at_start(cell));
    let hits = landings.shared().map(|landing| Hits::new(Cow::Borrowed(landing), &ground));
    let of_target = |target| {
        let (landing, _) = landings.of(targets, target, grid, &mut vec![0; grid.dimension()]);
        Hits::new(landing, &ground)
    };
    let inside = |origin: &mut Vec<i32>, place| {
        let target = TargetId::from_index(place);
        ground.origin(target, origin);
        match &hits {
            Some(hits) => hits.inside(&ground, origin),
            None => of_target(target).inside(&ground, origin),
        }
    };
    let inside: Vec<(u32, u32)> = (0..targets.len()).into_par_iter().map_init(Vec::new, inside).collect();

    let intervals = ReferenceIntervals::new(noise.samples.len() as u64, beta_per_interval);
    let of_cells = landings.distinct_counts(targets, grid);
    let of_cells = CountTable::new(of_cells.iter().map(|count| count.certain[0]), |k| intervals.of_cell(k));
    let of_outside = CountTable::new(inside.iter().map(|(samples, _)| *samples), |k| intervals.of_outside(k));
    let special =
        |target: TargetId| Special { first: of_outside.get(inside[target.index()].0), reached: None };
    let Some(hits) = hits else {
        return Ok(build_rows(targets.len(), progress, |row, rows| {
            let (_, target) = targets.of_row(RowId::from_index(row));
            let RowBuffer { mut entries, mut coordinates } = RowBuffer::default();
            ground.origin(target, &mut coordinates);
            let stencil = of_target(target).stencil(&ground, special(target).first, &of_cells);
            let of_row = (special(target), 1 + inside[target.index()].1 as usize);
            rows.push_row(stencil.row(&ground, &coordinates, of_row, &mut entries));
        })
        .into());
    };
    // Where the whole stencil is in the grid.
    let most = inside.iter().map(|(samples, _)| *samples).max().unwrap_or_default();
    let stencil: Arc<[Stencil]> = Arc::new([hits.stencil(&ground, of_outside.get(most), &of_cells)]);
    let choose = |(): &mut (), row: RowId| {
        let (_, target) = targets.of_row(row);
        progress.advance(1);
        Chosen { stencil: 0, special: special(target), length: 1 + inside[target.index()].1 }
    };
    Ok(StencilRows::new(Arc::new([ground]), stencil, targets.len(), || (), choose).into())
}

/// The cells that samples land in.
struct Hits<'a> {
    landing: Cow<'a, CellCounts>,
    runs: Runs,
    /// How many samples land in the cells before each position in the runs, and in all.
    before: Vec<u32>,
}

impl<'a> Hits<'a> {
    fn new(landing: Cow<'a, CellCounts>, ground: &Ground) -> Self {
        let number = |position: usize| landing.counts()[position].certain[0];
        let runs = Runs::new(landing.table(), ground, |position| number(position) > 0);
        let mut before = vec![0];
        let hit = (0..landing.counts().len()).map(number).filter(|&number| number > 0);
        before.extend(hit.scan(0, |sum, number| {
            *sum += number;
            Some(*sum)
        }));
        Self { landing, runs, before }
    }

    /// How many samples land in the grid, and in how many cells, with origin `origin`.
    fn inside(&self, ground: &Ground, origin: &[i32]) -> (u32, u32) {
        let (mut samples, mut cells) = (0, 0);
        self.runs.for_each(ground, origin, |_, position, length| {
            samples += self.before[position + length] - self.before[position];
            cells += length as u32;
        });
        (samples, cells)
    }

    /// The intervals of the cells; `usual` is that of the outside in most rows.
    fn stencil(&self, ground: &Ground, usual: (f64, f64), of_cells: &CountTable<(f64, f64)>) -> Stencil {
        let interval = |position: usize| {
            let number = self.landing.counts()[position].certain[0];
            (number > 0).then(|| of_cells.get(number))
        };
        Stencil::new(self.landing.table(), ground, usual, interval)
    }
}
