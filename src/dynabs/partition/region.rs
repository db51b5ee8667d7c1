//! Regions: half-open boxes with possibly unbounded sides.

use super::Grid;
use imdp::numeric::{Rational, to_f64};
use num_traits::{One, Signed, ToPrimitive, Zero};

/// The box `{x : lower_j ≤ x_j < upper_j}`; a missing side is unbounded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Region {
    /// The lower side per dimension; `None` is −∞.
    pub lower: Vec<Option<Rational>>,
    /// The upper side per dimension; `None` is +∞.
    pub upper: Vec<Option<Rational>>,
}

/// A region's face that lies next to a face of the grid without being on it.
#[derive(Clone, Debug, PartialEq)]
pub struct NearMiss {
    /// Which region of the list.
    pub region: usize,
    /// Which dimension.
    pub dimension: usize,
    /// Where the region's face is.
    pub face: f64,
    /// The grid's face next to it, as `p/q`.
    pub grid_face: Rational,
    /// How far apart they are, in cell widths.
    pub distance: f64,
}

impl Region {
    /// Whether the two boxes have a point in common.
    fn meets(&self, other: &Self) -> bool {
        let below = |lower: &Option<Rational>, upper: &Option<Rational>| match (lower, upper) {
            (Some(lower), Some(upper)) => lower < upper,
            _ => true,
        };
        (0..self.lower.len())
            .all(|j| below(&self.lower[j], &other.upper[j]) && below(&other.lower[j], &self.upper[j]))
    }
}

/// The first pair (index in `a`, index in `b`) of boxes that have a point in common.
pub fn first_overlap(a: &[Region], b: &[Region]) -> Option<(usize, usize)> {
    a.iter().enumerate().find_map(|(i, x)| b.iter().position(|y| x.meets(y)).map(|j| (i, j)))
}

/// The faces of `regions` that are within `1e-9` cell widths of a face of the grid but not on it.
///
/// Nearly always a rounded constant where a face was meant; it decides whether a whole layer of cells
/// counts.
pub fn near_misses(grid: &Grid, regions: &[Region]) -> Vec<NearMiss> {
    let tolerance = Rational::new(1.into(), 1_000_000_000.into());
    let mut misses = Vec::new();
    for (index, region) in regions.iter().enumerate() {
        for (dimension, axis) in grid.axes().iter().enumerate() {
            for face in [&region.lower[dimension], &region.upper[dimension]].into_iter().flatten() {
                let position = axis.position(face);
                let nearest = (&position + Rational::new(1.into(), 2.into())).floor();
                let distance = (position - &nearest).abs();
                let on_grid = nearest.to_u32().filter(|&i| i <= axis.cells());
                let Some(i) = on_grid.filter(|_| !distance.is_zero() && distance < tolerance) else {
                    continue;
                };
                debug_assert!(distance < Rational::one());
                misses.push(NearMiss {
                    region: index,
                    dimension,
                    face: to_f64(face),
                    grid_face: axis.face(i),
                    distance: to_f64(&distance),
                });
            }
        }
    }
    misses
}
