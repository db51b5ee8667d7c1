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
        let mut corners = Vec::with_capacity(origin.len());
        let mut stride = self.sums.len();
        for (j, &cells) in self.cells.iter().enumerate() {
            stride /= cells as usize;
            let lower = (hull.lower[j] + origin[j]).max(0);
            let upper = (hull.upper[j] + origin[j]).min(cells - 1);
            if lower > upper {
                return 0;
            }
            corners
                .push((upper as usize * stride, usize::try_from(lower - 1).ok().map(|below| below * stride)));
        }
        self.up_to(0, &corners)
    }

    /// Those between the corners, by inclusion and exclusion; a sum that wraps around comes back.
    fn up_to(&self, place: usize, corners: &[(usize, Option<usize>)]) -> u32 {
        let Some((&(upper, below), rest)) = corners.split_first() else { return self.sums[place] };
        let within = self.up_to(place + upper, rest);
        below.map_or(within, |below| within.wrapping_sub(self.up_to(place + below, rest)))
    }
}
