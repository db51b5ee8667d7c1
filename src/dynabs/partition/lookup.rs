//! Cells and regions of points in doubles, as a controller meets them.

use super::{CellId, Grid, Region};
use imdp::numeric::to_f64;

/// Finds the cell of a point: half-open like the cells themselves, `face_i ≤ x < face_{i+1}`.
///
/// Faces are rounded to the nearest double. Rounding keeps the order, so a number that was rounded itself
/// falls into the cell of the exact one, or into the next if it is that close to the face: less than the
/// steering error for which the abstraction counts a sample on both sides.
#[derive(Clone, Debug, PartialEq)]
pub struct CellLookup {
    faces: Vec<Vec<f64>>,
    strides: Vec<u32>,
}

/// A region for points in doubles: `lower ≤ x < upper` in every dimension.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionLookup {
    lower: Vec<f64>,
    upper: Vec<f64>,
}

impl CellLookup {
    /// The lookup of a grid.
    pub fn new(grid: &Grid) -> Self {
        let faces =
            |axis: &super::grid::GridAxis| (0..=axis.cells()).map(|i| to_f64(&axis.face(i))).collect();
        Self { faces: grid.axes().iter().map(faces).collect(), strides: grid.strides().to_vec() }
    }

    /// The faces in each dimension, ascending: one more than cells.
    pub fn faces(&self) -> &[Vec<f64>] {
        &self.faces
    }

    /// How far apart in row-major order two neighbours in each dimension are.
    pub fn strides(&self) -> &[u32] {
        &self.strides
    }

    /// The cell that contains `x`, or `None` outside (and for what is not a number).
    pub fn locate(&self, x: &[f64]) -> Option<CellId> {
        let mut id = 0;
        for ((faces, stride), x) in self.faces.iter().zip(&self.strides).zip(x) {
            let passed = faces.partition_point(|face| face <= x);
            if passed == 0 || passed == faces.len() {
                return None;
            }
            id += (passed as u32 - 1) * stride;
        }
        Some(CellId(id))
    }
}

impl RegionLookup {
    /// The lookup of a region.
    pub fn new(region: &Region) -> Self {
        let side = |sides: &[Option<_>], open: f64| {
            sides.iter().map(|side| side.as_ref().map_or(open, to_f64)).collect()
        };
        Self { lower: side(&region.lower, f64::NEG_INFINITY), upper: side(&region.upper, f64::INFINITY) }
    }

    /// Whether the region contains `x`.
    pub fn contains(&self, x: &[f64]) -> bool {
        x.iter().zip(&self.lower).zip(&self.upper).all(|((x, lower), upper)| lower <= x && x < upper)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use imdp::numeric::{Rational, from_decimal};
    use proptest::prelude::*;

    fn exact(values: &[f64]) -> Vec<Rational> {
        values.iter().map(|&x| from_decimal(x).unwrap()).collect()
    }

    fn grid() -> Grid {
        Grid::new(&exact(&[-3.4, 0.0]), &exact(&[1.0, 0.3]), &[11, 3]).unwrap()
    }

    #[test]
    fn decimals_on_faces_belong_to_the_cell_above() {
        let (grid, lookup) = (grid(), CellLookup::new(&grid()));
        for i in 0..=11 {
            for j in 0..=3 {
                let x = [grid.axes()[0].face(i), grid.axes()[1].face(j)].map(|face| to_f64(&face));
                assert_eq!(lookup.locate(&x), grid.locate(&exact(&x)), "{x:?}");
                let below = [x[0].next_down(), x[1].next_down()];
                assert_eq!(lookup.locate(&below), grid.locate(&exact(&below)), "{below:?}");
            }
        }
        assert_eq!(lookup.locate(&[f64::NAN, 0.1]), None);
        assert_eq!(lookup.locate(&[0.0, f64::INFINITY]), None);
    }

    #[test]
    fn regions_are_half_open() {
        let region = Region { lower: vec![from_decimal(0.1), None], upper: vec![None, from_decimal(0.3)] };
        let lookup = RegionLookup::new(&region);
        assert!(lookup.contains(&[0.1, -1e9]) && lookup.contains(&[1e9, 0.3f64.next_down()]));
        assert!(!lookup.contains(&[0.1f64.next_down(), 0.0]) && !lookup.contains(&[1.0, 0.3]));
    }

    proptest! {
        #[test]
        fn agrees_with_the_exact_grid(x in -4.0f64..2.0, y in -0.1f64..0.4) {
            let grid = grid();
            prop_assert_eq!(CellLookup::new(&grid).locate(&[x, y]), grid.locate(&exact(&[x, y])));
        }
    }
}
