//! Uniform rectangular grids with exact faces.

use imdp::numeric::{Rational, to_f64};
use num_bigint::BigInt;
use num_traits::{Signed, ToPrimitive, Zero};

/// A cell of a [`Grid`]: its row-major index, the last dimension varying fastest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CellId(pub u32);

impl CellId {
    /// The index as a position in a per-cell table.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// One dimension of a grid: `[lower, upper)` cut into equal cells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GridAxis {
    lower: Rational,
    upper: Rational,
    width: Rational,
    cells: u32,
}

impl GridAxis {
    /// The number of cells.
    pub fn cells(&self) -> u32 {
        self.cells
    }

    /// The lower end.
    pub fn lower(&self) -> &Rational {
        &self.lower
    }

    /// The upper end.
    pub fn upper(&self) -> &Rational {
        &self.upper
    }

    /// The width of a cell, `(upper − lower) / cells`.
    pub fn width(&self) -> &Rational {
        &self.width
    }

    /// Face `i`, `lower + i · width`, for `0 ≤ i ≤ cells`.
    pub fn face(&self, i: u32) -> Rational {
        &self.lower + &self.width * Rational::from_integer(i.into())
    }

    /// The center of cell `i`, `lower + (i + ½) · width`.
    pub fn center(&self, i: u32) -> Rational {
        &self.lower + &self.width * Rational::new((2 * u64::from(i) + 1).into(), 2.into())
    }

    /// `(x − lower) / width`: the position of `x` counted in cells.
    pub fn position(&self, x: &Rational) -> Rational {
        (x - &self.lower) / &self.width
    }

    /// The cell that contains `x`, or `None` outside `[lower, upper)`.
    pub fn locate(&self, x: &Rational) -> Option<u32> {
        let index: BigInt = self.position(x).floor().to_integer();
        index.to_u32().filter(|&i| i < self.cells)
    }

    /// The centers of all cells, each rounded to the nearest double.
    pub fn centers(&self) -> Vec<f64> {
        (0..self.cells).map(|i| to_f64(&self.center(i))).collect()
    }

    /// `max |x|` over the axis.
    pub fn magnitude(&self) -> f64 {
        to_f64(&self.lower.abs()).max(to_f64(&self.upper.abs())).next_up()
    }
}

/// A box `[lower, upper) ⊂ ℝⁿ` cut into equal half-open cells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Grid {
    axes: Vec<GridAxis>,
    /// How far apart in row-major order two neighbours in each dimension are.
    strides: Vec<u32>,
    num_cells: u32,
}

/// Why a grid cannot be built; `dimension` counts from 0.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GridError {
    /// A dimension has no cells.
    #[error("dimension {dimension}: found no cells; expected at least one")]
    NoCells {
        /// Which dimension.
        dimension: usize,
    },
    /// `lower < upper` does not hold.
    #[error(
        "dimension {dimension}: found a lower side that is not below the upper one; expected one that is"
    )]
    EmptyAxis {
        /// Which dimension.
        dimension: usize,
    },
    /// The number of cells is beyond what PRISM and this tool can number.
    #[error("found {cells} cells; expected at most {limit}, which can be numbered", limit = Grid::MAX_CELLS)]
    TooManyCells {
        /// The product of the numbers of cells.
        cells: BigInt,
    },
}

impl Grid {
    /// The largest number of cells: with the special states it stays a 32-bit signed count.
    pub const MAX_CELLS: u32 = i32::MAX as u32 - 3;

    /// The grid over `[lower, upper)` with `cells[j]` cells in dimension `j`.
    ///
    /// # Errors
    /// [`GridError`] if a dimension is empty or there are too many cells.
    pub fn new(lower: &[Rational], upper: &[Rational], cells: &[u32]) -> Result<Self, GridError> {
        assert!(lower.len() == cells.len() && upper.len() == cells.len(), "one entry per dimension");
        let mut axes = Vec::with_capacity(cells.len());
        for (dimension, &cells) in cells.iter().enumerate() {
            let (lower, upper) = (lower[dimension].clone(), upper[dimension].clone());
            if cells == 0 {
                return Err(GridError::NoCells { dimension });
            }
            if lower >= upper {
                return Err(GridError::EmptyAxis { dimension });
            }
            let width = (&upper - &lower) / Rational::from_integer(cells.into());
            axes.push(GridAxis { lower, upper, width, cells });
        }
        let product: BigInt = cells.iter().map(|&n| BigInt::from(n)).product();
        let num_cells = product.to_u32().filter(|&n| n <= Self::MAX_CELLS);
        let num_cells = num_cells.ok_or(GridError::TooManyCells { cells: product })?;
        let mut strides = vec![1; axes.len()];
        for j in (1..axes.len()).rev() {
            strides[j - 1] = strides[j] * axes[j].cells;
        }
        Ok(Self { axes, strides, num_cells })
    }

    /// The number of dimensions, `n`.
    pub fn dimension(&self) -> usize {
        self.axes.len()
    }

    /// The number of cells.
    pub fn num_cells(&self) -> u32 {
        self.num_cells
    }

    /// The axes.
    pub fn axes(&self) -> &[GridAxis] {
        &self.axes
    }

    /// How far apart in row-major order two neighbours in each dimension are.
    pub fn strides(&self) -> &[u32] {
        &self.strides
    }

    /// The index of a cell in dimension `j`.
    pub fn coordinate(&self, cell: CellId, j: usize) -> u32 {
        cell.0 / self.strides[j] % self.axes[j].cells
    }

    /// The indices of a cell in every dimension.
    pub fn coordinates(&self, cell: CellId) -> Vec<u32> {
        (0..self.dimension()).map(|j| self.coordinate(cell, j)).collect()
    }

    /// The cell with these indices.
    pub fn cell(&self, coordinates: &[u32]) -> CellId {
        CellId(coordinates.iter().zip(&self.strides).map(|(i, stride)| i * stride).sum())
    }

    /// The cell that contains `x`, or `None` outside the grid.
    pub fn locate(&self, x: &[Rational]) -> Option<CellId> {
        let coordinates: Option<Vec<_>> = self.axes.iter().zip(x).map(|(axis, x)| axis.locate(x)).collect();
        coordinates.map(|coordinates| self.cell(&coordinates))
    }

    /// `max |x_j|` over the grid, per dimension.
    pub fn magnitudes(&self) -> Vec<f64> {
        self.axes.iter().map(GridAxis::magnitude).collect()
    }

    /// The width of a cell, per dimension.
    pub fn widths(&self) -> Vec<f64> {
        self.axes.iter().map(|axis| to_f64(axis.width())).collect()
    }

    /// Whether every cell is as wide as those of `other`, whose faces these are multiples of: then each
    /// center here sits at the same relative place of a cell there.
    ///
    /// Returns, per dimension, the first center's position in cells of `other` and the spacing in whole
    /// cells of `other`; `None` if the spacing is not a whole number of cells or centers leave `other`.
    pub fn lattice_in(&self, other: &Self) -> Option<Vec<(Rational, u32)>> {
        let dimensions = self.axes.iter().zip(&other.axes);
        dimensions
            .map(|(own, other)| {
                let stride = own.width() / other.width();
                let first = other.position(&own.center(0));
                let last = other.position(&own.center(own.cells - 1));
                let inside = !first.is_negative() && last < Rational::from_integer(other.cells.into());
                let whole = stride.is_integer() && !stride.is_zero();
                (inside && whole).then(|| stride.to_integer().to_u32().map(|stride| (first, stride)))?
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use imdp::numeric::from_decimal;

    fn exact(values: &[f64]) -> Vec<Rational> {
        values.iter().map(|&x| from_decimal(x).unwrap()).collect()
    }

    #[test]
    fn faces_are_exact() {
        // In doubles −3.4 + 8·0.4 is −0.19999999999999973; the benchmark's goal starts at −0.2.
        let grid = Grid::new(&exact(&[-3.4]), &exact(&[1.0]), &[11]).unwrap();
        assert_eq!(grid.axes()[0].face(8), from_decimal(-0.2).unwrap());
        assert_eq!(grid.axes()[0].face(11), from_decimal(1.0).unwrap());
        assert_eq!(grid.axes()[0].center(8), from_decimal(0.0).unwrap());
    }

    #[test]
    fn numbering_is_row_major() {
        let grid = Grid::new(&exact(&[0.0, 0.0]), &exact(&[2.0, 3.0]), &[2, 3]).unwrap();
        assert_eq!(grid.cell(&[1, 2]), CellId(5));
        assert_eq!(grid.coordinates(CellId(4)), [1, 1]);
        assert_eq!(grid.locate(&exact(&[1.0, 0.0])), Some(CellId(3)));
        assert_eq!(grid.locate(&exact(&[2.0, 0.0])), None);
    }

    #[test]
    fn impossible_grids() {
        let (zero, one) = (exact(&[0.0, 0.0]), exact(&[1.0, 1.0]));
        assert_eq!(Grid::new(&zero, &one, &[2, 0]), Err(GridError::NoCells { dimension: 1 }));
        assert_eq!(Grid::new(&one, &one, &[2, 2]), Err(GridError::EmptyAxis { dimension: 0 }));
        assert!(matches!(Grid::new(&zero, &one, &[1 << 20, 1 << 20]), Err(GridError::TooManyCells { .. })));
    }

    #[test]
    fn target_lattices() {
        let grid = Grid::new(&exact(&[0.0]), &exact(&[10.0]), &[10]).unwrap();
        let inner = Grid::new(&exact(&[1.0]), &exact(&[9.0]), &[4]).unwrap();
        assert_eq!(inner.lattice_in(&grid), Some(vec![(from_decimal(2.0).unwrap(), 2)]));
        let finer = Grid::new(&exact(&[0.0]), &exact(&[10.0]), &[20]).unwrap();
        assert_eq!(finer.lattice_in(&grid), None);
    }
}
