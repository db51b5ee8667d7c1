//! Where samples land: how often each cell, counted from the target's cell, is hit.

use super::targets::Alignment;
use crate::noise::NoiseSamples;
use crate::numeric::{UNIT_ROUNDOFF, to_f64};
use crate::partition::{CellId, CellKind, CellLabels, Grid};
use std::collections::BTreeMap;

/// The cells in which one sample may lie: a box of cell coordinates, one cell unless it is near a face.
///
/// Coordinates count from an origin cell: the target's, or the first cell of the grid.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Spread {
    /// The least coordinates.
    pub lower: Vec<i32>,
    /// The greatest coordinates.
    pub upper: Vec<i32>,
}

/// How many samples lie for certain, and how many possibly, in a set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Count {
    /// Samples that are in the set whatever the rounding.
    pub certain: u32,
    /// Samples that may be in the set.
    pub possible: u32,
}

/// The samples of `d + η` by the cells in which they land, relative to an origin cell.
#[derive(Clone, Debug)]
pub struct Landing {
    /// Distinct spreads with their numbers of samples, ascending.
    groups: Vec<(Spread, u32)>,
    /// The bounding box of all spreads.
    window: Spread,
    /// The counts of every cell of the window, row-major.
    counts: Vec<Count>,
}

/// The counts of the task's regions for one action.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RegionCounts {
    /// In goal cells.
    pub goal: Count,
    /// In unsafe cells or outside the partition.
    pub lost: Count,
}

impl Landing {
    /// Where `d_a + δ` lands relative to the cell of `d_a`, for targets that all sit alike in their cells.
    ///
    /// With `φ` the target's position in its cell and `w` the width, `δ` moves `⌊δ/w + φ⌋` cells. `tolerance`
    /// bounds, per dimension, how far the true `d_a + η` can be from its computed value; samples closer to
    /// a face than that (plus the rounding made here) may be on either side. Coordinates beyond the grid
    /// from every target are cut off just outside it.
    pub fn of_offsets(
        samples: &NoiseSamples,
        grid: &Grid,
        alignment: &[Alignment],
        last_cells: &[u32],
        tolerance: Option<&[f64]>,
    ) -> Self {
        let axes: Vec<_> = (0..grid.dimension())
            .map(|j| AxisSpread {
                width: to_f64(grid.axes()[j].width()),
                shift: to_f64(&alignment[j].phase),
                lowest: -(last_cells[j] as i32) - 1,
                highest: grid.axes()[j].cells() as i32 - alignment[j].first_cell as i32,
                tolerance: tolerance.map(|t| t[j] + samples.rounding()[j]),
            })
            .collect();
        Self::collect(samples, &axes)
    }

    /// Where `d + δ` lands in the grid, for one target point anywhere; coordinates are those of cells.
    pub fn of_point(samples: &NoiseSamples, grid: &Grid, point: &[f64], tolerance: Option<&[f64]>) -> Self {
        let axes: Vec<_> = (0..grid.dimension())
            .map(|j| {
                let width = to_f64(grid.axes()[j].width());
                let lower = to_f64(grid.axes()[j].lower());
                let offset = 2.0 * UNIT_ROUNDOFF * (point[j].abs() + lower.abs());
                AxisSpread {
                    width,
                    shift: (point[j] - lower) / width,
                    lowest: -1,
                    highest: grid.axes()[j].cells() as i32,
                    tolerance: tolerance.map(|t| t[j] + samples.rounding()[j] + offset),
                }
            })
            .collect();
        Self::collect(samples, &axes)
    }

    fn collect(samples: &NoiseSamples, axes: &[AxisSpread]) -> Self {
        let mut groups: BTreeMap<Spread, u32> = BTreeMap::new();
        for sample in samples.iter() {
            let (lower, upper) = sample.iter().zip(axes).map(|(&x, axis)| axis.spread(x)).unzip();
            *groups.entry(Spread { lower, upper }).or_default() += 1;
        }
        Self::from_groups(groups.into_iter().collect())
    }

    fn from_groups(groups: Vec<(Spread, u32)>) -> Self {
        let mut window = groups.first().map_or(Spread { lower: vec![], upper: vec![] }, |(s, _)| s.clone());
        for (spread, _) in &groups {
            for j in 0..spread.lower.len() {
                window.lower[j] = window.lower[j].min(spread.lower[j]);
                window.upper[j] = window.upper[j].max(spread.upper[j]);
            }
        }
        let mut counts = vec![Count::default(); window.volume()];
        for (spread, number) in &groups {
            let certain = if spread.is_single() { *number } else { 0 };
            spread.for_each(|cell| {
                let count = &mut counts[window.position(cell)];
                count.certain += certain;
                count.possible += number;
            });
        }
        Self { groups, window, counts }
    }

    /// The bounding box of the samples, in cells.
    pub fn window(&self) -> &Spread {
        &self.window
    }

    /// The counts of the cells of the window, row-major.
    pub fn counts(&self) -> &[Count] {
        &self.counts
    }

    /// Distinct spreads with their numbers of samples, ascending.
    pub fn groups(&self) -> &[(Spread, u32)] {
        &self.groups
    }

    /// How many samples land in goal cells, and how many in unsafe cells or outside, with origin `origin`.
    pub fn region_counts(&self, origin: &[i32], grid: &Grid, labels: &CellLabels) -> RegionCounts {
        let mut counts = RegionCounts::default();
        for (spread, number) in &self.groups {
            let (mut goal, mut lost, mut cells) = (0usize, 0usize, 0usize);
            spread.for_each(|cell| {
                cells += 1;
                match locate(cell, origin, grid).map(|cell| labels.kind(cell)) {
                    Some(CellKind::Goal) => goal += 1,
                    Some(CellKind::Ordinary) => {}
                    Some(CellKind::Unsafe) | None => lost += 1,
                }
            });
            let add = |count: &mut Count, hits: usize| {
                count.certain += if hits == cells { *number } else { 0 };
                count.possible += if hits > 0 { *number } else { 0 };
            };
            add(&mut counts.goal, goal);
            add(&mut counts.lost, lost);
        }
        counts
    }
}

/// The cell at `coordinates` from `origin`, if it is in the grid.
pub(super) fn locate(coordinates: &[i32], origin: &[i32], grid: &Grid) -> Option<CellId> {
    let mut id = 0;
    for (j, axis) in grid.axes().iter().enumerate() {
        let index = u32::try_from(coordinates[j] + origin[j]).ok().filter(|&i| i < axis.cells())?;
        id += index * grid.strides()[j];
    }
    Some(CellId(id))
}

/// How values along one dimension become cell coordinates.
struct AxisSpread {
    width: f64,
    /// The target's position, in cells.
    shift: f64,
    lowest: i32,
    highest: i32,
    /// `None` takes the arithmetic at its word.
    tolerance: Option<f64>,
}

impl AxisSpread {
    fn spread(&self, x: f64) -> (i32, i32) {
        let position = x / self.width + self.shift;
        let slack = self.tolerance.map_or(0.0, |tolerance| {
            let rounding = 8.0 * UNIT_ROUNDOFF * ((x / self.width).abs() + self.shift.abs() + 1.0);
            2.0 * tolerance / self.width + rounding
        });
        // Casting saturates, so samples beyond any grid stay beyond it.
        let index = |position: f64| (position.floor() as i32).clamp(self.lowest, self.highest);
        (index(position - slack), index(position + slack))
    }
}

impl Spread {
    /// The number of cells.
    pub fn volume(&self) -> usize {
        self.lower.iter().zip(&self.upper).map(|(l, u)| (u - l) as usize + 1).product()
    }

    fn is_single(&self) -> bool {
        self.lower == self.upper
    }

    /// The row-major position of a cell in this box.
    fn position(&self, cell: &[i32]) -> usize {
        (0..cell.len()).fold(0, |position, j| {
            position * ((self.upper[j] - self.lower[j]) as usize + 1) + (cell[j] - self.lower[j]) as usize
        })
    }

    /// Visits the cells in row-major order.
    fn for_each(&self, mut visit: impl FnMut(&[i32])) {
        if self.is_single() {
            return visit(&self.lower);
        }
        let mut cell = self.lower.clone();
        loop {
            visit(&cell);
            let Some(j) = (0..cell.len()).rev().find(|&j| cell[j] < self.upper[j]) else { return };
            cell[j] += 1;
            cell[j + 1..].copy_from_slice(&self.lower[j + 1..]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::{Rational, from_decimal};

    fn line(cells: u32) -> (Grid, Vec<Alignment>) {
        let exact = |x: f64| vec![from_decimal(x).unwrap()];
        let grid = Grid::new(&exact(0.0), &exact(f64::from(cells)), &[cells]).unwrap();
        (grid, vec![Alignment { first_cell: 0, stride: 1, phase: Rational::new(1.into(), 2.into()) }])
    }

    #[test]
    fn offsets_count_from_the_target() {
        let (grid, alignment) = line(10);
        let samples = NoiseSamples::new(1, vec![0.0, 0.4, -0.4, 0.6, -1.4, 99.0]);
        let landing = Landing::of_offsets(&samples, &grid, &alignment, &[9], Some(&[1e-12]));
        assert_eq!(landing.window(), &Spread { lower: vec![-1], upper: vec![10] });
        assert_eq!(landing.counts()[0].certain, 1);
        assert_eq!(landing.counts()[1].certain, 3);
        assert_eq!(landing.counts()[2].certain, 1);
    }

    #[test]
    fn samples_near_a_face_count_on_both_sides() {
        let (grid, alignment) = line(10);
        let samples = NoiseSamples::new(1, vec![0.5, 0.5 + 1e-15, 0.1]);
        let landing = Landing::of_offsets(&samples, &grid, &alignment, &[9], Some(&[1e-14]));
        assert_eq!(landing.counts()[0], Count { certain: 1, possible: 3 });
        assert_eq!(landing.counts()[1], Count { certain: 0, possible: 2 });
        // Taken at its word, the face belongs to the upper cell.
        let landing = Landing::of_offsets(&samples, &grid, &alignment, &[9], None);
        assert_eq!(landing.counts()[1], Count { certain: 2, possible: 2 });
    }

    #[test]
    fn points_and_offsets_agree() {
        let (grid, alignment) = line(10);
        let samples = NoiseSamples::new(1, vec![0.0, 0.4, -0.4, 0.6, -1.4, 3.3]);
        let by_offset = Landing::of_offsets(&samples, &grid, &alignment, &[9], Some(&[0.0]));
        let by_point = Landing::of_point(&samples, &grid, &[4.5], Some(&[0.0]));
        assert_eq!(by_offset.counts(), by_point.counts());
        assert_eq!(by_point.window().lower[0], by_offset.window().lower[0] + 4);
    }
}
