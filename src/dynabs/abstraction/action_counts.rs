//! The landings of all actions: one shared by translation, or one per target.

use super::cell_box::CellBox;
use super::cell_counts::{CellCounts, Count};
use super::placement::Placement;
use super::targets::{Alignment, Targets};
use super::windows::Windows;
use crate::noise::NoiseSamples;
use crate::partition::Grid;
use crate::problem::TargetId;
use rayon::prelude::*;
use std::borrow::Cow;
use std::collections::BTreeSet;

/// How noise becomes cells, for every action.
pub(super) enum TargetPlacements<'a> {
    /// All targets sit alike in their cells: coordinates count from the cell of the target.
    Shared { placement: Placement, alignment: &'a [Alignment], last_cells: Vec<u32> },
    /// Targets anywhere: coordinates are those of the grid.
    PerTarget { tolerance: Option<Vec<f64>> },
}

/// Where the samples of every action land.
pub(super) struct ActionCounts<'a> {
    samples: &'a NoiseSamples,
    placements: TargetPlacements<'a>,
    /// The cells that rows are to list, if more than those with samples.
    windows: Option<Windows>,
    /// Whether samples count for certain only inside of windows.
    inside_only: bool,
    /// The landing of all actions where coordinates count from the target.
    shared: Option<CellCounts>,
    /// The cells of the windows in these coordinates.
    shared_windows: Vec<CellBox>,
}

impl<'a> TargetPlacements<'a> {
    /// With `tolerance`, samples near a face may be on either side of it.
    pub(super) fn new(grid: &Grid, targets: &'a Targets, tolerance: Option<Vec<f64>>) -> Self {
        let Some((alignment, axes)) = targets.alignment().zip(targets.axes()) else {
            return Self::PerTarget { tolerance };
        };
        let last = |(a, axis): (&Alignment, &Vec<f64>)| a.first_cell + a.stride * (axis.len() as u32 - 1);
        let last_cells: Vec<u32> = alignment.iter().zip(axes).map(last).collect();
        let placement = Placement::of_offsets(grid, alignment, &last_cells, tolerance.as_deref());
        Self::Shared { placement, alignment, last_cells }
    }

    /// The placement of all actions, if there is one.
    pub(super) fn shared(&self) -> Option<&Placement> {
        match self {
            Self::Shared { placement, .. } => Some(placement),
            Self::PerTarget { .. } => None,
        }
    }

    /// Per dimension, the offsets from a target's cell at which some action has a cell of the grid; for targets
    /// anywhere, all those between two cells.
    pub(super) fn offset_ranges(&self, grid: &Grid) -> Vec<(i64, i64)> {
        let cells = grid.axes().iter().map(|axis| i64::from(axis.cells()));
        match self {
            Self::Shared { alignment, last_cells, .. } => (cells.zip(last_cells).zip(*alignment))
                .map(|((cells, &last), a)| (-i64::from(last), cells - 1 - i64::from(a.first_cell)))
                .collect(),
            // A target on the upper face of the grid is one cell beyond it.
            Self::PerTarget { .. } => cells.map(|cells| (-cells, cells)).collect(),
        }
    }
}

impl<'a> ActionCounts<'a> {
    /// The landings of `samples`, as they are.
    pub(super) fn new(samples: &'a NoiseSamples, placements: TargetPlacements<'a>) -> Self {
        let landings = Self {
            samples,
            placements,
            windows: None,
            inside_only: false,
            shared: None,
            shared_windows: vec![],
        };
        landings.share()
    }

    /// The landings of `samples` with tables of counts that include the cells of the windows; with `inside_only` nothing
    /// outside of a window counts for certain.
    pub(super) fn in_windows(
        samples: &'a NoiseSamples,
        placements: TargetPlacements<'a>,
        windows: Windows,
        inside_only: bool,
    ) -> Self {
        let landings = Self {
            samples,
            placements,
            windows: Some(windows),
            inside_only,
            shared: None,
            shared_windows: vec![],
        };
        landings.share()
    }

    /// Counts once for all actions, if they can be.
    fn share(mut self) -> Self {
        if let Some(placement) = self.placements.shared() {
            let windows = self.cells_of_windows(placement);
            self.shared = Some(self.landing(placement, windows.first()));
            self.shared_windows = windows;
        }
        self
    }

    fn landing(&self, placement: &Placement, cover: Option<&CellBox>) -> CellCounts {
        let depths = self.windows.as_ref().filter(|_| self.inside_only).map(Windows::depths);
        CellCounts::new(self.samples, placement, cover, depths)
    }

    fn cells_of_windows(&self, placement: &Placement) -> Vec<CellBox> {
        self.windows.as_ref().map_or(vec![], |windows| windows.cells(placement))
    }

    /// The landing of one action and the cells of its windows, the largest first.
    ///
    /// Writes the coordinates of the cell that they count from into `origin`.
    pub(super) fn of(
        &self,
        targets: &Targets,
        target: TargetId,
        grid: &Grid,
        origin: &mut [i32],
    ) -> (Cow<'_, CellCounts>, Cow<'_, [CellBox]>) {
        match (&self.placements, &self.shared) {
            (TargetPlacements::Shared { .. }, Some(landing)) => {
                targets.cell(target, origin);
                (Cow::Borrowed(landing), Cow::Borrowed(&self.shared_windows))
            }
            _ => {
                origin.fill(0);
                let placement = self.placement(targets, target, grid);
                let windows = self.cells_of_windows(&placement);
                let landing = self.landing(&placement, windows.first());
                (Cow::Owned(landing), Cow::Owned(windows))
            }
        }
    }

    /// Where the samples land for all actions, if coordinates count from their targets; `depths` says of every sample how many
    /// windows it is inside of.
    pub(super) fn with_depths(&self, depths: &[u8]) -> Option<CellCounts> {
        let placement = self.placements.shared()?;
        Some(CellCounts::new(self.samples, placement, self.shared_windows.first(), Some(depths)))
    }

    /// The landing of all actions, if coordinates count from their targets.
    pub(super) fn shared(&self) -> Option<&CellCounts> {
        self.shared.as_ref()
    }

    /// The cells of the windows of all actions, if coordinates count from their targets; the largest first.
    pub(super) fn shared_windows(&self) -> &[CellBox] {
        &self.shared_windows
    }

    /// The coordinates of an action's target in its landing: whatever the samples.
    pub(super) fn target_cell(&self, targets: &Targets, target: TargetId) -> Vec<i32> {
        let mut cell = vec![0; targets.dimension()];
        if let TargetPlacements::PerTarget { .. } = self.placements {
            targets.cell(target, &mut cell);
        }
        cell
    }

    fn placement(&self, targets: &Targets, target: TargetId, grid: &Grid) -> Cow<'_, Placement> {
        match &self.placements {
            TargetPlacements::Shared { placement, .. } => Cow::Borrowed(placement),
            TargetPlacements::PerTarget { tolerance } => {
                let mut point = vec![0.0; grid.dimension()];
                targets.point(target, &mut point);
                Cow::Owned(Placement::of_point(grid, &point, tolerance.as_deref()))
            }
        }
    }

    /// The counts that some cell has in some action's landing.
    pub(super) fn distinct_counts(&self, targets: &Targets, grid: &Grid) -> BTreeSet<Count> {
        if let Some(landing) = &self.shared {
            return landing.counts().iter().copied().collect();
        }
        let of_target = |place| {
            let target = TargetId::from_index(place);
            let (landing, _) = self.of(targets, target, grid, &mut vec![0; grid.dimension()]);
            landing.counts().iter().copied().collect::<BTreeSet<_>>()
        };
        (0..targets.len()).into_par_iter().map(of_target).reduce(BTreeSet::new, |mut all, one| {
            all.extend(one);
            all
        })
    }
}
