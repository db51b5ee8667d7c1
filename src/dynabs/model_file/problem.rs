//! A control problem that is known to make sense.

use super::values::{input_set, matrix, vector};
use super::{
    Diagnostic, Document, DynamicsSpec, GroupSteps, Horizon, Mode, NoiseSource, ProbabilitiesSpec,
    SafetyCheck, Stabilizer, StepNoise,
};
use super::{regions, stabilizer};
use crate::Warning;
use crate::geometry::Polytope;
use crate::guarantee::Safety;
use crate::linear_algebra::ExactMatrix;
use crate::partition::{CellId, CellLabels, Grid, Region};
use crate::system::{LinearSystem, group, smallest_group};
use imdp::numeric::{Rational, from_decimal, to_f64};
use imdp::property::Probability;
use num_traits::{One, Zero};

/// A validated control problem: everything that can be said before cells and samples meet.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The name of the model.
    pub name: String,
    /// The system of one step.
    pub step_system: LinearSystem,
    /// The inputs of one step.
    pub step_input: Polytope,
    /// How many steps are grouped, `d`.
    pub group_steps: usize,
    /// The grouped system.
    pub system: LinearSystem,
    /// The inputs of the grouped system, `Uᵈ`.
    pub input: Polytope,
    /// The lower layer, if there is one.
    pub stabilizer: Option<Stabilizer>,
    /// The partition.
    pub grid: Grid,
    /// What the cells mean to the task.
    pub labels: CellLabels,
    /// The goal region.
    pub goal: Vec<Region>,
    /// The unsafe region.
    pub unsafe_: Vec<Region>,
    /// Whether everything outside the partition is unsafe too. At grouped instants it counts as failed anyway.
    pub outside_is_unsafe: bool,
    /// When the unsafe region is avoided.
    pub safety: Safety,
    /// The points that actions steer to.
    pub targets: TargetPoints,
    /// The number of grouped steps, or `None` for an unbounded task.
    pub horizon: Option<u64>,
    /// The probability that is wanted.
    pub threshold: Option<Probability>,
    /// The cell of the initial state, if one was given.
    pub initial_cell: Option<CellId>,
    /// The initial state, if one was given.
    pub initial_state: Option<Vec<f64>>,
    /// How intervals are computed.
    pub probabilities: Probabilities,
    /// The noise samples of the grouped system.
    pub noise: NoiseSource,
    /// What the user should know.
    pub warnings: Vec<Warning>,
}

/// The points that actions steer to.
#[derive(Clone, Debug)]
pub enum TargetPoints {
    /// The centres of all cells.
    Centers,
    /// The centres of the cells of a grid.
    Grid(Grid),
    /// A list of points.
    List(Vec<Vec<Rational>>),
}

/// How probability intervals are computed from the samples.
#[derive(Clone, Debug, PartialEq)]
pub enum Probabilities {
    /// Jointly valid with probability at least `1 − beta`.
    Pac {
        /// The failure probability, exactly.
        beta: Rational,
        /// How many settings are compiled with these samples: each may spend `beta / sweep`.
        sweep: u64,
        /// How many of the farthest samples are left out of the cells that rows list.
        discard: u64,
    },
    /// The published tool's intervals.
    Reference {
        /// The failure probability of one interval.
        beta_per_interval: f64,
    },
}

impl Problem {
    /// Validates a model file and reads its noise samples.
    ///
    /// # Errors
    /// A [`Diagnostic`] for the first mistake found.
    pub fn from_document(document: &Document) -> Result<Self, Diagnostic> {
        Self::build(document).map_err(|error| error.in_file(&document.name))
    }

    fn build(document: &Document) -> Result<Self, Diagnostic> {
        let file = document.model()?;
        let step_system = dynamics(&file.dynamics)?;
        let n = step_system.state_dimension();
        let step_input = input_set("/input", &file.input, step_system.input_dimension())?;
        let group_steps = grouping(&file.dynamics, &step_system)?;
        let system = group(&step_system, group_steps);
        let input = step_input.power(group_steps);

        let grid = regions::grid("/partition", &file.partition, n)?;
        let targets = regions::targets("/targets", &file.targets, n)?;
        let task = regions::task_regions(&file.task, &grid)?;
        let mut warnings = task.warnings;
        let horizon = horizon(file.task.horizon, group_steps, &mut warnings)?;
        let threshold = file.task.threshold.map(threshold).transpose()?;
        let initial_cell = match &file.initial_state {
            None => None,
            Some(x) => Some(initial_cell(x, &grid)?),
        };
        let stabilizer = match &file.stabilizer {
            None => None,
            Some(spec) => Some(stabilizer::stabilizer(spec, &system, &input, &grid)?),
        };
        let probabilities = probabilities(&file.probabilities)?;
        let noise = NoiseSource::new(&document.directory, &file.noise, &step_system, group_steps)?;
        let safety = safety(file.task.check, group_steps, &noise, &probabilities)?;
        warnings.extend(stabilizer.iter().flat_map(|s| s.warnings.iter().cloned()));
        warnings.extend(noise.warnings.iter().cloned());
        Ok(Self {
            name: file.name,
            step_system,
            step_input,
            group_steps,
            system,
            input,
            stabilizer,
            grid,
            labels: task.labels,
            goal: task.goal,
            unsafe_: task.unsafe_,
            outside_is_unsafe: task.outside_is_unsafe,
            safety,
            targets,
            horizon,
            threshold,
            initial_cell,
            initial_state: file.initial_state,
            probabilities,
            noise,
            warnings,
        })
    }
}

fn dynamics(spec: &DynamicsSpec) -> Result<LinearSystem, Diagnostic> {
    let a = matrix("/dynamics/A", &spec.a, None, Some(spec.a.len()), "A is square")?;
    let n = a.rows();
    let b = matrix("/dynamics/B", &spec.b, Some(n), None, "as many as A has")?;
    let q = match &spec.q {
        None => ExactMatrix::zeros(n, 1),
        Some(q) => {
            let q = vector("/dynamics/q", q, n, "one per dimension of the state")?;
            ExactMatrix::from_fn(n, 1, |i, _| q[i].clone())
        }
    };
    let system = LinearSystem::new(a, b, q);
    if !system.is_regular() {
        let found = format!("a singular matrix of rank {}", system.a().rank());
        return Err(Diagnostic::at("/dynamics/A", found, format!("a non-singular matrix of rank {n}"))
            .remedy("Remove states that do not depend on the past, or discretise with another step."));
    }
    let rank = system.controllability_rank();
    if rank < n {
        let found = format!("an uncontrollable pair (A, B): [B AB …] has rank {rank}");
        return Err(Diagnostic::at("/dynamics", found, format!("rank {n}, the dimension of the state"))
            .remedy(
                "Some directions of the state cannot be steered: add inputs or leave those states out.",
            ));
    }
    Ok(system)
}

fn grouping(spec: &DynamicsSpec, system: &LinearSystem) -> Result<usize, Diagnostic> {
    let n = system.state_dimension();
    let smallest = smallest_group(system).unwrap_or(n);
    let place = "/dynamics/group_steps";
    match spec.group_steps {
        GroupSteps::Auto => Ok(smallest),
        GroupSteps::Steps(d) if d as usize > 64 => {
            Err(Diagnostic::at(place, d.to_string(), format!("at most 64; {smallest} would do")))
        }
        GroupSteps::Steps(d) => {
            let rank = group(system, d as usize).b().rank();
            if rank == n {
                return Ok(d as usize);
            }
            let found = format!("{d}, for which the grouped B has rank {rank}");
            Err(Diagnostic::at(place, found, format!("a number of steps that makes its rank {n}"))
                .remedy(format!("Use \"auto\" or {smallest}.")))
        }
    }
}

fn horizon(horizon: Horizon, d: usize, warnings: &mut Vec<Warning>) -> Result<Option<u64>, Diagnostic> {
    let Horizon::Steps(steps) = horizon else { return Ok(None) };
    let (grouped, rest) = (steps / d as u64, steps % d as u64);
    if grouped == 0 {
        let expected = format!("at least {d}, the number of steps that are grouped into one");
        return Err(Diagnostic::at("/task/horizon", steps.to_string(), expected));
    }
    if rest > 0 {
        warnings.push(Warning::CutHorizon { steps, used: grouped * d as u64, group_steps: d });
    }
    Ok(Some(grouped))
}

fn safety(
    check: Option<SafetyCheck>,
    group_steps: usize,
    noise: &NoiseSource,
    probabilities: &Probabilities,
) -> Result<Safety, Diagnostic> {
    if group_steps == 1 {
        return Ok(Safety::EveryStep);
    }
    let is_reference = matches!(probabilities, Probabilities::Reference { .. });
    let is_stepwise = !matches!(noise.of_one_step, StepNoise::Unknown);
    let impossible = |found: &str, expected: &str| Err(Diagnostic::at("/task/check", found, expected));
    match check {
        Some(SafetyCheck::EveryStep) if is_reference => impossible(
            "\"every_step\" in mode \"reference\"",
            "\"grouped\" there: the published tool looks no closer",
        ),
        Some(SafetyCheck::EveryStep) if !is_stepwise => impossible(
            "\"every_step\" with samples of \"grouped\" steps, which say nothing about those in between",
            "samples of one \"step\", or \"grouped\"",
        ),
        None | Some(SafetyCheck::EveryStep) if is_stepwise && !is_reference => Ok(Safety::EveryStep),
        _ => Ok(Safety::GroupedInstants),
    }
}

fn threshold(threshold: f64) -> Result<Probability, Diagnostic> {
    Probability::from_f64(threshold)
        .map_err(|_| Diagnostic::at("/task/threshold", threshold.to_string(), "a probability in [0, 1]"))
}

fn initial_cell(x: &[f64], grid: &Grid) -> Result<CellId, Diagnostic> {
    let place = "/initial_state";
    let exact = vector(place, x, grid.dimension(), "one per dimension of the state")?;
    let outside = (0..x.len()).find(|&j| grid.axes()[j].locate(&exact[j]).is_none());
    match (outside, grid.locate(&exact)) {
        (None, Some(cell)) => Ok(cell),
        (outside, _) => {
            let j = outside.unwrap_or_default();
            let axis = &grid.axes()[j];
            let expected = format!(
                "a state in the partition, [{}, {}) there",
                to_f64(axis.lower()),
                to_f64(axis.upper())
            );
            Err(Diagnostic::at(format!("{place}/{j}"), x[j].to_string(), expected)
                .remedy("Move the state or enlarge the partition; cells do not contain their upper faces."))
        }
    }
}

fn probabilities(spec: &ProbabilitiesSpec) -> Result<Probabilities, Diagnostic> {
    let place = |field: &str| format!("/probabilities/{field}");
    let in_unit = |field: &str, x: f64| match from_decimal(x) {
        Some(exact) if !exact.is_zero() && x > 0.0 && x < 1.0 => Ok(exact),
        _ => Err(Diagnostic::at(place(field), x.to_string(), "a number strictly between 0 and 1")),
    };
    let foreign = |field: &str, mode: &str| {
        Err(Diagnostic::at(
            place(field),
            "a field of the other mode",
            format!("only fields of mode \"{mode}\""),
        ))
    };
    match spec {
        ProbabilitiesSpec { mode: Mode::Pac, beta_per_interval: Some(_), .. } => {
            foreign("beta_per_interval", "pac")
        }
        ProbabilitiesSpec { mode: Mode::Reference, confidence: Some(_), .. } => {
            foreign("confidence", "reference")
        }
        ProbabilitiesSpec { mode: Mode::Reference, beta: Some(_), .. } => foreign("beta", "reference"),
        ProbabilitiesSpec { mode: Mode::Reference, discard: Some(_), .. } => foreign("discard", "reference"),
        ProbabilitiesSpec { mode: Mode::Reference, sweep: Some(_), .. } => foreign("sweep", "reference"),
        ProbabilitiesSpec { sweep: Some(0), .. } => Err(Diagnostic::at(
            place("sweep"),
            "0",
            "the number of settings that are compiled with these samples, at least 1",
        )),
        ProbabilitiesSpec { mode: Mode::Pac, confidence: Some(_), beta: Some(_), .. } => Err(Diagnostic::at(
            "/probabilities",
            "both confidence and beta",
            "one of them: beta = 1 − confidence",
        )),
        ProbabilitiesSpec { mode: Mode::Pac, confidence, beta, sweep, discard, .. } => {
            let beta = match beta {
                Some(beta) => in_unit("beta", *beta)?,
                None => Rational::one() - in_unit("confidence", confidence.unwrap_or(0.99))?,
            };
            Ok(Probabilities::Pac { beta, sweep: sweep.unwrap_or(1), discard: discard.unwrap_or(0) })
        }
        ProbabilitiesSpec { mode: Mode::Reference, beta_per_interval, .. } => {
            let beta_per_interval = beta_per_interval.unwrap_or(0.01);
            in_unit("beta_per_interval", beta_per_interval)?;
            Ok(Probabilities::Reference { beta_per_interval })
        }
    }
}
