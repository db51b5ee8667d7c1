//! Where samples land: how often each cell, counted from the target's cell, is hit.

use super::cell_box::CellBox;
use super::placement::Placement;
use super::windows::WINDOWS;
use crate::noise::NoiseSamples;
use std::collections::BTreeMap;

/// How many samples lie for certain, and how many possibly, in a set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Count {
    /// Per window, the samples inside it that are in the set whatever the rounding; without windows, all such samples.
    pub certain: [u32; WINDOWS],
    /// Samples that may be in the set.
    pub possible: u32,
}

/// The samples of `d + η` by the cells in which they land, relative to an origin cell.
#[derive(Clone, Debug)]
pub struct CellCounts {
    /// Distinct spreads with their samples, ascending: those inside of each window, and all.
    groups: Vec<(CellBox, Count)>,
    /// The cells that `counts` is about: all that some sample may lie in, and more if asked for.
    table: CellBox,
    /// The counts of every cell of the table, row-major.
    counts: Vec<Count>,
}

/// The counts of the task's regions for one action.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RegionCounts {
    /// In goal cells.
    pub goal: Count,
    /// In lost cells or outside the partition.
    pub lost: Count,
}

impl CellCounts {
    /// Where the samples land; the table of counts includes the cells of `cover`.
    ///
    /// `depths` says of every sample how many of the windows it is inside of, the first ones; without, it is in all.
    pub fn new(
        samples: &NoiseSamples,
        placement: &Placement,
        cover: Option<&CellBox>,
        depths: Option<&[u8]>,
    ) -> Self {
        let mut groups: BTreeMap<CellBox, Count> = BTreeMap::new();
        for (i, sample) in samples.measured().enumerate() {
            let count = groups.entry(placement.spread(sample)).or_default();
            let depth = depths.map_or(WINDOWS, |depths| usize::from(depths[i]));
            count.certain[..depth].iter_mut().for_each(|certain| *certain += 1);
            count.possible += 1;
        }
        let groups: Vec<_> = groups.into_iter().collect();
        let first = cover.or(groups.first().map(|(spread, _)| spread));
        let mut table = first.cloned().unwrap_or(CellBox { lower: vec![], upper: vec![] });
        groups.iter().for_each(|(spread, _)| table.include(spread));
        let mut counts = vec![Count::default(); table.volume()];
        for (spread, number) in &groups {
            let is_certain = spread.is_single();
            spread.for_each(|cell| counts[table.position(cell)].add(number, is_certain, true));
        }
        Self { groups, table, counts }
    }

    /// Distinct cells, or boxes of cells, with the samples that land there.
    pub(super) fn groups(&self) -> &[(CellBox, Count)] {
        &self.groups
    }

    /// The cells that have counts: a box with all samples.
    pub fn table(&self) -> &CellBox {
        &self.table
    }

    /// The counts of the cells of the table, row-major.
    pub fn counts(&self) -> &[Count] {
        &self.counts
    }
}

impl Count {
    /// Adds samples that are in the set for certain, or possibly, or not.
    pub(super) fn add(&mut self, samples: &Self, is_certain: bool, is_possible: bool) {
        if is_certain {
            self.certain.iter_mut().zip(samples.certain).for_each(|(own, more)| *own += more);
        }
        if is_possible {
            self.possible += samples.possible;
        }
    }

    /// Takes out samples that had been added as certain.
    pub(super) fn subtract(&mut self, samples: &Self) {
        self.certain.iter_mut().zip(samples.certain).for_each(|(own, less)| *own -= less);
        self.possible -= samples.possible;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::abstraction::Alignment;
    use crate::partition::Grid;
    use imdp::numeric::{Rational, from_decimal};

    fn line(cells: u32) -> (Grid, Vec<Alignment>) {
        let exact = |x: f64| vec![from_decimal(x).unwrap()];
        let grid = Grid::new(&exact(0.0), &exact(f64::from(cells)), &[cells]).unwrap();
        (grid, vec![Alignment { first_cell: 0, stride: 1, phase: Rational::new(1.into(), 2.into()) }])
    }

    fn offsets(
        samples: &NoiseSamples,
        grid: &Grid,
        alignment: &[Alignment],
        tolerance: Option<f64>,
    ) -> CellCounts {
        let tolerance = tolerance.map(|t| [t]);
        let tolerance = tolerance.as_ref().map(|t| t.as_slice());
        CellCounts::new(samples, &Placement::of_offsets(grid, alignment, &[9], tolerance), None, None)
    }

    #[test]
    fn offsets_count_from_the_target() {
        let (grid, alignment) = line(10);
        let samples = NoiseSamples::new(1, vec![0.0, 0.4, -0.4, 0.6, -1.4, 99.0]);
        let landing = offsets(&samples, &grid, &alignment, Some(1e-12));
        assert_eq!(landing.table(), &CellBox { lower: vec![-1], upper: vec![10] });
        let certain = |i: usize| landing.counts()[i].certain;
        assert_eq!([certain(0), certain(1), certain(2)], [[1; WINDOWS], [3; WINDOWS], [1; WINDOWS]]);
    }

    #[test]
    fn samples_near_a_face_count_on_both_sides() {
        let (grid, alignment) = line(10);
        let samples = NoiseSamples::new(1, vec![0.5, 0.5 + 1e-15, 0.1]);
        let landing = offsets(&samples, &grid, &alignment, Some(1e-14));
        assert_eq!(landing.counts()[0], Count { certain: [1; WINDOWS], possible: 3 });
        assert_eq!(landing.counts()[1], Count { certain: [0; WINDOWS], possible: 2 });
        // Taken at its word, the face belongs to the upper cell.
        let landing = offsets(&samples, &grid, &alignment, None);
        assert_eq!(landing.counts()[1], Count { certain: [2; WINDOWS], possible: 2 });
    }

    #[test]
    fn points_and_offsets_agree() {
        let (grid, alignment) = line(10);
        let samples = NoiseSamples::new(1, vec![0.0, 0.4, -0.4, 0.6, -1.4, 3.3]);
        let by_offset = offsets(&samples, &grid, &alignment, Some(0.0));
        let placement = Placement::of_point(&grid, &[4.5], Some(&[0.0]));
        let by_point = CellCounts::new(&samples, &placement, None, None);
        assert_eq!(by_offset.counts(), by_point.counts());
        assert_eq!(by_point.table().lower[0], by_offset.table().lower[0] + 4);
    }

    #[test]
    fn samples_count_for_the_windows_that_they_are_in() {
        let (grid, alignment) = line(10);
        let samples = NoiseSamples::new(1, vec![0.0, 0.1, 0.2, 1.0]);
        let placement = Placement::of_offsets(&grid, &alignment, &[9], Some(&[0.0]));
        let landing = CellCounts::new(&samples, &placement, None, Some(&[4, 1, 0, 2]));
        assert_eq!(landing.counts()[0], Count { certain: [2, 1, 1, 1], possible: 3 });
        assert_eq!(landing.counts()[1], Count { certain: [1, 1, 0, 0], possible: 1 });
    }
}
