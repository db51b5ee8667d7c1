//! The partition, its targets and the regions of the task.

use super::values::{count, vector};
use super::{Diagnostic, GridSpec, RegionSpec, TargetsSpec, TaskSpec, UnsafeSpec};
use crate::Warning;
use crate::partition::{CellKind, CellLabels, Grid, GridError, Region, first_overlap, near_misses};
use imdp::numeric::{Rational, from_decimal, shortest_decimal, to_f64};

use super::problem::TargetPoints;

/// A grid in `n` dimensions.
pub(super) fn grid(place: &str, spec: &GridSpec, n: usize) -> Result<Grid, Diagnostic> {
    let what = "one per dimension of the state";
    let lower = vector(&format!("{place}/lower"), &spec.lower, n, what)?;
    let upper = vector(&format!("{place}/upper"), &spec.upper, n, what)?;
    if spec.cells.len() != n {
        let found = count(spec.cells.len(), "number");
        return Err(Diagnostic::at(format!("{place}/cells"), found, format!("{n}, {what}")));
    }
    Grid::new(&lower, &upper, &spec.cells).map_err(|error| match error {
        GridError::NoCells { dimension } => {
            Diagnostic::at(format!("{place}/cells/{dimension}"), "0", "at least one cell in every dimension")
        }
        GridError::EmptyAxis { dimension } => {
            let found = format!("lower {} and upper {}", spec.lower[dimension], spec.upper[dimension]);
            Diagnostic::at(format!("{place}/upper/{dimension}"), found, "lower < upper in every dimension")
        }
        GridError::TooManyCells { cells } => {
            let expected = format!("at most {}: a PRISM model has no more states", Grid::MAX_CELLS);
            Diagnostic::at(format!("{place}/cells"), format!("{cells} cells in all"), expected)
                .remedy("Use fewer cells in some dimension.")
        }
    })
}

/// The target points.
pub(super) fn targets(place: &str, spec: &TargetsSpec, n: usize) -> Result<TargetPoints, Diagnostic> {
    match spec {
        TargetsSpec::Centers => Ok(TargetPoints::Centers),
        TargetsSpec::Grid(spec) => grid(place, spec, n).map(TargetPoints::Grid),
        TargetsSpec::Points(points) if points.is_empty() => {
            Err(Diagnostic::at(place, "an empty list", "at least one target point"))
        }
        TargetsSpec::Points(points) => {
            let what = "one per dimension of the state";
            let exact = points.iter().enumerate().map(|(i, x)| vector(&format!("{place}/{i}"), x, n, what));
            exact.collect::<Result<_, _>>().map(TargetPoints::List)
        }
    }
}

/// Goal and unsafe regions and what they make of the cells, with warnings.
pub(super) struct TaskRegions {
    pub(super) goal: Vec<Region>,
    pub(super) unsafe_: Vec<Region>,
    pub(super) outside_is_unsafe: bool,
    pub(super) labels: CellLabels,
    pub(super) warnings: Vec<Warning>,
}

/// Reads the regions of a task and labels the cells.
pub(super) fn task_regions(spec: &TaskSpec, grid: &Grid) -> Result<TaskRegions, Diagnostic> {
    let n = grid.dimension();
    let goal = (spec.goal.iter().enumerate())
        .map(|(i, spec)| region(&format!("/task/goal/{i}"), spec, n))
        .collect::<Result<Vec<_>, _>>()?;
    let (mut unsafe_, mut places, mut outside_is_unsafe) = (vec![], vec![], false);
    for (i, spec) in spec.unsafe_.iter().enumerate() {
        match spec {
            UnsafeSpec::Outside => outside_is_unsafe = true,
            UnsafeSpec::Region(spec) => {
                unsafe_.push(region(&format!("/task/unsafe/{i}"), spec, n)?);
                places.push(i);
            }
        }
    }
    if let Some((i, j)) = first_overlap(&goal, &unsafe_) {
        let found = format!("box {i} overlaps /task/unsafe/{}", places[j]);
        return Err(Diagnostic::at(format!("/task/goal/{i}"), found, "goal boxes that meet no unsafe box")
            .remedy("Cut the overlap out of one of the two; boxes may touch."));
    }
    let labels = CellLabels::new(grid, &goal, &unsafe_);
    if labels.count(CellKind::Goal) == 0 {
        return Err(Diagnostic::at(
            "/task/goal",
            "a goal that contains no cell of the partition",
            format!("at least one whole cell inside it; cells measure {}", widths(grid)),
        )
        .remedy("Enlarge the goal, align its faces with the grid, or use more cells."));
    }
    let mut warnings = Vec::new();
    for (name, list) in [("goal", &goal), ("unsafe", &unsafe_)] {
        let warning = |miss| Warning::NearMiss { list: name, miss };
        warnings.extend(near_misses(grid, list).into_iter().map(warning));
    }
    Ok(TaskRegions { goal, unsafe_, outside_is_unsafe, labels, warnings })
}

fn widths(grid: &Grid) -> String {
    let widths: Vec<_> = grid.axes().iter().map(|axis| shortest_decimal(to_f64(axis.width()))).collect();
    widths.join(" × ")
}

fn region(place: &str, spec: &RegionSpec, n: usize) -> Result<Region, Diagnostic> {
    let side = |name: &str, values: &[Option<f64>]| -> Result<Vec<Option<Rational>>, Diagnostic> {
        if values.len() != n {
            let expected = format!("{n}, one per dimension of the state (null is unbounded)");
            return Err(Diagnostic::at(format!("{place}/{name}"), count(values.len(), "entry"), expected));
        }
        Ok(values.iter().map(|x| x.and_then(from_decimal)).collect())
    };
    let (lower, upper) = (side("lower", &spec.lower)?, side("upper", &spec.upper)?);
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
