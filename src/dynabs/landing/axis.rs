//! One coordinate of the landing lattice.

use super::taps::Taps;

/// The cells of one coordinate, and the sub-cells in which images lie.
#[derive(Clone, Debug)]
pub struct Axis {
    /// The number of cells of the partition.
    pub cells: usize,
    /// How many sub-cells a cell has.
    pub resolution: usize,
    /// Whether cell 0 follows the last one.
    pub periodic: bool,
    /// The noise of this coordinate, if it has any.
    pub noise: Option<Taps>,
    /// The first sub-cell that is looked at, counted from the lower face of the partition.
    pub first: i64,
    /// The number of sub-cells that are looked at.
    pub len: usize,
}

impl Axis {
    /// An axis on which images occupy sub-cells from `images.0` to `images.1`.
    ///
    /// Beyond some sub-cell on either side nothing can come back to the partition: all others there are like it.
    pub fn new(
        cells: usize,
        resolution: usize,
        periodic: bool,
        noise: Option<Taps>,
        images: (i64, i64),
    ) -> Self {
        let all = (cells * resolution) as i64;
        if periodic {
            return Self { cells, resolution, periodic, noise, first: 0, len: all as usize };
        }
        let (back, forth) = noise.as_ref().map_or((0, 0), |taps| (taps.last() + 1, taps.first));
        let (lowest, highest) = ((-1 - back).min(-1), (all - forth).max(all));
        let first = images.0.clamp(lowest, highest);
        let last = images.1.clamp(first, highest);
        Self { cells, resolution, periodic, noise, first, len: (last - first) as usize + 1 }
    }

    /// The number of sub-cells of the partition.
    pub fn sub_cells(&self) -> i64 {
        (self.cells * self.resolution) as i64
    }

    /// Where the sub-cells `first ..= last` are among those that are looked at: the position of the first, and how many.
    pub fn place(&self, first: i64, last: i64) -> (usize, usize) {
        if self.periodic {
            let all = self.sub_cells();
            let size = last.saturating_sub(first).saturating_add(1);
            return if size >= all {
                (0, all as usize)
            } else {
                (first.rem_euclid(all) as usize, size as usize)
            };
        }
        let end = self.first + self.len as i64 - 1;
        let (first, last) = (first.clamp(self.first, end), last.clamp(self.first, end));
        ((first - self.first) as usize, (last - first) as usize + 1)
    }

    /// The cell of a sub-cell, or `None` outside the partition.
    pub fn cell(&self, sub_cell: i64) -> Option<usize> {
        let cell = sub_cell.div_euclid(self.resolution as i64);
        if self.periodic {
            return Some(cell.rem_euclid(self.cells as i64) as usize);
        }
        usize::try_from(cell).ok().filter(|&cell| cell < self.cells)
    }
}
