//! What the controller is to achieve, and what it makes of the cells.

use super::problem::Objective;
use super::regions::{RegionBox, region, regions, widths};
use super::{Probabilities, StepNoise};
use crate::guarantee::Safety;
use crate::memory::Need;
use crate::partition::{CellKind, CellLabels, Grid, Region, first_overlap, near_misses};
use crate::{Diagnostic, Warning};
use imdp::property::Probability;

/// What is wanted, where, within how many steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// What is wanted.
    pub aim: Aim,
    /// What must be avoided.
    pub unsafe_: Vec<Hazard>,
    /// The number of original steps.
    pub horizon: Horizon,
    /// The probability that is wanted, if any.
    pub threshold: Option<f64>,
    /// When, with grouped steps, the unsafe region must be avoided: by default at every step, if the samples are of steps.
    pub check: Option<Safety>,
}

/// Something that must be avoided.
#[derive(Clone, Debug, PartialEq)]
pub enum Hazard {
    /// A box; a cell counts if it meets one.
    Box(RegionBox),
    /// Everything outside the partition: between grouped steps too.
    Outside,
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
        Self {
            aim: Aim::Reach { goal },
            unsafe_: vec![],
            horizon: Horizon::Infinite,
            threshold: None,
            check: None,
        }
    }

    /// To stay in a union of boxes for ever; in the whole partition if there are none.
    pub fn stay(safe: Vec<RegionBox>) -> Self {
        Self { aim: Aim::Stay { safe }, ..Self::reach(vec![]) }
    }

    /// Avoiding these boxes too.
    #[must_use]
    pub fn avoiding(mut self, boxes: Vec<RegionBox>) -> Self {
        self.unsafe_.extend(boxes.into_iter().map(Hazard::Box));
        self
    }

    /// Avoiding everything outside the partition too.
    #[must_use]
    pub fn avoiding_outside(mut self) -> Self {
        self.unsafe_.push(Hazard::Outside);
        self
    }

    /// With safety meant like this where steps are grouped.
    #[must_use]
    pub fn checked(mut self, safety: Safety) -> Self {
        self.check = Some(safety);
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
    pub(super) outside_is_unsafe: bool,
    pub(super) labels: CellLabels,
    /// In grouped steps.
    pub(super) horizon: Option<u64>,
    pub(super) threshold: Option<Probability>,
    pub(super) warnings: Vec<Warning>,
}

impl CheckedTask {
    /// Checks the regions, labels the cells, counts the horizon in groups of `d` steps.
    pub(super) fn new(task: &Task, grid: &Grid, d: usize) -> Result<Self, Diagnostic> {
        let n = grid.dimension();
        let (mut unsafe_, mut places, mut outside_is_unsafe) = (vec![], vec![], false);
        for (i, hazard) in task.unsafe_.iter().enumerate() {
            match hazard {
                Hazard::Outside => outside_is_unsafe = true,
                Hazard::Box(sides) => {
                    unsafe_.push(region(&format!("/task/unsafe/{i}"), sides, n)?);
                    places.push(i);
                }
            }
        }
        Need::of_cells(grid).check().map_err(|error| Diagnostic::from(&error))?;
        let (objective, labels) = match &task.aim {
            Aim::Reach { goal } => reach(goal, (&unsafe_, &places), grid)?,
            Aim::Stay { safe } => stay(safe, &unsafe_, grid)?,
        };
        let mut warnings = Vec::new();
        let wanted = match &objective {
            Objective::Reach { goal } => ("goal", goal),
            Objective::Stay { safe } => ("safe", safe),
        };
        for (name, list) in [wanted, ("unsafe", &unsafe_)] {
            let warning = |miss| Warning::NearMiss { list: name, miss };
            warnings.extend(near_misses(grid, list).into_iter().map(warning));
        }
        let horizon = horizon(task.horizon, d, &mut warnings)?;
        let threshold = task.threshold.map(threshold).transpose()?;
        Ok(Self { objective, unsafe_, outside_is_unsafe, labels, horizon, threshold, warnings })
    }
}

/// When the unsafe region is avoided, if `check` was asked for and `d` steps are grouped.
pub(super) fn safety(
    check: Option<Safety>,
    d: usize,
    noise: &StepNoise,
    probabilities: &Probabilities,
) -> Result<Safety, Diagnostic> {
    if d == 1 {
        return Ok(Safety::EveryStep);
    }
    let impossible = |found: &str, expected: &str| Err(Diagnostic::at("/task/check", found, expected));
    let is_reference = matches!(probabilities, Probabilities::Reference { .. });
    match (check, noise) {
        (Some(Safety::EveryStep), _) if is_reference => impossible(
            "\"every_step\" in mode \"reference\"",
            "\"grouped\" there: the published tool looks no closer",
        ),
        (Some(Safety::EveryStep), StepNoise::Unknown) => impossible(
            "\"every_step\" with samples of \"grouped\" steps, which say nothing about those in between",
            "samples of one \"step\", or \"grouped\"",
        ),
        (Some(Safety::GroupedInstants), _) | (None, StepNoise::Unknown) => Ok(Safety::GroupedInstants),
        (None, _) if is_reference => Ok(Safety::GroupedInstants),
        (None | Some(Safety::EveryStep), _) => Ok(Safety::EveryStep),
    }
}

/// The goal, which must contain a cell.
fn reach(
    goal: &[RegionBox],
    (unsafe_, places): (&[Region], &[usize]),
    grid: &Grid,
) -> Result<(Objective, CellLabels), Diagnostic> {
    let goal = regions("/task/goal", goal, grid.dimension())?;
    if let Some((i, j)) = first_overlap(&goal, unsafe_) {
        let found = format!("box {i} overlaps /task/unsafe/{}", places[j]);
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

fn horizon(horizon: Horizon, d: usize, warnings: &mut Vec<Warning>) -> Result<Option<u64>, Diagnostic> {
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
        warnings.push(Warning::CutHorizon { steps, used: grouped * d as u64, group_steps: d });
    }
    Ok(Some(grouped))
}

fn threshold(threshold: f64) -> Result<Probability, Diagnostic> {
    Probability::from_f64(threshold)
        .map_err(|_| Diagnostic::at("/task/threshold", threshold.to_string(), "a probability in [0, 1]"))
}
