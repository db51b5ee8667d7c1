//! From the fields of a model file to the parts of a problem whose actions are inputs.

use super::fields::{FeedbackSpec, IndependentSpec, ModelFile, NoiseSpec, ProbabilitiesSpec, TargetsSpec};
use super::given::given;
use super::parts::{self, costs, input_set, partition, probabilities};
use super::set_fields::SetSpec;
use super::stabilizer_fields::LqrSpec;
use super::task_parts::task;
use crate::Diagnostic;
use crate::problem::{
    Components, FeedbackChoice, InputChoice, InputNoiseParts, InputParts, InputSet, LqrWeights, Probabilities,
};
use std::path::Path;

/// The parts, not yet checked against each other.
pub(super) fn input_parts(file: ModelFile, directory: &Path) -> Result<InputParts, Diagnostic> {
    let foreign = |name: &str| {
        let expected = "only fields for actions \"inputs\"";
        Diagnostic::at(format!("/{name}"), "a field for actions \"targets\"", expected)
    };
    if file.stabilizer.is_some() {
        return Err(foreign("stabilizer"));
    }
    if !matches!(file.targets, TargetsSpec::Centers) {
        return Err(foreign("targets"));
    }
    let mode = file.dynamics.mode(&file.partition, file.input.as_ref())?;
    let (n, p) = (mode.num_states(), mode.num_inputs());
    let (set, inputs) = input_choice(file.input, p)?;
    let periodic = file.partition.periodic.clone().unwrap_or(vec![false; n]);
    if periodic.len() != n {
        let found = format!("{} entries", periodic.len());
        return Err(Diagnostic::at(
            "/partition/periodic",
            found,
            format!("{n}, one per dimension of the state"),
        ));
    }
    let noise = noise(file.noise, &file.probabilities, (directory, n))?;
    Ok(InputParts {
        name: file.name,
        mode,
        periodic,
        set,
        inputs,
        feedback: feedback(file.feedback)?,
        resolution: file.partition.resolution.clone(),
        partition: partition(file.partition),
        noise,
        task: Some(task(file.task, file.regions, directory)?),
        initial_state: file.initial_state,
        costs: costs(file.costs),
    })
}

/// Known noise, or samples and what is asked of them.
fn noise(
    spec: NoiseSpec,
    asked: &ProbabilitiesSpec,
    (directory, n): (&Path, usize),
) -> Result<InputNoiseParts, Diagnostic> {
    let is_sampled = spec.samples.is_some() || spec.count.is_some();
    if let (Some(_), false) = (spec.independent, is_sampled) {
        let expected = "samples, or gaussian with a count of samples to draw";
        return Err(Diagnostic::at("/noise/independent", "a field for samples", expected)
            .remedy("Known components are independent as they are."));
    }
    let components = match spec.independent {
        None => Components::Joint,
        Some(IndependentSpec::Intervals) => Components::Intervals,
        Some(IndependentSpec::Bands) => Components::Bands,
    };
    let source = parts::noise(NoiseSpec { independent: None, ..spec }, directory, n)?;
    // Where the noise is known, nothing is asked of samples.
    let probabilities = if is_sampled { probabilities(asked)? } else { Probabilities::default() };
    Ok(InputNoiseParts { source, components, probabilities })
}

fn feedback(spec: Option<FeedbackSpec>) -> Result<FeedbackChoice, Diagnostic> {
    match spec {
        None => Ok(FeedbackChoice::None),
        Some(FeedbackSpec { gain: Some(gain), lqr: None, narrow: None }) => Ok(FeedbackChoice::Gain(gain)),
        Some(FeedbackSpec { gain: None, lqr: Some(LqrSpec { q, r, decimals }), narrow: None }) => {
            Ok(FeedbackChoice::Lqr(LqrWeights { q, r, decimals }))
        }
        Some(FeedbackSpec { gain: None, lqr: None, narrow: Some(share) }) => {
            Ok(FeedbackChoice::Narrow(share))
        }
        Some(FeedbackSpec { gain, lqr, narrow }) => {
            let fields = [("gain", gain.is_some()), ("lqr", lqr.is_some()), ("narrow", narrow.is_some())];
            let given = given(&fields);
            let found = if given.is_empty() { "none of them".to_owned() } else { given };
            Err(Diagnostic::at("/feedback", found, "exactly one of gain, lqr and narrow"))
        }
    }
}

fn input_choice(spec: Option<SetSpec>, p: usize) -> Result<(Option<InputSet>, InputChoice), Diagnostic> {
    let Some(mut spec) = spec else { return Ok((None, InputChoice::Grid(vec![]))) };
    let choice = match (spec.points.take(), spec.list.take()) {
        (Some(_), Some(_)) => return Err(Diagnostic::at("/input", "both points and list", "one of them")),
        (Some(points), None) => InputChoice::Grid(points),
        (None, Some(list)) => InputChoice::List(list),
        (None, None) => InputChoice::Grid(vec![if p == 1 { 5 } else { 3 }; p]),
    };
    let is_set =
        spec.lower.is_some() || spec.upper.is_some() || spec.normals.is_some() || spec.offsets.is_some();
    let set = is_set.then(|| input_set("/input", spec)).transpose()?;
    Ok((set, choice))
}
