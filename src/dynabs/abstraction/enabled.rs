//! Which actions are enabled in which cells: a half-space test, scanned in lines.

use super::Targets;
use crate::partition::{CellId, Grid};
use crate::system::SteeringConstraint;
use imdp::model::{RowId, RowRange};
use imdp::progress::Progress;
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
        let mut levels = scan.levels();
        for &cell in chunk {
            for (slack, constraint) in levels[0].slack.iter_mut().zip(constraints) {
                *slack = constraint.bound;
                for (j, gamma) in constraint.state.iter().enumerate() {
                    let center = centers[j][grid.coordinate(cell, j) as usize];
                    *slack -= gamma * center + gamma.abs() * half_widths[j];
                }
            }
            let before = found.ranges.len();
            scan.run(targets, &mut levels, &mut found.ranges);
            found.ranges_per_cell.push((found.ranges.len() - before) as u32);
        }
        progress.advance(chunk.len() as u64);
        found
    };
    // Not all tasks at once: what they found stands only once in memory.
    let mut all = EnabledActions::default();
    for chunks in cells.chunks(CELLS_PER_TASK * TASKS) {
        let parts: Vec<EnabledActions> = chunks.par_chunks(CELLS_PER_TASK).map(of_task).collect();
        parts.into_iter().for_each(|part| all.append(part));
    }
    all.ranges.shrink_to_fit();
    all
}

impl EnabledActions {
    /// Adds the actions of further cells.
    pub(super) fn append(&mut self, part: Self) {
        self.ranges_per_cell.extend(part.ranges_per_cell);
        self.ranges.extend(part.ranges);
    }
}

/// The scan over target points, prepared for one set of constraints.
struct Scan<'a> {
    constraints: &'a [SteeringConstraint],
    /// Per dimension `k` and constraint, the least that dimensions after `k` can contribute to `α·d`,
    least_after: Vec<Vec<f64>>,
    /// the most,
    most_after: Vec<Vec<f64>>,
    /// the most that dimensions from `k` on can,
    most_from: Vec<Vec<f64>>,
    /// and a bound on `|α·d|` over dimensions from `k` on.
    magnitudes: Vec<Vec<f64>>,
    /// By how much more than nothing there must be room, in terms of what is added up, for rounding not to matter.
    spare: f64,
}

/// What the coordinates of the dimensions before one leave to it.
#[derive(Clone)]
struct Level {
    /// Per constraint, what is left of its bound.
    slack: Vec<f64>,
    /// The constraints that some target may still violate.
    active: Vec<usize>,
}

impl<'a> Scan<'a> {
    fn new(targets: &Targets, constraints: &'a [SteeringConstraint]) -> Self {
        let axes = targets.axes().unwrap_or_default();
        let zero = vec![vec![0.0; constraints.len()]; axes.len()];
        let mut scan = Self {
            constraints,
            least_after: zero.clone(),
            most_after: zero.clone(),
            most_from: zero.clone(),
            magnitudes: zero,
            spare: 16.0 * (axes.len() + 1) as f64 * f64::EPSILON,
        };
        for k in (0..axes.len()).rev() {
            let ends = [axes[k][0], axes[k][axes[k].len() - 1]];
            for (i, constraint) in constraints.iter().enumerate() {
                let [a, b] = ends.map(|x| constraint.target[k] * x);
                let after = scan.magnitudes.get(k + 1).map_or(0.0, |after| after[i]);
                scan.magnitudes[k][i] = after + a.abs().max(b.abs());
                scan.most_from[k][i] = scan.most_after[k][i] + a.max(b);
                if k > 0 {
                    scan.least_after[k - 1][i] = scan.least_after[k][i] + a.min(b);
                    scan.most_after[k - 1][i] = scan.most_from[k][i];
                }
            }
        }
        scan
    }

    /// Room for the scan of one cell after the other.
    fn levels(&self) -> Vec<Level> {
        vec![
            Level { slack: vec![0.0; self.constraints.len()], active: vec![] };
            self.least_after.len().max(1)
        ]
    }

    /// The targets that leave room in all constraints; `levels[0].slack` is what the cell leaves.
    fn run(&self, targets: &Targets, levels: &mut [Level], ranges: &mut Vec<RowRange>) {
        let mut found = Found { start: ranges.len(), ranges };
        match targets.axes() {
            Some(axes) => {
                levels[0].active.clear();
                levels[0].active.extend(0..self.constraints.len());
                self.lattice(axes, 0, 0, levels, &mut found);
            }
            None => self.list(targets, &levels[0].slack, &mut found),
        }
    }

    /// Looks for the coordinates of dimension `k`, then of those after it.
    fn lattice(&self, axes: &[Vec<f64>], k: usize, base: usize, levels: &mut [Level], found: &mut Found<'_>) {
        let Some((Level { slack, active }, deeper)) = levels.split_first_mut() else { return };
        // Where there is room for whatever comes after, with more than rounding to spare, it need not be looked at.
        let spare = |i: usize| self.spare * (slack[i].abs() + self.magnitudes[k][i]);
        active.retain(|&i| {
            let room = slack[i] - self.most_from[k][i] - spare(i);
            room < 0.0 || room.is_nan()
        });
        let axis = &axes[k];
        let least = |i: usize| slack[i] - self.least_after[k][i];
        let Some((first, last)) = self.feasible(axis, k, active, least) else { return };
        let base = base * axis.len();
        if deeper.is_empty() {
            return found.push(base + first, base + last);
        }
        let most = |i: usize| slack[i] - self.most_after[k][i] - spare(i);
        let whole = self.feasible(axis, k, active, most);
        let behind: usize = axes[k + 1..].iter().map(Vec::len).product();
        for (i, &x) in axis.iter().enumerate().take(last + 1).skip(first) {
            if let Some((first, last)) = whole.filter(|&(first, last)| first <= i && i <= last) {
                if i == first {
                    found.push((base + first) * behind, (base + last + 1) * behind - 1);
                }
                continue;
            }
            let next = &mut deeper[0];
            next.active.clone_from(active);
            for &i in &*active {
                next.slack[i] = slack[i] - self.constraints[i].target[k] * x;
            }
            self.lattice(axes, k + 1, base + i, deeper, found);
        }
    }

    /// The indices along dimension `k` for which there is room in these constraints, as an inclusive range.
    fn feasible(
        &self,
        axis: &[f64],
        k: usize,
        constraints: &[usize],
        room: impl Fn(usize) -> f64,
    ) -> Option<(usize, usize)> {
        let (mut first, mut last) = (0usize, axis.len() - 1);
        let spacing = if axis.len() > 1 { (axis[last] - axis[0]) / last as f64 } else { 1.0 };
        for &i in constraints {
            let alpha = self.constraints[i].target[k];
            let room = room(i);
            // Monotone in x even in floating point, so the feasible indices are a range.
            let fits = |index: usize| alpha * axis[index] <= room;
            // No number, or less than any: a sum that overflowed decides for nobody.
            if room.is_nan() || room == f64::NEG_INFINITY {
                return None;
            }
            if alpha == 0.0 {
                if room < 0.0 {
                    return None;
                }
                continue;
            }
            // Where both ends fit, so does everything between them.
            if fits(first) && fits(last) {
                continue;
            }
            let guess = ((room / alpha - axis[0]) / spacing).clamp(first as f64, last as f64) as usize;
            if alpha > 0.0 {
                let mut end = guess;
                while end < last && fits(end + 1) {
                    end += 1;
                }
                while !fits(end) {
                    if end == first {
                        return None;
                    }
                    end -= 1;
                }
                last = end;
            } else {
                let mut start = guess;
                while start > first && fits(start - 1) {
                    start -= 1;
                }
                while !fits(start) {
                    if start == last {
                        return None;
                    }
                    start += 1;
                }
                first = start;
            }
        }
        Some((first, last))
    }

    fn list(&self, targets: &Targets, slack: &[f64], found: &mut Found<'_>) {
        let mut point = vec![0.0; targets.dimension()];
        for target in 0..targets.len() {
            targets.point(target, &mut point);
            let enabled = self.constraints.iter().zip(slack).all(|(constraint, &slack)| {
                constraint.target.iter().zip(&point).fold(slack, |rest, (alpha, x)| rest - alpha * x) >= 0.0
            });
            if enabled {
                found.push(target, target);
            }
        }
    }
}

/// The ranges of one cell, behind those of others.
struct Found<'a> {
    start: usize,
    ranges: &'a mut Vec<RowRange>,
}

impl Found<'_> {
    /// Adds the rows of a range of targets, merged with what they continue.
    fn push(&mut self, first: usize, last: usize) {
        let (first, last) = (RowId::from_index(first), RowId::from_index(last));
        match self.ranges[self.start..].last_mut() {
            Some(previous) if previous.last.next() == first => previous.last = last,
            _ => self.ranges.push(RowRange { first, last }),
        }
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
