//! The partition, its targets and the boxes of a task.

use super::problem::{Actions, TargetPoints};
use super::values::{count, vector};
use crate::Diagnostic;
use crate::partition::{Grid, GridError, Region};
use imdp::numeric::{Rational, from_decimal, shortest_decimal, to_f64};

/// The box from `lower` to `upper`, cut into equal cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Partition {
    /// The lower corner, `n` numbers.
    pub lower: Vec<f64>,
    /// The upper corner, `n` numbers.
    pub upper: Vec<f64>,
    /// The number of cells in each dimension.
    pub cells: Vec<u32>,
}

/// The points that actions steer to.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum TargetChoice {
    /// The centers of all cells.
    #[default]
    Centers,
    /// The centers of the cells of this grid.
    Grid(Partition),
    /// These points.
    Points(Vec<Vec<f64>>),
}

/// The half-open box `[lower, upper)`; infinite sides are unbounded.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionBox {
    /// The lower corner, `n` numbers, or −∞.
    pub lower: Vec<f64>,
    /// The upper corner, `n` numbers, or +∞.
    pub upper: Vec<f64>,
}

/// A region with a name, not yet checked: a union of shapes.
#[derive(Clone, Debug, PartialEq)]
pub struct RegionParts {
    /// The name.
    pub name: String,
    /// The shapes.
    pub shapes: Vec<ShapeParts>,
}

/// A box or a polytope, not yet checked.
#[derive(Clone, Debug, PartialEq)]
pub enum ShapeParts {
    /// A half-open box.
    Box(RegionBox),
    /// `{x : G x ≤ g}`.
    Polytope {
        /// `G`, one row per half-space.
        normals: Vec<Vec<f64>>,
        /// `g`, one number per half-space.
        offsets: Vec<f64>,
    },
}

impl Partition {
    /// The grid in `n` dimensions.
    pub(super) fn grid(&self, place: &str, n: usize) -> Result<Grid, Diagnostic> {
        let what = "one per dimension of the state";
        let lower = vector(&format!("{place}/lower"), &self.lower, n, what)?;
        let upper = vector(&format!("{place}/upper"), &self.upper, n, what)?;
        if self.cells.len() != n {
            let found = count(self.cells.len(), "number");
            return Err(Diagnostic::at(format!("{place}/cells"), found, format!("{n}, {what}")));
        }
        Grid::new(&lower, &upper, &self.cells).map_err(|error| match error {
            GridError::NoCells { dimension } => {
                let place = format!("{place}/cells/{dimension}");
                Diagnostic::at(place, "0", "at least one cell in every dimension")
            }
            GridError::EmptyAxis { dimension } => {
                let found = format!("lower {} and upper {}", self.lower[dimension], self.upper[dimension]);
                let place = format!("{place}/upper/{dimension}");
                Diagnostic::at(place, found, "lower < upper in every dimension")
            }
            GridError::TooManyCells { cells } => {
                let expected = format!("at most {}: a PRISM model has no more states", Grid::MAX_CELLS);
                Diagnostic::at(format!("{place}/cells"), format!("{cells} cells in all"), expected)
                    .remedy("Use fewer cells in some dimension.")
            }
        })
    }
}

/// The actions of these targets.
pub(super) fn actions(place: &str, targets: &TargetChoice, n: usize) -> Result<Actions, Diagnostic> {
    let points = match targets {
        TargetChoice::Centers => TargetPoints::Centers,
        TargetChoice::Grid(grid) => TargetPoints::Grid(grid.grid(place, n)?),
        TargetChoice::Points(points) if points.is_empty() => {
            return Err(Diagnostic::at(place, "an empty list", "at least one target point"));
        }
        TargetChoice::Points(points) => {
            let what = "one per dimension of the state";
            let exact = points.iter().enumerate().map(|(i, x)| vector(&format!("{place}/{i}"), x, n, what));
            TargetPoints::List(exact.collect::<Result<_, _>>()?)
        }
    };
    Ok(Actions::Targets(points))
}

/// How large cells are: `0.5 × 2`.
pub(super) fn widths(grid: &Grid) -> String {
    let widths: Vec<_> = grid.axes().iter().map(|axis| shortest_decimal(to_f64(axis.width()))).collect();
    widths.join(" × ")
}

/// The regions of a list of boxes in `n` dimensions.
pub(super) fn regions(place: &str, boxes: &[RegionBox], n: usize) -> Result<Vec<Region>, Diagnostic> {
    boxes.iter().enumerate().map(|(i, b)| region(&format!("{place}/{i}"), b, n)).collect()
}

pub(super) fn region(place: &str, given: &RegionBox, n: usize) -> Result<Region, Diagnostic> {
    let side = |name: &str, values: &[f64], unbounded: f64| -> Result<Vec<Option<Rational>>, Diagnostic> {
        if values.len() != n {
            let expected = format!("{n}, one per dimension of the state (null is unbounded)");
            return Err(Diagnostic::at(format!("{place}/{name}"), count(values.len(), "entry"), expected));
        }
        let exact = |(j, &x): (usize, &f64)| match from_decimal(x) {
            None if x != unbounded => {
                let expected = format!("a finite number, or {unbounded} for an unbounded side");
                Err(Diagnostic::at(format!("{place}/{name}/{j}"), x.to_string(), expected))
            }
            exact => Ok(exact),
        };
        values.iter().enumerate().map(exact).collect()
    };
    let lower = side("lower", &given.lower, f64::NEG_INFINITY)?;
    let upper = side("upper", &given.upper, f64::INFINITY)?;
    for j in 0..n {
        if let (Some(low), Some(high)) = (&lower[j], &upper[j])
            && low >= high
        {
            let found = format!("lower {} and upper {} in dimension {}", to_f64(low), to_f64(high), j + 1);
            return Err(Diagnostic::at(place, found, "lower < upper: boxes are half-open, [lower, upper)"));
        }
    }
    Ok(Region { lower, upper })
}
