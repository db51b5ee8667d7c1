//! A task checked, and what it makes of the cells.

use super::automaton::{automaton, named_regions};
use super::problem::Objective;
use super::regions::{RegionBox, region, regions, widths};
use super::task::{Hazard, Horizon, Logic, Task, Wanted};
use super::{PlantNoise, Probabilities, StepNoise};
use crate::memory::Need;
use crate::partition::{CellId, CellKind, CellLabels, Grid, Region, first_overlap, near_misses};
use crate::task::{self, AutomatonTask, CellTask, NamedRegion, Safety, Shape, Straddling};
use crate::{Diagnostic, Warning};
use imdp::automaton::Dfa;
use imdp::property::Probability;

/// A task that fits the partition.
pub(super) struct CheckedTask {
    pub(super) objective: Objective,
    pub(super) unsafe_: Vec<Region>,
    pub(super) outside_is_unsafe: bool,
    pub(super) labels: CellLabels,
    pub(super) cell_task: CellTask,
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
        let objective = match &task.aim {
            Wanted::Reach { goal } => Objective::Reach { goal: reach(goal, (&unsafe_, &places), grid)? },
            Wanted::Stay { safe } => Objective::Stay { safe: stay(safe, &unsafe_, grid)? },
            Wanted::ReachAt { goal } => {
                let goal = reach(goal, (&unsafe_, &places), grid)?;
                Objective::Automaton(Box::new(at_step(goal, &unsafe_, task.horizon)?))
            }
            over_regions => {
                let named = named_regions(&task.regions, n)?;
                Objective::Automaton(Box::new(automaton(over_regions, task.horizon, &named, &unsafe_)?))
            }
        };
        let mut warnings = Vec::new();
        let wanted = match &objective {
            Objective::Reach { goal } => vec![("/task/goal".to_owned(), goal.clone())],
            Objective::Stay { safe } => vec![("/task/safe".to_owned(), safe.clone())],
            Objective::Automaton(task) => {
                let regions = task.regions().iter().filter(|region| region.name != "unsafe");
                regions.map(|region| (format!("/regions/{}", region.name), region.boxes())).collect()
            }
        };
        for (list, regions) in wanted.into_iter().chain([("/task/unsafe".to_owned(), unsafe_.clone())]) {
            let warning = |miss| Warning::NearMiss { list: list.clone(), miss };
            warnings.extend(near_misses(grid, &regions).into_iter().map(warning));
        }
        let (labels, cell_task) = cell_task(&objective, &unsafe_, grid)?;
        require_numbers(&cell_task, task.horizon)?;
        let horizon = horizon(task.horizon, d, &mut warnings)?;
        let threshold = task.threshold.map(threshold).transpose()?;
        Ok(Self { objective, unsafe_, outside_is_unsafe, labels, cell_task, horizon, threshold, warnings })
    }
}

/// That actions which steer to targets, for `d` steps at once, can be asked for a task.
pub(super) fn require_steerable(
    task: &Task,
    d: usize,
    probabilities: &Probabilities,
) -> Result<(), Diagnostic> {
    let is_grouped = task.check == Some(Safety::GroupedInstants);
    let every = format!("what is the case at the end of every {d} steps only");
    match &task.aim {
        Wanted::Reach { .. } => return Ok(()),
        _ if matches!(probabilities, Probabilities::Reference { .. }) => {
            let found = "a task that is not to reach a goal, in mode \"reference\"";
            return Err(Diagnostic::at(
                "/task/type",
                found,
                "\"reach\" there: the published tool has no other",
            ));
        }
        Wanted::Stay { safe } => {
            let in_partition = safe.is_empty() && task.unsafe_.contains(&Hazard::Outside);
            if d == 1 || in_partition || is_grouped {
                return Ok(());
            }
            let found = format!("a region to stay in at the end of every {d} steps only");
            return Err(Diagnostic::at("/task/safe", found, "the whole partition, at every step").remedy(
                "Leave \"safe\" out, list \"outside\" and what lies around the region as unsafe, or accept \"check\": \"grouped\".",
            ));
        }
        Wanted::ReachAt { .. } => {}
        // Who has come somewhere at the end of a group has come there.
        Wanted::Sequence { legs } if legs.iter().all(|leg| leg.avoid.is_empty()) => {}
        _ if d == 1 || is_grouped => {}
        Wanted::Sequence { .. } => {
            let found = format!("regions to avoid, which are known as {every}");
            return Err(Diagnostic::at("/task/sequence", found, "regions to come to").remedy(
                "List what is to be avoided on all of the way as unsafe, accept \"check\": \"grouped\", or use \"actions\": \
                 \"inputs\", which look at every step.",
            ));
        }
        Wanted::Formula { .. } | Wanted::Automaton { .. } => {
            let expected = "a task that looks at every step, which one step of the model must be";
            return Err(Diagnostic::at("/task/type", every, expected).remedy(
                "Accept \"check\": \"grouped\", or use \"actions\": \"inputs\", which look at every step.",
            ));
        }
    }
    let ends = matches!(task.aim, Wanted::ReachAt { .. } | Wanted::Formula { logic: Logic::Ltlf, .. });
    match task.horizon {
        Horizon::Steps(steps) if ends && !steps.is_multiple_of(d as u64) => Err(Diagnostic::at(
            "/task/horizon",
            steps.to_string(),
            format!("a multiple of {d}, the number of steps that are grouped into one: the last one decides"),
        )),
        _ => Ok(()),
    }
}

/// The task with the worst standing in every cell.
pub(super) fn at_worst(task: &CheckedTask) -> Result<CellTask, Diagnostic> {
    task.cell_task.at_worst(task.horizon).map_err(|Straddling { cell, regions }| {
        let of_task = match &task.objective {
            Objective::Automaton(task) => task.regions(),
            Objective::Reach { .. } | Objective::Stay { .. } => &[],
        };
        let cut = of_task.iter().enumerate().filter(|(bit, _)| regions >> bit & 1 == 1);
        let names: Vec<_> = cut.map(|(_, region)| region.name.as_str()).collect();
        let found = format!(
            "cell {}, which the face of {} cuts: whether it is worse to be inside or outside depends on what comes",
            cell.index(),
            names.join(" or ")
        );
        Diagnostic::at("/task", found, "cells that are inside or outside").remedy(
            "Align the faces of the region with those of cells, or use \"actions\": \"inputs\", where nature picks in a step of \
             its own.",
        )
    })
}

/// When the unsafe region is avoided, if `check` was asked for and `d` steps are grouped.
pub(super) fn safety(
    check: Option<Safety>,
    d: usize,
    noise: &PlantNoise,
    probabilities: &Probabilities,
) -> Result<Safety, Diagnostic> {
    if d == 1 {
        return Ok(Safety::EveryStep);
    }
    let impossible = |found: &str, expected: &str| Err(Diagnostic::at("/task/check", found, expected));
    let is_reference = matches!(probabilities, Probabilities::Reference { .. });
    let is_grouped = noise.samples().is_some_and(|samples| matches!(samples.of_one_step, StepNoise::Unknown));
    match check {
        Some(Safety::EveryStep) if is_reference => impossible(
            "\"every_step\" in mode \"reference\"",
            "\"grouped\" there: the published tool looks no closer",
        ),
        Some(Safety::EveryStep) if is_grouped => impossible(
            "\"every_step\" with samples of \"grouped\" steps, which say nothing about those in between",
            "samples of one \"step\", or \"grouped\"",
        ),
        Some(Safety::GroupedInstants) => Ok(Safety::GroupedInstants),
        None if is_grouped || is_reference => Ok(Safety::GroupedInstants),
        None | Some(Safety::EveryStep) => Ok(Safety::EveryStep),
    }
}

/// The goal, which must contain a cell.
fn reach(
    goal: &[RegionBox],
    (unsafe_, places): (&[Region], &[usize]),
    grid: &Grid,
) -> Result<Vec<Region>, Diagnostic> {
    if goal.is_empty() {
        return Err(Diagnostic::at("/task/goal", "an empty list", "at least one box to be reached").remedy(
            "To keep clear of what is unsafe, with nothing to reach, ask to stay: \"type\": \"stay\", and no goal.",
        ));
    }
    let goal = regions("/task/goal", goal, grid.dimension())?;
    if let Some((i, j)) = first_overlap(&goal, unsafe_) {
        let found = format!("box {i} overlaps /task/unsafe/{}", places[j]);
        let expected = "goal boxes that meet no unsafe box";
        return Err(Diagnostic::at(format!("/task/goal/{i}"), found, expected)
            .remedy("Cut the overlap out of one of the two; boxes may touch."));
    }
    if first_overlap(&goal, &[whole(grid)]).is_none() {
        let expected = "a goal that is in the partition, at least in part";
        return Err(Diagnostic::at("/task/goal", "a goal outside of the partition", expected)
            .remedy("Enlarge /partition until it has whole cells of the goal, and the ways there."));
    }
    let labels = CellLabels::new(grid, &goal, unsafe_);
    if labels.count(CellKind::Goal) == 0 {
        let expected = format!("at least one whole cell inside it; cells measure {}", widths(grid));
        return Err(Diagnostic::at("/task/goal", "a goal that contains no cell of the partition", expected)
            .remedy("Enlarge the goal, align its faces with the grid, or use more cells."));
    }
    Ok(goal)
}

/// The partition as a region.
fn whole(grid: &Grid) -> Region {
    let sides = grid.axes().iter().map(|axis| (Some(axis.lower().clone()), Some(axis.upper().clone())));
    let (lower, upper) = sides.unzip();
    Region { lower, upper }
}

/// The region to stay in, which must contain a cell that is not unsafe.
fn stay(safe: &[RegionBox], unsafe_: &[Region], grid: &Grid) -> Result<Vec<Region>, Diagnostic> {
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
    Ok(safe)
}

/// To be in the goal after the last step.
fn at_step(goal: Vec<Region>, unsafe_: &[Region], horizon: Horizon) -> Result<AutomatonTask, Diagnostic> {
    let Horizon::Steps(steps) = horizon else {
        return Err(Diagnostic::at("/task/horizon", "\"infinite\"", "the step at which to be in the goal"));
    };
    let boxes = |name: &str, regions: &[Region]| NamedRegion {
        name: name.to_owned(),
        shapes: regions.iter().cloned().map(Shape::Box).collect(),
    };
    // The last letter decides.
    let dfa = Dfa::from_parts(1, 0, vec![0, 1, 0, 1], vec![false, true]);
    let (dfa, mut regions) =
        (if unsafe_.is_empty() { dfa } else { dfa.guarded() }, vec![boxes("goal", &goal)]);
    if !unsafe_.is_empty() {
        regions.push(boxes("unsafe", unsafe_));
    }
    Ok(AutomatonTask::new(&dfa, task::Aim::End, regions, format!("the state is in the goal at step {steps}")))
}

/// That memories in cells can be numbered, with the steps where the last one decides.
fn require_numbers(task: &CellTask, horizon: Horizon) -> Result<(), Diagnostic> {
    let pairs = u64::from(task.memories()).saturating_mul(task.num_cells() as u64);
    let most = u64::from(Grid::MAX_CELLS);
    if pairs > most {
        let found = format!("{} memories in {} cells", task.memories(), task.num_cells());
        return Err(Diagnostic::at("/task", found, format!("at most {most} together"))
            .remedy("Simplify the task or use fewer cells."));
    }
    match (task.aim(), horizon) {
        (task::Aim::End, Horizon::Steps(steps)) if steps.saturating_mul(pairs) > most => {
            let expected = format!("at most {} steps, if the last one decides", most / pairs.max(1));
            Err(Diagnostic::at("/task/horizon", steps.to_string(), expected)
                .remedy("Use fewer cells, or a task that a prefix of the run decides."))
        }
        _ => Ok(()),
    }
}

/// What an objective makes of the cells.
fn cell_task(
    objective: &Objective,
    unsafe_: &[Region],
    grid: &Grid,
) -> Result<(CellLabels, CellTask), Diagnostic> {
    let (labels, best) = match objective {
        Objective::Reach { goal } => {
            (CellLabels::new(grid, goal, unsafe_), CellLabels::at_best(grid, goal, unsafe_))
        }
        Objective::Stay { safe } => {
            (CellLabels::staying(grid, safe, unsafe_), CellLabels::staying_at_best(grid, safe, unsafe_))
        }
        Objective::Automaton(task) => {
            let cells = CellTask::of_automaton(task, grid);
            if task.aim() == task::Aim::Reach && !cells.can_be_done() {
                let found = format!("a task that no run of cells fulfils: {}", task.statement());
                let expected = "regions that contain whole cells, in an order in which they can be visited";
                return Err(Diagnostic::at("/task", found, expected)
                    .remedy("Enlarge the regions, align their faces with the grid, or use more cells."));
            }
            let kinds = (0..grid.num_cells()).map(|cell| cells.kind(CellId(cell))).collect();
            return Ok((CellLabels::from_kinds(kinds), cells));
        }
    };
    let task = CellTask::of_kinds(objective.aim(), labels.kinds(), best.kinds());
    Ok((labels, task))
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
