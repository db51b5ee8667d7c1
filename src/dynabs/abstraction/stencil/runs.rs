//! Cells in runs along the last dimension.

use super::super::cell_box::CellBox;
use super::Ground;

/// Cells around an origin, in runs along the last dimension, ascending.
#[derive(Clone, Debug)]
pub(in super::super) struct Runs {
    /// A box around all of them.
    hull: CellBox,
    /// The coordinates of the first cell of every run, one run after the other.
    starts: Vec<i32>,
    /// The number of cells before each run; one more entry than runs.
    positions: Vec<u32>,
    /// How far the first cell of each run is from the origin's, in cell numbers.
    shifts: Vec<i64>,
}

impl Runs {
    /// The cells of a box that are `listed` at their row-major position in it.
    pub(in super::super) fn new(hull: &CellBox, ground: &Ground, listed: impl Fn(usize) -> bool) -> Self {
        let n = hull.lower.len();
        let mut runs = Self { hull: hull.clone(), starts: vec![], positions: vec![0], shifts: vec![] };
        let (mut position, mut cells) = (0, 0u32);
        hull.for_each(|cell| {
            if listed(position) {
                let follows = position > 0 && cell[n - 1] > hull.lower[n - 1] && listed(position - 1);
                if !follows {
                    if cells > 0 {
                        runs.positions.push(cells);
                    }
                    runs.starts.extend_from_slice(cell);
                    runs.shifts.push(ground.number(cell));
                }
                cells += 1;
            }
            position += 1;
        });
        if cells > 0 {
            runs.positions.push(cells);
        }
        runs
    }

    /// A box around the cells.
    pub(in super::super) fn hull(&self) -> &CellBox {
        &self.hull
    }

    /// The number of cells.
    pub(in super::super) fn len(&self) -> usize {
        self.positions.last().map_or(0, |&cells| cells as usize)
    }

    /// The parts of the runs at `origin` that lie in the grid: the number of the first cell, its position among all cells, how
    /// many there are.
    pub(in super::super) fn for_each(
        &self,
        ground: &Ground,
        origin: &[i32],
        mut visit: impl FnMut(usize, usize, usize),
    ) {
        let base = ground.number(origin);
        let runs = self.positions.windows(2).zip(&self.shifts);
        if ground.contains(&self.hull, origin) {
            for (positions, shift) in runs {
                visit((base + shift) as usize, positions[0] as usize, (positions[1] - positions[0]) as usize);
            }
            return;
        }
        if self.len() == self.hull.volume() {
            return self.walk(ground, origin, (0, 0, 0), &mut visit);
        }
        let Some(last) = origin.len().checked_sub(1) else { return };
        for ((positions, shift), start) in runs.zip(self.starts.chunks_exact(origin.len())) {
            let is_inside = (0..last).all(|j| (0..ground.cells[j]).contains(&(start[j] + origin[j])));
            if !is_inside {
                continue;
            }
            let first = start[last] + origin[last];
            let cut = (-first).max(0);
            let end = (first + (positions[1] - positions[0]) as i32).min(ground.cells[last]);
            if first + cut < end {
                let number = (base + shift + i64::from(cut)) as usize;
                visit(number, positions[0] as usize + cut as usize, (end - first - cut) as usize);
            }
        }
    }

    /// The same where all cells of the box are there, without a look at those beyond the grid: dimension `j` and those after it,
    /// with what those before add to the number of a cell and to its position.
    fn walk(
        &self,
        ground: &Ground,
        origin: &[i32],
        (j, number, position): (usize, usize, usize),
        visit: &mut impl FnMut(usize, usize, usize),
    ) {
        let Some((number, position, length)) = self.along(ground, origin, (j, number, position)) else {
            return;
        };
        match origin.len() - j {
            1 => visit(number, position, length),
            // The last dimension is the same for all cells of the one before: most of the work is here.
            2 => {
                let cells = ground.cells[j + 1] as usize;
                let width = (self.hull.upper[j + 1] - self.hull.lower[j + 1]) as usize + 1;
                let Some((first, start, run)) = self.along(ground, origin, (j + 1, 0, 0)) else { return };
                for i in 0..length {
                    visit((number + i) * cells + first, (position + i) * width + start, run);
                }
            }
            _ => {
                (0..length).for_each(|i| self.walk(ground, origin, (j + 1, number + i, position + i), visit))
            }
        }
    }

    /// The part of the box that lies in the grid along dimension `j`: the number and the position of its first cell, counted in
    /// the dimensions up to this one, and how many cells there are.
    fn along(
        &self,
        ground: &Ground,
        origin: &[i32],
        (j, number, position): (usize, usize, usize),
    ) -> Option<(usize, usize, usize)> {
        let (lower, upper) = (self.hull.lower[j], self.hull.upper[j]);
        let first = lower.max(-origin[j]);
        let last = upper.min(ground.cells[j] - 1 - origin[j]);
        (first <= last).then(|| {
            let number = number * ground.cells[j] as usize + (first + origin[j]) as usize;
            let position = position * ((upper - lower) as usize + 1) + (first - lower) as usize;
            (number, position, (last - first) as usize + 1)
        })
    }
}
