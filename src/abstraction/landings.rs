//! The landings of all actions: one shared by translation, or one per target.

use super::landing::{Count, Landing, Spread};
use super::targets::{Alignment, Targets};
use crate::noise::NoiseSamples;
use crate::partition::{CellId, Grid};
use num_bigint::BigInt;
use rayon::prelude::*;
use std::borrow::Cow;
use std::collections::BTreeSet;

/// Where the samples of every action land.
pub(super) enum Landings<'a> {
    /// All targets sit alike in their cells: the rows are translations of each other.
    Shared { landing: Landing, alignment: &'a [Alignment], last_cells: Vec<u32> },
    /// Targets anywhere: every action has its own counts.
    PerTarget { samples: &'a NoiseSamples, tolerance: Option<Vec<f64>> },
}

impl<'a> Landings<'a> {
    pub(super) fn new(
        samples: &'a NoiseSamples,
        grid: &Grid,
        targets: &'a Targets,
        tolerance: Option<Vec<f64>>,
    ) -> Self {
        let Some((alignment, axes)) = targets.alignment().zip(targets.axes()) else {
            return Self::PerTarget { samples, tolerance };
        };
        let last = |(a, axis): (&Alignment, &Vec<f64>)| a.first_cell + a.stride * (axis.len() as u32 - 1);
        let last_cells: Vec<u32> = alignment.iter().zip(axes).map(last).collect();
        let landing = Landing::of_offsets(samples, grid, alignment, &last_cells, tolerance.as_deref());
        Self::Shared { landing, alignment, last_cells }
    }

    /// The landing of one action; writes the coordinates of the cell that it counts from into `origin`.
    pub(super) fn of(
        &self,
        targets: &Targets,
        target: usize,
        grid: &Grid,
        origin: &mut [i32],
    ) -> Cow<'_, Landing> {
        match self {
            Self::Shared { landing, alignment, .. } => {
                targets.cell_coordinates(target, alignment, origin);
                Cow::Borrowed(landing)
            }
            Self::PerTarget { samples, tolerance } => {
                let mut point = vec![0.0; grid.dimension()];
                targets.point(target, &mut point);
                origin.fill(0);
                Cow::Owned(Landing::of_point(samples, grid, &point, tolerance.as_deref()))
            }
        }
    }

    /// The number of events "an action's noise lands in a cell" that differ: `Π (2n_j − 1)` offsets for
    /// centres, every pair of action and cell in general.
    pub(super) fn cell_events(&self, grid: &Grid, targets: &Targets) -> BigInt {
        match self {
            Self::Shared { alignment, last_cells, .. } => (grid.axes().iter().enumerate())
                .map(|(j, axis)| BigInt::from(axis.cells() + last_cells[j] - alignment[j].first_cell))
                .product(),
            Self::PerTarget { .. } => BigInt::from(targets.len()) * BigInt::from(grid.num_cells()),
        }
    }

    /// The counts that some cell has in some action's landing.
    pub(super) fn distinct_counts(&self, targets: &Targets, grid: &Grid) -> BTreeSet<Count> {
        if let Self::Shared { landing, .. } = self {
            return landing.counts().iter().copied().collect();
        }
        let of_target = |target| {
            let landing = self.of(targets, target, grid, &mut vec![0; grid.dimension()]);
            landing.counts().iter().copied().collect::<BTreeSet<_>>()
        };
        (0..targets.len()).into_par_iter().map(of_target).reduce(BTreeSet::new, |mut all, one| {
            all.extend(one);
            all
        })
    }

    /// What is shared between all actions in memory, in cells of a window.
    pub(super) fn window_volume(&self, grid: &Grid) -> usize {
        match self {
            Self::Shared { landing, .. } => landing.window().volume().min(grid.num_cells() as usize),
            Self::PerTarget { .. } => grid.num_cells() as usize,
        }
    }
}

/// Visits the cells of the window at `origin` that lie in the grid, in ascending order.
pub(super) fn for_each_cell(
    landing: &Landing,
    origin: &[i32],
    grid: &Grid,
    mut visit: impl FnMut(CellId, Count),
) {
    let Some(clipped) = clip(landing.window(), origin, grid) else { return };
    let window = landing.window();
    let n = origin.len();
    let mut line = clipped.lower.clone();
    loop {
        let (mut cell, mut position) = (0u32, 0usize);
        for j in 0..n {
            cell += line[j] as u32 * grid.strides()[j];
            let extent = (window.upper[j] - window.lower[j]) as usize + 1;
            position = position * extent + (line[j] - origin[j] - window.lower[j]) as usize;
        }
        for i in 0..=(clipped.upper[n - 1] - clipped.lower[n - 1]) as usize {
            visit(CellId(cell + i as u32), landing.counts()[position + i]);
        }
        let Some(j) = (0..n - 1).rev().find(|&j| line[j] < clipped.upper[j]) else { return };
        line[j] += 1;
        line[j + 1..].copy_from_slice(&clipped.lower[j + 1..]);
    }
}

/// The part of the window at `origin` that lies in the grid, in cell coordinates; `None` if there is none.
fn clip(window: &Spread, origin: &[i32], grid: &Grid) -> Option<Spread> {
    let mut clipped = window.clone();
    for (j, axis) in grid.axes().iter().enumerate() {
        clipped.lower[j] = (window.lower[j] + origin[j]).max(0);
        clipped.upper[j] = (window.upper[j] + origin[j]).min(axis.cells() as i32 - 1);
        if clipped.lower[j] > clipped.upper[j] {
            return None;
        }
    }
    Some(clipped)
}

/// Whether the window at `origin` lies in the grid altogether.
pub(super) fn is_inside(window: &Spread, origin: &[i32], grid: &Grid) -> bool {
    (grid.axes().iter().enumerate()).all(|(j, axis)| {
        window.lower[j] + origin[j] >= 0 && window.upper[j] + origin[j] < axis.cells() as i32
    })
}
