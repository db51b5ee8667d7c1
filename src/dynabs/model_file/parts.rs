//! From the fields of a model file to the parts of a problem.

use super::dynamics::DynamicsSpec;
use super::fields::{
    CostSpec, DecimalSpec, GaussianSpec, Mode, ModelFile, NoiseSpec, ProbabilitiesSpec, SampleKindSpec,
    SamplesSpec, TargetsSpec,
};
use super::given::given;
use super::named::Named;
use super::set_fields::{GridSpec, SetSpec};
use super::stabilizer_parts::lower_layer;
use super::task_parts::task;
use crate::Diagnostic;
use crate::noise::DecimalMark;
use crate::problem::{
    CostParts, DrawnNoise, GaussianNoise, GivenSamples, InputSet, LinearDynamics, NoiseSource, Partition,
    Probabilities, Problem, ProblemBuilder, SampleKind, SamplesFile, TargetChoice,
};
use std::path::Path;

/// The parts of a problem whose actions steer to targets, not yet checked against each other.
pub(super) fn builder(file: ModelFile, directory: &Path) -> Result<ProblemBuilder, Diagnostic> {
    if let Some(field) = file.dynamics.beyond_matrices() {
        let place = format!("/dynamics/{field}");
        return Err(Diagnostic::at(place, "a field for actions \"inputs\"", "A, B and q").remedy(INPUTS));
    }
    if file.feedback.is_some() {
        let found = "a field for actions \"inputs\"";
        return Err(Diagnostic::at("/feedback", found, "only fields for actions \"targets\"").remedy(INPUTS));
    }
    let DynamicsSpec { a, b, q, group_steps, .. } = file.dynamics;
    let a = a.ok_or_else(|| missing("A").remedy(INPUTS))?;
    let b = b.ok_or_else(|| missing("B").remedy(INPUTS))?;
    let input = file.input.ok_or_else(|| missing("input").remedy(INPUTS))?;
    if input.points.is_some() || input.list.is_some() {
        return Err(Diagnostic::at("/input", "a choice of inputs", "only a set of inputs").remedy(INPUTS));
    }
    if file.partition.periodic.is_some() || file.partition.resolution.is_some() {
        return Err(
            Diagnostic::at("/partition", "periodic or resolution", "lower, upper and cells").remedy(INPUTS)
        );
    }
    let n = file.partition.lower.len();
    let mut builder = Problem::builder(LinearDynamics { a, b, q }, input_set("/input", input)?)
        .name(file.name)
        .group_steps(group_steps)
        .partition(partition(file.partition))
        .targets(targets(file.targets))
        .task(task(file.task, file.regions, directory)?)
        .costs(costs(file.costs))
        .probabilities(probabilities(&file.probabilities)?)
        .noise(noise(file.noise, directory, n)?);
    if let Some(state) = file.initial_state {
        builder = builder.initial_state(state);
    }
    if let Some(stabilizer) = file.stabilizer {
        builder = builder.lower_layer(lower_layer(stabilizer)?);
    }
    Ok(builder)
}

/// What steps cost.
pub(super) fn costs(costs: Named<CostSpec>) -> Vec<CostParts> {
    let cost = |(name, CostSpec { step, outside, discount })| CostParts { name, step, outside, discount };
    costs.0.into_iter().map(cost).collect()
}

/// The way out if steering to targets cannot do something.
const INPUTS: &str =
    "With \"actions\": \"inputs\" the controller chooses from inputs, for any dynamics and any noise.";

fn missing(name: &str) -> Diagnostic {
    Diagnostic::at("", format!("no field `{name}`"), format!("the field `{name}`"))
}

pub(super) fn input_set(place: &str, spec: SetSpec) -> Result<InputSet, Diagnostic> {
    match spec {
        SetSpec { lower: Some(lower), upper: Some(upper), normals: None, offsets: None, .. } => {
            Ok(InputSet::Box { lower, upper })
        }
        SetSpec { lower: None, upper: None, normals: Some(normals), offsets: Some(offsets), .. } => {
            Ok(InputSet::Polytope { normals, offsets })
        }
        _ => {
            let given = given(&[
                ("lower", spec.lower.is_some()),
                ("upper", spec.upper.is_some()),
                ("G", spec.normals.is_some()),
                ("g", spec.offsets.is_some()),
            ]);
            let found = if given.is_empty() { "neither".to_owned() } else { format!("only {given}") };
            Err(Diagnostic::at(place, found, "a box {lower, upper} or a polytope {G, g}"))
        }
    }
}

pub(super) fn partition(spec: GridSpec) -> Partition {
    Partition { lower: spec.lower, upper: spec.upper, cells: spec.cells }
}

fn targets(spec: TargetsSpec) -> TargetChoice {
    match spec {
        TargetsSpec::Centers => TargetChoice::Centers,
        TargetsSpec::Grid(grid) => TargetChoice::Grid(partition(grid)),
        TargetsSpec::Points(points) => TargetChoice::Points(points),
    }
}

pub(super) fn noise(spec: NoiseSpec, directory: &Path, n: usize) -> Result<NoiseSource, Diagnostic> {
    match spec {
        NoiseSpec {
            samples: Some(given),
            gaussian: None,
            components: None,
            count: None,
            seed: None,
            independent: None,
        } => samples(given, directory, n),
        NoiseSpec {
            samples: None,
            gaussian: Some(GaussianSpec { mean, covariance }),
            components: None,
            count: Some(count),
            seed,
            independent: None,
        } => {
            let distribution = GaussianNoise { mean, covariance };
            Ok(DrawnNoise { distribution, count, seed: seed.unwrap_or(0) }.into())
        }
        NoiseSpec {
            samples: None,
            gaussian: Some(GaussianSpec { mean, covariance }),
            components: None,
            count: None,
            seed: None,
            independent: None,
        } => Ok(NoiseSource::Gaussian(GaussianNoise { mean, covariance })),
        NoiseSpec {
            samples: None,
            gaussian: None,
            components: Some(components),
            count: None,
            seed: None,
            independent: None,
        } => Ok(NoiseSource::Components(components)),
        _ => {
            if spec.gaussian.is_some() && spec.seed.is_some() && spec.count.is_none() {
                return Err(Diagnostic::at("/noise/count", "nothing", "the number of samples to draw"));
            }
            let given = given(&[
                ("samples", spec.samples.is_some()),
                ("gaussian", spec.gaussian.is_some()),
                ("components", spec.components.is_some()),
                ("count", spec.count.is_some()),
                ("seed", spec.seed.is_some()),
                ("independent", spec.independent.is_some()),
            ]);
            let found = if given.is_empty() { "nothing".to_owned() } else { given };
            let expected = "{samples}, {gaussian, count, seed} to draw some, or what is known: {gaussian} or {components}";
            Err(Diagnostic::at("/noise", found, expected))
        }
    }
}

/// Samples of a file, or those that stand here.
fn samples(spec: SamplesSpec, directory: &Path, n: usize) -> Result<NoiseSource, Diagnostic> {
    let of = match spec.of {
        SampleKindSpec::Grouped => SampleKind::Grouped,
        SampleKindSpec::Step => SampleKind::Step,
    };
    let decimal = match spec.decimal {
        DecimalSpec::Point => DecimalMark::Point,
        DecimalSpec::Comma => DecimalMark::Comma,
    };
    match (spec.file, spec.values) {
        (Some(file), None) => Ok(SamplesFile { path: directory.join(&file), name: file, of, decimal }.into()),
        (None, Some(_)) if decimal == DecimalMark::Comma => {
            Err(Diagnostic::at("/noise/samples/decimal", "a field for files", "only values and of"))
        }
        (None, Some(values)) => {
            if let Some(i) = values.iter().position(|sample| sample.len() != n) {
                let found = format!("{} numbers", values[i].len());
                let expected = format!("{n}, one per dimension of the state");
                return Err(Diagnostic::at(format!("/noise/samples/values/{i}"), found, expected));
            }
            Ok(GivenSamples { values: values.concat(), of }.into())
        }
        (file, _) => {
            let found = if file.is_some() { "both" } else { "neither" };
            Err(Diagnostic::at("/noise/samples", found, "exactly one of file and values"))
        }
    }
}

pub(super) fn probabilities(spec: &ProbabilitiesSpec) -> Result<Probabilities, Diagnostic> {
    let foreign = |field: &str, mode: &str| {
        let (place, expected) =
            (format!("/probabilities/{field}"), format!("only fields of mode \"{mode}\""));
        Err(Diagnostic::at(place, "a field of the other mode", expected))
    };
    match (spec.mode, spec) {
        (Mode::Pac, ProbabilitiesSpec { beta_per_interval: Some(_), .. }) => {
            foreign("beta_per_interval", "pac")
        }
        (Mode::Pac, ProbabilitiesSpec { confidence: Some(_), beta: Some(_), .. }) => Err(Diagnostic::at(
            "/probabilities",
            "both confidence and beta",
            "one of them: beta = 1 − confidence",
        )),
        (Mode::Pac, ProbabilitiesSpec { confidence, beta, sweep, discard, .. }) => {
            let pac = match beta {
                Some(beta) => Probabilities::with_beta(*beta),
                None => Probabilities::with_confidence(confidence.unwrap_or(0.99)),
            };
            pac?.discarding(discard.unwrap_or(0)).among(sweep.unwrap_or(1))
        }
        (Mode::Reference, ProbabilitiesSpec { confidence: Some(_), .. }) => {
            foreign("confidence", "reference")
        }
        (Mode::Reference, ProbabilitiesSpec { beta: Some(_), .. }) => foreign("beta", "reference"),
        (Mode::Reference, ProbabilitiesSpec { discard: Some(_), .. }) => foreign("discard", "reference"),
        (Mode::Reference, ProbabilitiesSpec { sweep: Some(_), .. }) => foreign("sweep", "reference"),
        (Mode::Reference, ProbabilitiesSpec { beta_per_interval, .. }) => {
            Probabilities::reference(beta_per_interval.unwrap_or(0.01))
        }
    }
}
