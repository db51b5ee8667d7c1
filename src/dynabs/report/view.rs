//! What a plot shows: two axes, a slice of the other dimensions, a step.

use super::numbers::short;
use super::scene::Scene;
use super::sides::sides;
use crate::partition::{CellId, Region};

/// The most squares along one side of a heat map.
const MOST_SQUARES: u32 = 256;

/// An axis of a plot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Axis {
    /// Grouped steps.
    Time,
    /// A dimension of the state, counted from 0.
    State(usize),
}

/// A plane through the state space, or through one dimension and time.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct View {
    pub(super) across: Axis,
    pub(super) up: usize,
    /// The coordinates of a cell that the plane goes through.
    pub(super) slice: Vec<u32>,
    /// The number of grouped steps elapsed, unless time is an axis.
    pub(super) step: usize,
}

impl View {
    /// Whether both axes have the same scale: they have the same unit, or none and square cells, and no side is much longer.
    pub(super) fn is_equal(&self, scene: &Scene<'_>) -> bool {
        let Axis::State(across) = self.across else { return false };
        let length = |j: usize| scene.range(j).1 - scene.range(j).0;
        let width = |j: usize| length(j) / (scene.faces()[j].len() - 1) as f64;
        let alike = match (&scene.units[across], &scene.units[self.up]) {
            (None, None) => (width(across) / width(self.up) - 1.0).abs() < 1e-9,
            (one, other) => one == other,
        };
        alike && (0.25..=4.0).contains(&(length(across) / length(self.up)))
    }

    /// Whether a state lies in the slice: in the cells that the plane goes through.
    pub(super) fn is_in_slice(&self, scene: &Scene<'_>, state: &[f64]) -> bool {
        self.fixed().all(|j| {
            let (faces, i) = (&scene.faces()[j], self.slice[j] as usize);
            faces[i] <= state[j] && state[j] < faces[i + 1]
        })
    }

    /// The cell at column `i` and row `j`, and the step that it is looked at.
    pub(super) fn cell(&self, scene: &Scene<'_>, i: u32, j: u32) -> (CellId, usize) {
        let mut coordinates = self.slice.clone();
        coordinates[self.up] = j;
        let step = match self.across {
            Axis::Time => i as usize,
            Axis::State(dimension) => {
                coordinates[dimension] = i;
                self.step
            }
        };
        (scene.grid.cell(&coordinates), step)
    }

    /// The numbers of columns and rows.
    pub(super) fn size(&self, scene: &Scene<'_>) -> (u32, u32) {
        let cells = |j: usize| scene.grid.axes()[j].cells();
        let columns = match self.across {
            Axis::Time => scene.last_step() as u32 + 1,
            Axis::State(j) => cells(j),
        };
        (columns, cells(self.up))
    }

    /// How many columns and rows one square of a heat map stands for.
    pub(super) fn blocks(&self, scene: &Scene<'_>) -> (u32, u32) {
        let (columns, rows) = self.size(scene);
        (columns.div_ceil(MOST_SQUARES), rows.div_ceil(MOST_SQUARES))
    }

    /// What is across, from where to where.
    pub(super) fn range_across(&self, scene: &Scene<'_>) -> (f64, f64) {
        match self.across {
            Axis::Time => (-0.5, scene.last_step() as f64 + 0.5),
            Axis::State(j) => scene.range(j),
        }
    }

    /// The face before column `i`.
    pub(super) fn face_across(&self, scene: &Scene<'_>, i: u32) -> f64 {
        match self.across {
            Axis::Time => f64::from(i) - 0.5,
            Axis::State(j) => scene.faces()[j][i as usize],
        }
    }

    /// The names of the axes.
    pub(super) fn names(&self, scene: &Scene<'_>) -> (String, String) {
        let across = match self.across {
            Axis::Time => scene.time_name(),
            Axis::State(j) => scene.title(j),
        };
        (across, scene.title(self.up))
    }

    /// ` at x₃ = 1, …`: where the center of the cell lies in some dimensions; nothing for none.
    pub(super) fn at(&self, scene: &Scene<'_>, dimensions: impl Iterator<Item = usize>) -> String {
        let center = |j: usize| format!("{} = {}", scene.names[j], short(scene.center(j, self.slice[j])));
        let centers: Vec<_> = dimensions.map(center).collect();
        if centers.is_empty() { String::new() } else { format!(" at {}", centers.join(", ")) }
    }

    /// Whether a region meets the cell in one dimension.
    pub(super) fn meets(&self, scene: &Scene<'_>, region: &Region, dimension: usize) -> bool {
        let (lower, upper) = sides(region, dimension);
        let (faces, i) = (&scene.faces()[dimension], self.slice[dimension] as usize);
        lower < faces[i + 1] && faces[i] < upper
    }

    /// The dimensions that are fixed.
    pub(super) fn fixed(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.slice.len()).filter(|&j| j != self.up && self.across != Axis::State(j))
    }
}
