//! How noise becomes cells: where `d + δ` lies, counted from an origin cell.

use super::cell_box::CellBox;
use super::targets::Alignment;
use crate::noise::NoiseSample;
use crate::partition::Grid;
use imdp::numeric::{UNIT_ROUNDOFF, to_f64};

/// The map from noise to cell coordinates for one target, or for all that sit alike in their cells.
#[derive(Clone, Debug)]
pub struct Placement {
    axes: Vec<AxisPlacement>,
}

/// One dimension of a [`Placement`].
#[derive(Clone, Debug)]
struct AxisPlacement {
    width: f64,
    /// The target's position, in cells.
    shift: f64,
    lowest: i32,
    highest: i32,
    /// How far `d_a + η` can be from its value, apart from the error of `η`; `None` takes the arithmetic at its word.
    tolerance: Option<f64>,
}

impl Placement {
    /// Coordinates relative to the cell of `d_a`, for targets that all sit alike in their cells.
    ///
    /// With `φ` the target's position in its cell and `w` the width, `δ` moves `⌊δ/w + φ⌋` cells. `tolerance`
    /// bounds, per dimension, how far the state can be from `d_a + η`; samples closer to a face than that and their
    /// own error (plus the rounding made here) may be on either side. Coordinates beyond the grid
    /// from every target are cut off just outside it.
    pub fn of_offsets(
        grid: &Grid,
        alignment: &[Alignment],
        last_cells: &[u32],
        tolerance: Option<&[f64]>,
    ) -> Self {
        let axis = |j: usize| AxisPlacement {
            width: width(grid, j),
            shift: to_f64(&alignment[j].phase),
            lowest: -(last_cells[j] as i32) - 1,
            highest: grid.axes()[j].cells() as i32 - alignment[j].first_cell as i32,
            tolerance: tolerance.map(|t| t[j]),
        };
        Self { axes: (0..grid.dimension()).map(axis).collect() }
    }

    /// Coordinates in the grid, for one target point anywhere.
    pub fn of_point(grid: &Grid, point: &[f64], tolerance: Option<&[f64]>) -> Self {
        let axis = |j: usize| {
            let width = width(grid, j);
            let lower = to_f64(grid.axes()[j].lower());
            let offset = 2.0 * UNIT_ROUNDOFF * (point[j].abs() + lower.abs());
            AxisPlacement {
                width,
                shift: (point[j] - lower) / width,
                lowest: -1,
                highest: grid.axes()[j].cells() as i32,
                tolerance: tolerance.map(|t| t[j] + offset),
            }
        };
        Self { axes: (0..grid.dimension()).map(axis).collect() }
    }

    /// The cells in which noise `δ` may put the state.
    pub fn spread(&self, noise: NoiseSample<'_>) -> CellBox {
        let along = |(j, axis): (usize, &AxisPlacement)| axis.spread(noise.value(j), noise.error(j));
        let (lower, upper) = self.axes.iter().enumerate().map(along).unzip();
        CellBox { lower, upper }
    }

    /// The cells that some noise between `lower` and `upper` may put the state in.
    pub fn spread_of_box(&self, lower: &[f64], upper: &[f64]) -> CellBox {
        let spread = |noise| self.spread(NoiseSample::exact(noise));
        CellBox { lower: spread(lower).lower, upper: spread(upper).upper }
    }

    /// The noise, in dimension `j`, that it takes at least to move to coordinate `o`: 0 if none.
    ///
    /// Rounded, and without tolerances: a measure of distance, not a bound.
    pub fn distance(&self, j: usize, o: i32, from: f64) -> f64 {
        let axis = &self.axes[j];
        let face = |i: f64| (i - axis.shift) * axis.width;
        let (below, above) = (face(f64::from(o)), face(f64::from(o) + 1.0));
        (below - from).max(from - above).max(0.0)
    }

    /// The least and the greatest coordinate in dimension `j` that are told apart.
    pub fn extent(&self, j: usize) -> (i32, i32) {
        (self.axes[j].lowest, self.axes[j].highest)
    }
}

/// The width of cells; no number if it is beyond doubles, so that nobody takes noise for small beside it.
fn width(grid: &Grid, j: usize) -> f64 {
    let width = to_f64(grid.axes()[j].width());
    if width.is_finite() { width } else { f64::NAN }
}

impl AxisPlacement {
    /// The least and the greatest coordinate for noise `x ± error`; all of them if that is no number.
    fn spread(&self, x: f64, error: f64) -> (i32, i32) {
        let position = x / self.width + self.shift;
        let slack = self.tolerance.map_or(0.0, |tolerance| {
            let rounding = 8.0 * UNIT_ROUNDOFF * ((x / self.width).abs() + self.shift.abs() + 1.0);
            2.0 * (tolerance + error) / self.width + rounding
        });
        (
            self.coordinate(position - slack).unwrap_or(self.lowest),
            self.coordinate(position + slack).unwrap_or(self.highest),
        )
    }

    /// The coordinate at a position; none for what is no number, which a cast would take for 0.
    fn coordinate(&self, position: f64) -> Option<i32> {
        // Casting saturates, so samples beyond any grid stay beyond it.
        (!position.is_nan()).then(|| (position.floor() as i32).clamp(self.lowest, self.highest))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use imdp::numeric::from_decimal;

    #[test]
    fn what_is_no_number_may_be_anywhere() {
        let exact = |x: f64| vec![from_decimal(x).unwrap()];
        let grid = Grid::new(&exact(-1.7e308), &exact(1.7e308), &[1]).unwrap();
        let spread = Placement::of_point(&grid, &[0.0], Some(&[0.0])).spread(NoiseSample::exact(&[0.0]));
        assert_eq!((spread.lower, spread.upper), (vec![-1], vec![1]));
        let axis = AxisPlacement { width: 2.0, shift: 0.5, lowest: -3, highest: 4, tolerance: Some(1e-12) };
        assert_eq!(axis.spread(2.0, 0.0), (1, 1));
        assert_eq!(axis.spread(3.0, 1e-13), (1, 2));
        assert_eq!(axis.spread(1e155, 1e139), (4, 4));
        for (x, error) in
            [(f64::NAN, 0.0), (f64::INFINITY, f64::INFINITY), (0.0, f64::NAN), (1.0, f64::INFINITY)]
        {
            assert_eq!(axis.spread(x, error), (-3, 4), "{x} {error}");
        }
    }
}
