//! The extreme value of ranges of rows.

use super::side::Side;
use crate::model::RowRange;

/// Level `k` holds the extreme of every `2ᵏ` neighbouring rows; a range is covered by two entries of a level.
pub(super) struct Extremum {
    side: Side,
    levels: Vec<Vec<f64>>,
}

impl Extremum {
    /// The worst for `side` of row values, for ranges of at most `longest` rows.
    pub(super) fn new(side: Side, rows: &[f64], longest: usize) -> Self {
        let mut levels = vec![rows.to_vec()];
        let mut half = 1;
        while 2 * half <= longest.min(rows.len()) {
            let below = &levels[levels.len() - 1];
            let level = below.iter().zip(&below[half..]).map(|(&a, &b)| side.worse(a, b)).collect();
            levels.push(level);
            half *= 2;
        }
        Self { side, levels }
    }

    /// The worst over several ranges.
    pub(super) fn of(&self, ranges: &[RowRange]) -> f64 {
        let of_range = |range: &RowRange| {
            let level = range.len().ilog2() as usize;
            let last = range.last.index() + 1 - (1 << level);
            self.side.worse(self.levels[level][range.first.index()], self.levels[level][last])
        };
        ranges.iter().map(of_range).fold(self.side.best(), |a, b| self.side.worse(a, b))
    }
}
