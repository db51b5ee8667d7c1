//! The best row of a range of rows, for many overlapping ranges.

use super::query::Direction;
use crate::model::{Choices, RowRange, StateId};

/// A sparse table: `level k` holds the optimum of every `2ᵏ` neighbouring rows.
///
/// A range is covered by two overlapping entries of one level; levels end at the longest range asked for.
#[derive(Clone, Debug)]
pub(super) struct RangeOptimum {
    optimum: Direction,
    levels: Vec<Vec<f64>>,
}

impl RangeOptimum {
    /// For `rows` rows; without [`RangeOptimum::prepare`], ranges are scanned.
    pub(super) fn new(optimum: Direction, rows: usize) -> Self {
        Self { optimum, levels: vec![vec![0.0; rows]] }
    }

    /// Chooses between a table and scans for the ranges of the given states: whichever touches less.
    pub(super) fn prepare(&mut self, choices: &Choices, states: &[StateId]) {
        let rows = self.levels[0].len();
        let ranges = || states.iter().flat_map(|&s| choices.ranges(s)).map(|range| range.len());
        let levels = ranges().max().unwrap_or(1).ilog2() as usize + 1;
        let with_table = rows * (levels - 1) + 4 * ranges().count();
        let levels = if with_table < ranges().sum() { levels } else { 1 };
        self.levels.resize_with(levels, || vec![0.0; rows]);
    }

    /// Back to scans.
    pub(super) fn reset(&mut self) {
        self.levels.truncate(1);
    }

    /// The row values, to be changed before [`RangeOptimum::rebuild`].
    pub(super) fn values_mut(&mut self) -> &mut [f64] {
        &mut self.levels[0]
    }

    /// The row values.
    pub(super) fn values(&self) -> &[f64] {
        &self.levels[0]
    }

    /// Makes the higher levels follow the row values.
    pub(super) fn rebuild(&mut self) {
        for level in 1..self.levels.len() {
            let half = 1 << (level - 1);
            let (below, above) = self.levels.split_at_mut(level);
            let (below, above) = (&below[level - 1], &mut above[0]);
            let pairs = below.iter().zip(below.iter().skip(half));
            match self.optimum {
                Direction::Max => {
                    above
                        .iter_mut()
                        .zip(pairs)
                        .for_each(|(best, (&a, &b))| *best = if a > b { a } else { b });
                }
                Direction::Min => {
                    above
                        .iter_mut()
                        .zip(pairs)
                        .for_each(|(best, (&a, &b))| *best = if a < b { a } else { b });
                }
            }
        }
    }

    /// Per row, the least of some numbers that stand for ranges which contain it, 1 if there is none: what the table says is
    /// lost, but for the row values.
    pub(super) fn least_around<'r>(
        &mut self,
        ranges: impl Iterator<Item = (&'r [RowRange], f64)>,
    ) -> Vec<f64> {
        let mut least = vec![1.0f64; self.levels[0].len()];
        self.levels[1..].iter_mut().for_each(|level| level.fill(1.0));
        let lower = |place: &mut f64, number: f64| *place = if number < *place { number } else { *place };
        for (ranges, number) in ranges {
            for range in ranges {
                let level = range.len().ilog2() as usize;
                let (first, end) = (range.first.index(), range.last.index() + 1);
                match self.levels.get_mut(level).filter(|_| level > 0) {
                    Some(table) => {
                        lower(&mut table[first], number);
                        lower(&mut table[end - (1 << level)], number);
                    }
                    None => least[first..end].iter_mut().for_each(|place| lower(place, number)),
                }
            }
        }
        // What holds for so many neighbours holds for both halves of them.
        for level in (1..self.levels.len()).rev() {
            let half = 1 << (level - 1);
            let (below, above) = self.levels.split_at_mut(level);
            let (below, above) = (below.get_mut(level - 1).filter(|_| level > 1), &above[0]);
            let below = below.unwrap_or(&mut least);
            for (i, &number) in above.iter().enumerate().take(below.len() - half.min(below.len())) {
                lower(&mut below[i], number);
                lower(&mut below[i + half], number);
            }
        }
        least
    }

    /// The optimum over several ranges.
    pub(super) fn best(&self, ranges: &[RowRange]) -> f64 {
        match self.optimum {
            Direction::Max => self.fold(ranges, |a, b| if a > b { a } else { b }),
            Direction::Min => self.fold(ranges, |a, b| if a < b { a } else { b }),
        }
    }

    #[inline]
    fn fold(&self, ranges: &[RowRange], better: impl Fn(f64, f64) -> f64) -> f64 {
        ranges.iter().fold(self.optimum.worst(), |best, range| {
            let level = range.len().ilog2() as usize;
            match self.levels.get(level) {
                Some(table) => {
                    let last = range.last.index() + 1 - (1 << level);
                    better(best, better(table[range.first.index()], table[last]))
                }
                None => {
                    let values = &self.levels[0][range.first.index()..=range.last.index()];
                    values.iter().fold(best, |best, &value| better(best, value))
                }
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::RowId;

    #[test]
    fn agrees_with_a_scan() {
        let values: Vec<f64> = (0..37u32).map(|i| f64::from(i * 7919 % 101)).collect();
        for (optimum, levels) in
            [(Direction::Min, 1), (Direction::Max, 1), (Direction::Min, 6), (Direction::Max, 6)]
        {
            let mut table = RangeOptimum::new(optimum, values.len());
            table.levels.resize_with(levels, || vec![0.0; values.len()]);
            table.values_mut().copy_from_slice(&values);
            table.rebuild();
            for first in 0..values.len() {
                for last in first..values.len() {
                    let scan = values[first..=last]
                        .iter()
                        .copied()
                        .reduce(|a, b| if optimum.prefers(b, a) { b } else { a });
                    let range = RowRange { first: RowId(first as u32), last: RowId(last as u32) };
                    assert_eq!(table.best(&[range]), scan.unwrap());
                }
            }
        }
    }
}
