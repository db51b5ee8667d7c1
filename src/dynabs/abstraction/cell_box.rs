//! Boxes of cells.

/// The cells in which one sample may lie: a box of cell coordinates, one cell unless it is near a face.
///
/// Coordinates count from an origin cell: the target's, or the first cell of the grid.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct CellBox {
    /// The least coordinates.
    pub lower: Vec<i32>,
    /// The greatest coordinates.
    pub upper: Vec<i32>,
}

impl CellBox {
    /// The number of cells.
    pub fn volume(&self) -> usize {
        self.lower.iter().zip(&self.upper).map(|(l, u)| (u - l) as usize + 1).product()
    }

    /// Grows to contain `other`.
    pub(super) fn include(&mut self, other: &Self) {
        for j in 0..self.lower.len() {
            self.lower[j] = self.lower[j].min(other.lower[j]);
            self.upper[j] = self.upper[j].max(other.upper[j]);
        }
    }

    pub(super) fn is_single(&self) -> bool {
        self.lower == self.upper
    }

    /// The row-major position of a cell in this box.
    pub(super) fn position(&self, cell: &[i32]) -> usize {
        (0..cell.len()).fold(0, |position, j| {
            position * ((self.upper[j] - self.lower[j]) as usize + 1) + (cell[j] - self.lower[j]) as usize
        })
    }

    /// Visits the cells in row-major order.
    pub(super) fn for_each(&self, mut visit: impl FnMut(&[i32])) {
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
