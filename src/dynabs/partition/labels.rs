//! Which cells are goal cells and which are unsafe.

use super::{CellId, Grid, Region};
use imdp::numeric::Rational;

/// What a cell means to the task.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CellKind {
    /// Neither goal nor unsafe.
    Ordinary,
    /// Contained in the goal region.
    Goal,
    /// Meets the unsafe region.
    Unsafe,
}

/// The kind of every cell of a grid.
#[derive(Clone, Debug)]
pub struct CellLabels {
    kinds: Vec<CellKind>,
}

impl CellLabels {
    /// Labels the cells: `Goal` if contained in the union of `goal`, `Unsafe` if it meets one of `unsafe_`.
    ///
    /// Decided exactly. The boxes of the two lists must not overlap each other.
    pub fn new(grid: &Grid, goal: &[Region], unsafe_: &[Region]) -> Self {
        let snap = Snap::new(grid, goal.iter().chain(unsafe_));
        let (goal, unsafe_) = (snap.boxes(goal), snap.boxes(unsafe_));
        let kind = |cell: &RankBox| {
            if unsafe_.iter().any(|region| region.meets(cell)) {
                CellKind::Unsafe
            } else if cell.covered_by(&goal) {
                CellKind::Goal
            } else {
                CellKind::Ordinary
            }
        };
        // Few cells differ in where they lie among the faces: the kinds of those are the kinds of all.
        let axes: Vec<AxisClasses> = (0..grid.dimension()).map(|j| snap.classes(j)).collect();
        let count = axes.iter().map(|axis| axis.sides.len()).product();
        let mut cell = RankBox { lower: vec![0; grid.dimension()], upper: vec![0; grid.dimension()] };
        let of_classes: Vec<CellKind> = (0..count)
            .map(|mut id: usize| {
                for (j, axis) in axes.iter().enumerate().rev() {
                    (cell.lower[j], cell.upper[j]) = axis.sides[id % axis.sides.len()];
                    id /= axis.sides.len();
                }
                kind(&cell)
            })
            .collect();
        let mut kinds = Vec::with_capacity(grid.num_cells() as usize);
        fill(&axes, 0, &of_classes, &mut kinds);
        Self { kinds }
    }

    /// Labels the cells of a task that is to stay somewhere: `Unsafe` unless contained in the union of `safe`, which
    /// is everything if empty, and clear of `unsafe_`; `Ordinary` elsewhere.
    pub fn staying(grid: &Grid, safe: &[Region], unsafe_: &[Region]) -> Self {
        let contained = Self::new(grid, safe, &[]);
        let mut labels = Self::new(grid, &[], unsafe_);
        for (kind, contained) in labels.kinds.iter_mut().zip(contained.kinds) {
            if !safe.is_empty() && contained != CellKind::Goal {
                *kind = CellKind::Unsafe;
            }
        }
        labels
    }

    /// What states of the cells may mean, at best: `Goal` if it meets one of `goal`, `Unsafe` if contained in the union of
    /// `unsafe_`.
    ///
    /// The boxes of the two lists must not overlap each other.
    pub fn at_best(grid: &Grid, goal: &[Region], unsafe_: &[Region]) -> Self {
        let mut labels = Self::new(grid, unsafe_, goal);
        for kind in &mut labels.kinds {
            *kind = match kind {
                CellKind::Ordinary => CellKind::Ordinary,
                CellKind::Goal => CellKind::Unsafe,
                CellKind::Unsafe => CellKind::Goal,
            };
        }
        labels
    }

    /// The same for a task that is to stay somewhere: `Unsafe` unless it meets one of `safe`, which is everything if
    /// empty, and is not contained in the union of `unsafe_`; `Ordinary` elsewhere.
    pub fn staying_at_best(grid: &Grid, safe: &[Region], unsafe_: &[Region]) -> Self {
        let met = Self::new(grid, &[], safe);
        let mut labels = Self::at_best(grid, &[], unsafe_);
        for (kind, met) in labels.kinds.iter_mut().zip(met.kinds) {
            if !safe.is_empty() && met != CellKind::Unsafe {
                *kind = CellKind::Unsafe;
            }
        }
        labels
    }

    /// These kinds, one per cell.
    pub fn from_kinds(kinds: Vec<CellKind>) -> Self {
        Self { kinds }
    }

    /// The kind of one cell.
    pub fn kind(&self, cell: CellId) -> CellKind {
        self.kinds[cell.index()]
    }

    /// How many cells are of this kind.
    pub fn count(&self, kind: CellKind) -> usize {
        self.kinds.iter().filter(|&&k| k == kind).count()
    }

    /// The kinds, in row-major order of the cells.
    pub fn kinds(&self) -> &[CellKind] {
        &self.kinds
    }

    /// All cells with their kinds, in row-major order.
    pub fn iter(&self) -> impl Iterator<Item = (CellId, CellKind)> + '_ {
        self.kinds.iter().enumerate().map(|(id, &kind)| (CellId(id as u32), kind))
    }
}

/// A box whose sides are ranks among the faces of all regions: 0 is −∞, the last rank is +∞.
#[derive(Clone, Debug)]
struct RankBox {
    lower: Vec<u32>,
    upper: Vec<u32>,
}

impl RankBox {
    fn meets(&self, other: &Self) -> bool {
        (0..self.lower.len()).all(|j| self.lower[j].max(other.lower[j]) < self.upper[j].min(other.upper[j]))
    }

    /// Whether the union of `boxes` contains this box: cut off what the first one covers, ask the rest.
    fn covered_by(&self, boxes: &[Self]) -> bool {
        let Some((first, rest)) = boxes.split_first() else { return false };
        if !self.meets(first) {
            return self.covered_by(rest);
        }
        let mut inner = self.clone();
        for j in 0..self.lower.len() {
            if inner.lower[j] < first.lower[j] {
                let mut outside = inner.clone();
                outside.upper[j] = first.lower[j];
                if !outside.covered_by(rest) {
                    return false;
                }
                inner.lower[j] = first.lower[j];
            }
            if inner.upper[j] > first.upper[j] {
                let mut outside = inner.clone();
                outside.lower[j] = first.upper[j];
                if !outside.covered_by(rest) {
                    return false;
                }
                inner.upper[j] = first.upper[j];
            }
        }
        true
    }
}

/// Where the cells of one dimension lie among the faces of all regions.
struct AxisClasses {
    /// The ranks of the two sides, of every class.
    sides: Vec<(u32, u32)>,
    /// How many cells in a row belong to which class.
    runs: Vec<(usize, usize)>,
}

/// Appends the kinds of all cells, row-major, the classes of the dimensions before the first of `axes` being `class`.
fn fill(axes: &[AxisClasses], class: usize, of_classes: &[CellKind], kinds: &mut Vec<CellKind>) {
    let Some((axis, rest)) = axes.split_first() else { return };
    for &(cells, own) in &axis.runs {
        let class = class * axis.sides.len() + own;
        if rest.is_empty() {
            kinds.resize(kinds.len() + cells, of_classes[class]);
            continue;
        }
        // The cells of a run are alike: what follows from the first one is copied.
        let start = kinds.len();
        fill(rest, class, of_classes, kinds);
        let end = kinds.len();
        (1..cells).for_each(|_| kinds.extend_from_within(start..end));
    }
}

/// Replaces coordinates by ranks among the faces of the regions.
///
/// Between two neighbouring region faces nothing changes, so a cell may be snapped outwards to them
/// without changing which regions it meets or whether their union contains it. What is left is integers.
struct Snap {
    breakpoints: Vec<Vec<Rational>>,
    /// Per dimension and grid face, the rank of the last region face at or below it.
    below: Vec<Vec<u32>>,
    /// Per dimension and grid face, the rank of the first region face at or above it.
    above: Vec<Vec<u32>>,
}

impl Snap {
    fn new<'a>(grid: &Grid, regions: impl Iterator<Item = &'a Region> + Clone) -> Self {
        let mut snap = Self { breakpoints: vec![], below: vec![], above: vec![] };
        for (j, axis) in grid.axes().iter().enumerate() {
            let sides = regions.clone().flat_map(|region| [&region.lower[j], &region.upper[j]]);
            let mut faces: Vec<Rational> = sides.flatten().cloned().collect();
            faces.sort();
            faces.dedup();
            let (below, above) = (0..=axis.cells())
                .map(|i| {
                    let face = axis.face(i);
                    let at_or_below = faces.partition_point(|b| *b <= face) as u32;
                    let strictly_below = faces.partition_point(|b| *b < face) as u32;
                    (at_or_below, strictly_below + 1)
                })
                .unzip();
            snap.breakpoints.push(faces);
            snap.below.push(below);
            snap.above.push(above);
        }
        snap
    }

    fn classes(&self, j: usize) -> AxisClasses {
        let mut sides: Vec<(u32, u32)> = vec![];
        let mut runs: Vec<(usize, usize)> = vec![];
        for (&below, &above) in self.below[j].iter().zip(&self.above[j][1..]) {
            if sides.last() == Some(&(below, above)) {
                runs.iter_mut().last().into_iter().for_each(|run| run.0 += 1);
            } else {
                // Ranks do not decrease, so a class does not come back.
                runs.push((1, sides.len()));
                sides.push((below, above));
            }
        }
        AxisClasses { sides, runs }
    }

    fn boxes(&self, regions: &[Region]) -> Vec<RankBox> {
        let rank = |j: usize, x: &Rational| self.breakpoints[j].partition_point(|b| b <= x) as u32;
        let last = |j: usize| self.breakpoints[j].len() as u32 + 1;
        let to_ranks = |region: &Region| RankBox {
            lower: region
                .lower
                .iter()
                .enumerate()
                .map(|(j, x)| x.as_ref().map_or(0, |x| rank(j, x)))
                .collect(),
            upper: (region.upper.iter().enumerate())
                .map(|(j, x)| x.as_ref().map_or(last(j), |x| rank(j, x)))
                .collect(),
        };
        regions.iter().map(to_ranks).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use imdp::numeric::from_decimal;
    use proptest::prelude::*;

    fn exact(values: &[f64]) -> Vec<Rational> {
        values.iter().map(|&x| from_decimal(x).unwrap()).collect()
    }

    fn region(lower: &[f64], upper: &[f64]) -> Region {
        let side = |values: &[f64]| values.iter().map(|&x| from_decimal(x)).collect();
        Region { lower: side(lower), upper: side(upper) }
    }

    fn count(grid: &Grid, goal: &[Region], unsafe_: &[Region]) -> (usize, usize) {
        let labels = CellLabels::new(grid, goal, unsafe_);
        (labels.count(CellKind::Goal), labels.count(CellKind::Unsafe))
    }

    #[test]
    fn touching_is_not_meeting() {
        let grid = Grid::new(&exact(&[-1.0, -1.0]), &exact(&[1.0, 0.0]), &[20, 10]).unwrap();
        let goal = region(&[-0.1, -0.1], &[0.1, 0.0]);
        let wall = region(&[-1.0, -0.2], &[-0.1, 0.0]);
        assert_eq!(count(&grid, &[goal], &[wall]), (2, 18));
    }

    #[test]
    fn a_union_can_cover_what_no_box_does() {
        let grid = Grid::new(&exact(&[0.0, 0.0]), &exact(&[3.0, 3.0]), &[3, 3]).unwrap();
        let left = region(&[0.9, f64::NEG_INFINITY], &[1.5, f64::INFINITY]);
        let right = region(&[1.5, 1.0], &[2.0, 2.5]);
        assert_eq!(count(&grid, std::slice::from_ref(&left), &[]), (0, 0));
        assert_eq!(count(&grid, &[left.clone(), right.clone()], &[]), (1, 0));
        assert_eq!(count(&grid, &[right, left], &[]), (1, 0));
    }

    #[test]
    fn a_sliver_inside_a_cell_makes_it_unsafe() {
        let grid = Grid::new(&exact(&[0.0]), &exact(&[3.0]), &[3]).unwrap();
        assert_eq!(count(&grid, &[], &[region(&[1.4], &[1.40001])]), (0, 1));
        assert_eq!(count(&grid, &[], &[region(&[1.0], &[2.0])]), (0, 1));
        assert_eq!(count(&grid, &[], &[region(&[2.9999999999999], &[f64::INFINITY])]), (0, 1));
    }

    proptest! {
        /// Against sampling every cell on a lattice finer than all faces.
        #[test]
        fn labels_agree_with_a_pointwise_check(
            boxes in prop::collection::vec(((0i32..12, 1i32..6), (0i32..12, 1i32..6)), 1..5)
        ) {
            let grid = Grid::new(&exact(&[0.0, 0.0]), &exact(&[12.0, 12.0]), &[4, 4]).unwrap();
            let goal: Vec<_> = boxes.iter().map(|&((x, w), (y, h))| {
                region(&[f64::from(x), f64::from(y)], &[f64::from(x + w), f64::from(y + h)])
            }).collect();
            let inside = |px: i32, py: i32| boxes.iter().any(|&((x, w), (y, h))| {
                x <= px && px < x + w && y <= py && py < y + h
            });
            let goal_labels = CellLabels::new(&grid, &goal, &[]);
            let unsafe_labels = CellLabels::new(&grid, &[], &goal);
            let perhaps_goal = CellLabels::at_best(&grid, &goal, &[]);
            let surely_unsafe = CellLabels::at_best(&grid, &[], &goal);
            let [safe, perhaps_safe] = [CellLabels::staying, CellLabels::staying_at_best].map(|of| of(&grid, &goal, &[]));
            for cx in 0..4 {
                for cy in 0..4 {
                    let cell = grid.cell(&[cx, cy]);
                    let points: Vec<_> = (0..9).map(|k| {
                        inside(3 * cx as i32 + k / 3, 3 * cy as i32 + k % 3)
                    }).collect();
                    prop_assert_eq!(goal_labels.kind(cell) == CellKind::Goal, points.iter().all(|&p| p));
                    prop_assert_eq!(unsafe_labels.kind(cell) == CellKind::Unsafe, points.iter().any(|&p| p));
                    prop_assert_eq!(perhaps_goal.kind(cell) == CellKind::Goal, points.iter().any(|&p| p));
                    prop_assert_eq!(surely_unsafe.kind(cell) == CellKind::Unsafe, points.iter().all(|&p| p));
                    prop_assert_eq!(safe.kind(cell) == CellKind::Ordinary, points.iter().all(|&p| p));
                    prop_assert_eq!(perhaps_safe.kind(cell) == CellKind::Ordinary, points.iter().any(|&p| p));
                }
            }
        }
    }
}
