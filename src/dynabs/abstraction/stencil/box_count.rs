//! How many cells of a kind lie in a box.

use super::super::cell_box::CellBox;
use super::Ground;
use imdp::model::StateId;

/// The number of cells of a kind in every box from the first cell of the grid on (a summed-area table).
#[derive(Clone, Debug)]
pub(in super::super) struct BoxCount {
    cells: Vec<i32>,
    /// Row-major over the cells; all numbers up to and including the cell.
    sums: Vec<u32>,
}

impl BoxCount {
    /// Counts the cells whose state is `counted`.
    pub(in super::super) fn new(ground: &Ground, counted: impl Fn(StateId) -> bool) -> Self {
        let mut sums: Vec<u32> = ground.states.iter().map(|&state| u32::from(counted(state))).collect();
        let mut stride = 1;
        for &cells in ground.cells.iter().rev() {
            for i in 0..sums.len() {
                if !(i / stride).is_multiple_of(cells as usize) {
                    sums[i] += sums[i - stride];
                }
            }
            stride *= cells as usize;
        }
        Self { cells: ground.cells.clone(), sums }
    }

    /// Those in the part of a box at `origin` that lies in the grid.
    pub(in super::super) fn of(&self, hull: &CellBox, origin: &[i32]) -> u32 {
        let n = origin.len();
        let side = |j: usize| {
            let lower = (hull.lower[j] + origin[j]).max(0);
            let upper = (hull.upper[j] + origin[j]).min(self.cells[j] - 1);
            (lower, upper)
        };
        if (0..n).any(|j| side(j).0 > side(j).1) {
            return 0;
        }
        let mut total = 0u32;
        // Inclusion and exclusion over the corners; a sum that wraps around comes back.
        for corner in 0..1u32 << n {
            let mut index = Some(0usize);
            for j in 0..n {
                let (lower, upper) = side(j);
                let coordinate = if corner >> j & 1 == 1 { lower - 1 } else { upper };
                let along = usize::try_from(coordinate).ok();
                index = index.zip(along).map(|(index, along)| index * self.cells[j] as usize + along);
            }
            let sum = index.map_or(0, |index| self.sums[index]);
            total =
                if corner.count_ones() % 2 == 0 { total.wrapping_add(sum) } else { total.wrapping_sub(sum) };
        }
        total
    }
}
