//! Which regions a cell is in, for certain and perhaps.

use super::{Letter, NamedRegion};
use crate::geometry::Polytope;
use crate::partition::{CellId, CellKind, CellLabels, Grid};
use imdp::numeric::Rational;
use num_traits::Signed;

/// What is known of the letters of a cell: those from `certain` to `possible`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Label {
    /// The regions that contain the cell.
    pub certain: Letter,
    /// The regions that it meets.
    pub possible: Letter,
}

impl Label {
    /// All letters that the cell may have.
    pub(super) fn letters(self) -> impl Iterator<Item = Letter> {
        // Counting through the subsets of the regions that are not certain.
        let open = self.possible & !self.certain;
        let next = move |subset: &Letter| (*subset != open).then(|| subset.wrapping_sub(open) & open);
        std::iter::successors(Some(0), next).map(move |subset| self.certain | subset)
    }
}

/// The label of every cell.
///
/// A cell is in a region for certain if one of its polytopes or the union of its boxes contains it, decided exactly. It may be
/// in a polytope unless one of the half-spaces separates them: that is a few cells more than meet it, which is safe.
pub(super) fn labels(grid: &Grid, regions: &[NamedRegion]) -> Vec<Label> {
    let mut labels = vec![Label::default(); grid.num_cells() as usize];
    for (bit, region) in regions.iter().enumerate() {
        let boxes = region.boxes();
        let contained = CellLabels::new(grid, &boxes, &[]);
        let met = CellLabels::new(grid, &[], &boxes);
        for (id, label) in labels.iter_mut().enumerate() {
            let cell = CellId(id as u32);
            label.certain |= Letter::from(contained.kind(cell) == CellKind::Goal) << bit;
            label.possible |= Letter::from(met.kind(cell) == CellKind::Unsafe) << bit;
        }
        for polytope in region.polytopes() {
            let rows = Rows::new(grid, polytope);
            for (id, label) in labels.iter_mut().enumerate() {
                let (contains, meets) = rows.of(grid, CellId(id as u32));
                label.certain |= Letter::from(contains) << bit;
                label.possible |= Letter::from(meets) << bit;
            }
        }
    }
    labels
}

/// Per half-space and axis: what each layer of cells contributes to the least and the greatest of `G x` at least and at most.
struct Rows<'a> {
    least: Vec<Vec<Vec<Rational>>>,
    greatest: Vec<Vec<Vec<Rational>>>,
    offsets: &'a [Rational],
}

impl<'a> Rows<'a> {
    fn new(grid: &Grid, polytope: &'a Polytope) -> Self {
        let faces = |row: usize, greatest: bool| {
            let of_axis = |(j, axis): (usize, &crate::partition::GridAxis)| {
                let normal = polytope.normals().get(row, j);
                let upper = normal.is_positive() == greatest;
                (0..axis.cells()).map(|i| normal * axis.face(i + u32::from(upper))).collect()
            };
            grid.axes().iter().enumerate().map(of_axis).collect()
        };
        let rows = 0..polytope.offsets().len();
        Self {
            least: rows.clone().map(|row| faces(row, false)).collect(),
            greatest: rows.map(|row| faces(row, true)).collect(),
            offsets: polytope.offsets(),
        }
    }

    /// Whether the polytope contains the cell, and whether no half-space keeps them apart.
    fn of(&self, grid: &Grid, cell: CellId) -> (bool, bool) {
        let sum = |parts: &[Vec<Rational>]| -> Rational {
            parts.iter().enumerate().map(|(j, part)| &part[grid.coordinate(cell, j) as usize]).sum()
        };
        let within = |sides: &[Vec<Vec<Rational>>]| {
            sides.iter().zip(self.offsets).all(|(parts, offset)| sum(parts) <= *offset)
        };
        let meets = within(&self.least);
        (meets && within(&self.greatest), meets)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear_algebra::ExactMatrix;
    use crate::partition::Region;
    use crate::task::Shape;
    use imdp::numeric::from_decimal;
    use nalgebra::DMatrix;

    fn exact(values: &[f64]) -> Vec<Rational> {
        values.iter().map(|&x| from_decimal(x).unwrap()).collect()
    }

    #[test]
    fn letters_are_those_between() {
        let label = Label { certain: 0b0100, possible: 0b1101 };
        assert_eq!(label.letters().collect::<Vec<_>>(), [0b0100, 0b0101, 0b1100, 0b1101]);
        assert_eq!(Label::default().letters().collect::<Vec<_>>(), [0]);
    }

    #[test]
    fn straddling_cells_may_be_in_a_region() {
        let grid = Grid::new(&exact(&[0.0, 0.0]), &exact(&[3.0, 3.0]), &[3, 3]).unwrap();
        let side = |values: [f64; 2]| values.iter().map(|&x| from_decimal(x)).collect();
        let halved = Region { lower: side([0.5, 0.0]), upper: side([2.0, 1.0]) };
        // x + y ≤ 2.
        let normals = ExactMatrix::from_decimals(&DMatrix::from_row_slice(1, 2, &[1.0, 1.0])).unwrap();
        let triangle = Polytope::new(normals, exact(&[2.0]));
        let regions = [
            NamedRegion { name: "box".into(), shapes: vec![Shape::Box(halved)] },
            NamedRegion { name: "triangle".into(), shapes: vec![Shape::Polytope(triangle)] },
        ];
        let labels = labels(&grid, &regions);
        let of = |x, y| labels[grid.cell(&[x, y]).index()];
        assert_eq!(of(0, 0), Label { certain: 0b10, possible: 0b11 });
        assert_eq!(of(1, 0), Label { certain: 0b01, possible: 0b11 });
        assert_eq!(of(2, 0), Label { certain: 0, possible: 0b10 });
        assert_eq!(of(0, 1), Label { certain: 0, possible: 0b10 });
        assert_eq!(of(2, 1), Label { certain: 0, possible: 0 });
    }
}
