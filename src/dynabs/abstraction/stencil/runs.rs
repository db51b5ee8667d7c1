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
            let spans: Option<Vec<Span>> =
                (0..origin.len()).map(|j| Span::new(&self.hull, ground, origin, j)).collect();
            return spans.map_or((), |spans| walk(&spans, (0, 0), &mut visit));
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
}

/// The part of a box that lies in the grid along one dimension.
struct Span {
    /// How many cells the grid has there,
    cells: usize,
    /// and the box.
    width: usize,
    /// The first cell that both have, in the grid,
    first: usize,
    /// and in the box.
    start: usize,
    /// How many these are.
    length: usize,
}

impl Span {
    fn new(hull: &CellBox, ground: &Ground, origin: &[i32], j: usize) -> Option<Self> {
        let (lower, upper) = (hull.lower[j], hull.upper[j]);
        let first = lower.max(-origin[j]);
        let last = upper.min(ground.cells[j] - 1 - origin[j]);
        (first <= last).then(|| Self {
            cells: ground.cells[j] as usize,
            width: (upper - lower) as usize + 1,
            first: (first + origin[j]) as usize,
            start: (first - lower) as usize,
            length: (last - first) as usize + 1,
        })
    }

    /// What a cell is counted as after the ones before it, in the grid and in the box.
    fn after(&self, (number, position): (usize, usize)) -> (usize, usize) {
        (number * self.cells + self.first, position * self.width + self.start)
    }
}

/// Visits the cells of a box that has all of its cells, without a look at those beyond the grid: where they lie along these
/// dimensions, with what those before add to the number of a cell and to its position.
fn walk(spans: &[Span], before: (usize, usize), visit: &mut impl FnMut(usize, usize, usize)) {
    match spans {
        [] => {}
        [run] => {
            let (number, position) = run.after(before);
            visit(number, position, run.length);
        }
        // Most of the work is here.
        [span, run] => {
            let (number, position) = span.after(before);
            for i in 0..span.length {
                let (number, position) = run.after((number + i, position + i));
                visit(number, position, run.length);
            }
        }
        [span, rest @ ..] => {
            let (number, position) = span.after(before);
            (0..span.length).for_each(|i| walk(rest, (number + i, position + i), visit));
        }
    }
}
