//! What the controller is to achieve, and what it makes of the cells.

use super::problem::Objective;
use super::regions::{RegionBox, regions, widths};
use crate::Diagnostic;
use crate::memory::Need;
use crate::partition::{CellKind, CellLabels, Grid, NearMiss, Region, first_overlap, near_misses};
use imdp::numeric::{shortest_decimal, to_f64};
use imdp::property::Probability;

/// What is wanted, where, within how many steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// What is wanted.
    pub aim: Aim,
    /// What must be avoided: a union of boxes; a cell counts if it meets one.
    pub unsafe_: Vec<RegionBox>,
    /// The number of original steps.
    pub horizon: Horizon,
    /// The probability that is wanted, if any.
    pub threshold: Option<f64>,
}

/// What is wanted besides safety.
#[derive(Clone, Debug, PartialEq)]
pub enum Aim {
    /// To reach a union of boxes; a cell counts if the union contains it.
    Reach {
        /// The boxes.
        goal: Vec<RegionBox>,
    },
    /// To be in a union of boxes at every step up to the horizon; a cell counts if the union contains it.
    Stay {
        /// The boxes; empty for the whole partition.
        safe: Vec<RegionBox>,
    },
}

/// A number of original steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Horizon {
    /// No limit.
    Infinite,
    /// This many.
    Steps(u64),
}

impl Task {
    /// To reach a union of boxes some time.
    pub fn reach(goal: Vec<RegionBox>) -> Self {
        Self { aim: Aim::Reach { goal }, unsafe_: vec![], horizon: Horizon::Infinite, threshold: None }
    }

    /// To stay in a union of boxes for ever; in the whole partition if there are none.
    pub fn stay(safe: Vec<RegionBox>) -> Self {
        Self { aim: Aim::Stay { safe }, unsafe_: vec![], horizon: Horizon::Infinite, threshold: None }
    }

    /// Avoiding these boxes.
    #[must_use]
    pub fn avoiding(mut self, boxes: Vec<RegionBox>) -> Self {
        self.unsafe_ = boxes;
        self
    }

    /// Within this many original steps.
    #[must_use]
    pub fn within(mut self, steps: u64) -> Self {
        self.horizon = Horizon::Steps(steps);
        self
    }

    /// With at least this probability.
    #[must_use]
    pub fn at_least(mut self, threshold: f64) -> Self {
        self.threshold = Some(threshold);
        self
    }
}

/// A task that fits the partition.
pub(super) struct CheckedTask {
    pub(super) objective: Objective,
    pub(super) unsafe_: Vec<Region>,
    pub(super) labels: CellLabels,
    /// In grouped steps.
    pub(super) horizon: Option<u64>,
    pub(super) threshold: Option<Probability>,
    pub(super) warnings: Vec<String>,
}

impl CheckedTask {
    /// Checks the regions, labels the cells, counts the horizon in groups of `d` steps.
    pub(super) fn new(task: &Task, grid: &Grid, d: usize) -> Result<Self, Diagnostic> {
        let n = grid.dimension();
        let unsafe_ = regions("/task/unsafe", &task.unsafe_, n)?;
        Need::of_cells(grid).check().map_err(|error| Diagnostic::from(&error))?;
        let (objective, labels) = match &task.aim {
            Aim::Reach { goal } => reach(goal, &unsafe_, grid)?,
            Aim::Stay { safe } => stay(safe, &unsafe_, grid)?,
        };
        let mut warnings = Vec::new();
        let wanted = match &objective {
            Objective::Reach { goal } => ("goal", goal),
            Objective::Stay { safe } => ("safe", safe),
        };
        for (name, list) in [wanted, ("unsafe", &unsafe_)] {
            warnings.extend(near_misses(grid, list).iter().map(|miss| near_miss_warning(name, miss)));
        }
        let horizon = horizon(task.horizon, d, &mut warnings)?;
        if d > 1 && !unsafe_.is_empty() {
            warnings.push(format!("the unsafe region is checked every {d} steps, at grouped instants only"));
        }
        let threshold = task.threshold.map(threshold).transpose()?;
        Ok(Self { objective, unsafe_, labels, horizon, threshold, warnings })
    }
}

/// The goal, which must contain a cell.
fn reach(goal: &[RegionBox], unsafe_: &[Region], grid: &Grid) -> Result<(Objective, CellLabels), Diagnostic> {
    let goal = regions("/task/goal", goal, grid.dimension())?;
    if let Some((i, j)) = first_overlap(&goal, unsafe_) {
        let found = format!("box {i} overlaps /task/unsafe/{j}");
        let expected = "goal boxes that meet no unsafe box";
        return Err(Diagnostic::at(format!("/task/goal/{i}"), found, expected)
            .remedy("Cut the overlap out of one of the two; boxes may touch."));
    }
    let labels = CellLabels::new(grid, &goal, unsafe_);
    if labels.count(CellKind::Goal) == 0 {
        let expected = format!("at least one whole cell inside it; cells measure {}", widths(grid));
        return Err(Diagnostic::at("/task/goal", "a goal that contains no cell of the partition", expected)
            .remedy("Enlarge the goal, align its faces with the grid, or use more cells."));
    }
    Ok((Objective::Reach { goal }, labels))
}

/// The region to stay in, which must contain a cell that is not unsafe.
fn stay(safe: &[RegionBox], unsafe_: &[Region], grid: &Grid) -> Result<(Objective, CellLabels), Diagnostic> {
    let safe = regions("/task/safe", safe, grid.dimension())?;
    let labels = CellLabels::staying(grid, &safe, unsafe_);
    if labels.count(CellKind::Ordinary) == 0 {
        let expected = format!("at least one whole cell inside it; cells measure {}", widths(grid));
        return Err(Diagnostic::at(
            "/task/safe",
            "a region that contains no safe cell of the partition",
            expected,
        )
        .remedy("Enlarge the region, align its faces with the grid, or use more cells."));
    }
    Ok((Objective::Stay { safe }, labels))
}

fn horizon(horizon: Horizon, d: usize, warnings: &mut Vec<String>) -> Result<Option<u64>, Diagnostic> {
    let Horizon::Steps(steps) = horizon else { return Ok(None) };
    let (grouped, rest) = (steps / d as u64, steps % d as u64);
    if grouped == 0 {
        let expected = format!("at least {d}, the number of steps that are grouped into one");
        return Err(Diagnostic::at("/task/horizon", steps.to_string(), expected));
    }
    // A property counts steps as PRISM does.
    if i32::try_from(grouped).is_err() {
        let most = i32::MAX as u64 * d as u64;
        let expected =
            format!("at most {most}, which is as many steps as a property can have, or \"infinite\"");
        return Err(Diagnostic::at("/task/horizon", steps.to_string(), expected));
    }
    if rest > 0 {
        let used = grouped * d as u64;
        warnings.push(format!(
            "/task/horizon: {steps} steps are {grouped} groups of {d}; the guarantee is for the first {used}"
        ));
    }
    Ok(Some(grouped))
}

fn threshold(threshold: f64) -> Result<Probability, Diagnostic> {
    Probability::from_f64(threshold)
        .map_err(|_| Diagnostic::at("/task/threshold", threshold.to_string(), "a probability in [0, 1]"))
}

fn near_miss_warning(name: &str, miss: &NearMiss) -> String {
    format!(
        "/task/{name}/{}: the face at {} in dimension {} is {:.1e} cell widths from the grid face {} but not on \
         it; if they are meant to coincide, write the same number",
        miss.region,
        shortest_decimal(miss.face),
        miss.dimension + 1,
        miss.distance,
        shortest_decimal(to_f64(&miss.grid_face)),
    )
}
