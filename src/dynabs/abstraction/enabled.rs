//! Which actions are enabled in which cells: a half-space test, scanned in lines.

use super::Targets;
use super::scan::Scan;
use crate::partition::{CellId, Grid};
use crate::system::SteeringConstraint;
use imdp::model::{RowId, RowRange};
use imdp::progress::Progress;
use imdp::ranks::Share;
use rayon::prelude::*;

/// The enabled actions of some cells, as ranges of action numbers.
#[derive(Clone, Debug, Default)]
pub struct EnabledActions {
    /// Per cell, how many of `ranges` are its own; cells in the order asked for.
    pub ranges_per_cell: Vec<u32>,
    /// The ranges of all cells, one after the other, ascending within a cell.
    pub ranges: Vec<RowRange>,
}

/// Cells per parallel task: a few milliseconds of work in two dimensions.
const CELLS_PER_TASK: usize = 256;

/// Tasks whose results are put together at once.
const TASKS: usize = 128;

/// About how many numbers are looked at for a cell.
const WORK_PER_CELL: usize = 64;

/// The actions enabled in each of `cells`.
///
/// Action `a` is enabled in cell `s` iff the feedback law keeps its input in `U` (and `U′`) from every
/// state of the cell (ECC 2024, eq. (8) and Lemma 1). Each half-space `α·d + γ·x ≤ β` holds on the whole
/// box with center `c` and widths `w` iff
///
/// `α·d_a ≤ β − γ·c − |γ|·w/2`,
///
/// whose right-hand side is one number per cell: the enabled targets are the lattice points of a polytope.
/// They are found dimension by dimension; the last dimension gives a range directly, and so does a slab of the lattice in
/// which everything is enabled. What it takes follows the number of ranges found, not that of targets.
pub fn enabled_actions(
    grid: &Grid,
    cells: &[CellId],
    targets: &Targets,
    constraints: &[SteeringConstraint],
    progress: &dyn Progress,
) -> EnabledActions {
    let centers: Vec<_> = grid.axes().iter().map(|axis| axis.centers()).collect();
    enabled_around(&centers, grid, cells, targets, constraints, progress)
}

/// The same for those who ask about a few cells at a time: `centers` are those of all cells, by dimension.
pub(super) fn enabled_around(
    centers: &[Vec<f64>],
    grid: &Grid,
    cells: &[CellId],
    targets: &Targets,
    constraints: &[SteeringConstraint],
    progress: &dyn Progress,
) -> EnabledActions {
    let half_widths: Vec<f64> =
        grid.axes().iter().map(|axis| 0.5 * imdp::numeric::to_f64_up(axis.width())).collect();
    let scan = Scan::new(targets, constraints);
    let of_task = |chunk: &[CellId]| {
        let mut found = EnabledActions::default();
        let (mut slack, mut levels) = (vec![0.0; constraints.len()], scan.levels());
        for &cell in chunk {
            for (slack, constraint) in slack.iter_mut().zip(constraints) {
                *slack = constraint.bound;
                for (j, gamma) in constraint.state.iter().enumerate() {
                    let center = centers[j][grid.coordinate(cell, j) as usize];
                    *slack -= gamma * center + gamma.abs() * half_widths[j];
                }
            }
            let before = found.ranges.len();
            scan.run(targets, &slack, &mut levels, &mut found.ranges);
            found.ranges_per_cell.push((found.ranges.len() - before) as u32);
        }
        progress.advance(chunk.len() as u64);
        found
    };
    let share = Share::new(cells.len(), cells.len() * WORK_PER_CELL);
    // Not all tasks at once: what they found stands only once in memory.
    let mut all = EnabledActions::default();
    for chunks in cells[share.own()].chunks(CELLS_PER_TASK * TASKS) {
        let parts: Vec<EnabledActions> = chunks.par_chunks(CELLS_PER_TASK).map(of_task).collect();
        parts.into_iter().for_each(|part| all.append(part));
    }
    all.ranges.shrink_to_fit();
    all.joined(&share)
}

impl EnabledActions {
    /// Adds the actions of further cells.
    pub(super) fn append(&mut self, part: Self) {
        self.ranges_per_cell.extend(part.ranges_per_cell);
        self.ranges.extend(part.ranges);
    }

    /// Per cell, how many ranges come before its own; one more entry than cells.
    pub(super) fn starts(&self) -> Vec<usize> {
        let ends = self.ranges_per_cell.iter().scan(0, |end, &count| {
            *end += count as usize;
            Some(*end)
        });
        std::iter::once(0).chain(ends).collect()
    }

    /// Those of all cells, from those of the cells of this process.
    pub(super) fn joined(self, share: &Share) -> Self {
        if share.is_all() {
            return self;
        }
        let ends = self.ranges.iter().flat_map(|range| [range.first.0, range.last.0]);
        let ends = share.join(ends.collect::<Vec<u32>>());
        let range = |ends: &[u32; 2]| RowRange { first: RowId(ends[0]), last: RowId(ends[1]) };
        let ranges = ends.as_chunks::<2>().0.iter().map(range).collect();
        Self { ranges_per_cell: share.join(self.ranges_per_cell), ranges }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::TargetPoints;
    use imdp::numeric::from_decimal;
    use proptest::prelude::*;

    fn grid(cells: &[u32]) -> Grid {
        let lower = vec![from_decimal(-1.0).unwrap(); cells.len()];
        let upper = vec![from_decimal(1.0).unwrap(); cells.len()];
        Grid::new(&lower, &upper, cells).unwrap()
    }

    proptest! {
        /// The scan finds what testing every target one by one finds.
        #[test]
        fn scan_agrees_with_the_plain_test(
            coefficients in prop::collection::vec((prop::array::uniform3(-2.0f64..2.0), -1.0f64..3.0), 1..6),
            cell in 0u32..60,
        ) {
            let grid = grid(&[3, 4, 5]);
            let constraints: Vec<_> = coefficients.iter().map(|(alpha, bound)| SteeringConstraint {
                target: alpha.to_vec(), state: vec![0.3, -0.2, 0.1], bound: *bound,
            }).collect();
            let targets = Targets::new(&TargetPoints::Centers, &grid);
            let found = enabled_actions(&grid, &[CellId(cell)], &targets, &constraints, &());
            let found: Vec<_> = found.ranges.iter().flat_map(|r| r.rows()).collect();
            let list = (0..60).map(|t| {
                grid.axes().iter().zip(grid.coordinates(CellId(t))).map(|(axis, i)| axis.center(i)).collect()
            });
            let listed = Targets::new(&TargetPoints::List(list.collect()), &grid);
            let expected = enabled_actions(&grid, &[CellId(cell)], &listed, &constraints, &());
            let expected: Vec<_> = expected.ranges.iter().flat_map(|r| r.rows()).collect();
            prop_assert_eq!(found, expected);
        }
    }
}
