//! From the fields of a model file to the parts of a problem whose actions are inputs.

use super::fields::{DynamicsSpec, ModelFile, NoiseSpec, SetSpec, TargetsSpec};
use super::parts::{input_set, partition, task};
use crate::Diagnostic;
use crate::problem::{InputChoice, InputParts, InputSet, LinearDynamics};
use crate::system::Mode;

/// The parts, not yet checked against each other.
pub(super) fn input_parts(file: ModelFile) -> Result<InputParts, Diagnostic> {
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
    let mode = mode(file.dynamics)?;
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
    let NoiseSpec { components: Some(noise), samples: None, gaussian: None, count: None, seed: None } =
        file.noise
    else {
        let (found, expected) = ("samples or a joint distribution", "known components");
        return Err(Diagnostic::at("/noise", found, expected));
    };
    Ok(InputParts {
        name: file.name,
        mode,
        periodic,
        set,
        inputs,
        gain: None,
        resolution: file.partition.resolution.clone(),
        partition: partition(file.partition),
        noise,
        task: Some(task(file.task)?),
        initial_state: file.initial_state,
    })
}

/// The dynamics of one step, whatever they are.
fn mode(spec: DynamicsSpec) -> Result<Mode, Diagnostic> {
    let linear = LinearDynamics { a: spec.a, b: spec.b.unwrap_or_default(), q: spec.q };
    let system = linear.any_system()?;
    let names = (1..=system.state_dimension()).map(|j| format!("x{j}")).collect();
    Ok(Mode::linear(&system, names))
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
