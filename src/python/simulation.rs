//! Simulations of the closed loop.

use crate::arrays::{Doubles, array, states};
use crate::errors::refused;
use crate::work::interruptible;
use dynabs::controller::{Controller, Noise, ParameterChoice, Simulation};
use dynabs::model_file::StatedProblem;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// The system and its controller.
type ClosedLoop<'a> = (&'a StatedProblem, &'a Controller);

/// The state that runs start in: the given one, else that of the problem.
///
/// # Errors
/// If there is none, or it is outside the partition.
pub(crate) fn start(
    stated: &StatedProblem,
    controller: &Controller,
    given: Option<Doubles<'_>>,
) -> PyResult<Vec<f64>> {
    let n = controller.state_dimension();
    let initial = match stated {
        StatedProblem::Targets(problem) => problem.initial_state(),
        StatedProblem::Inputs(problem) => problem.initial_state(),
    };
    let x = match (given, initial) {
        (Some(x), _) => match states("start", &x, n)? {
            (true, x) => x,
            (false, _) => {
                return Err(refused(format!("start: found several states; expected one, of shape [{n}]")));
            }
        },
        (None, Some(x)) => x.to_vec(),
        (None, None) => {
            return Err(refused(
                "start: found none, and the problem has no initial state; expected the state that runs start in",
            ));
        }
    };
    if controller.cell(&x).is_none() {
        return Err(refused(format!("start: found {x:?}, outside the partition; expected a state in it")));
    }
    Ok(x)
}

/// What many runs came to, by name.
pub(crate) fn simulate<'py>(
    py: Python<'py>,
    (stated, controller): ClosedLoop<'_>,
    start: &[f64],
    (runs, seed, most_steps): (u64, u64, u64),
    confidence: f64,
) -> PyResult<Bound<'py, PyDict>> {
    if !(1..=1_000_000_000).contains(&runs) || !(0.5..1.0).contains(&confidence) {
        return Err(refused(format!(
            "runs, confidence: found {runs} and {confidence}; expected 1 to 1000000000 runs, and a number from 0.5 up to, but \
             not including, 1"
        )));
    }
    let tally =
        interruptible(py, |stop| closed((stated, controller), most_steps).tally(start, seed, runs, stop))?;
    let safety = controller.guarantee().event.safety;
    let satisfied = tally.satisfaction(safety, 1.0 - confidence);
    let said = PyDict::new(py);
    said.set_item("runs", tally.runs)?;
    said.set_item("satisfied", satisfied.frequency)?;
    said.set_item("lower", satisfied.lower)?;
    said.set_item("upper", satisfied.upper)?;
    said.set_item("confidence", satisfied.confidence)?;
    // In reference mode nothing is promised.
    let bound = controller.bound_at(start);
    let promised = controller.guarantee().confidence().map(|_| bound);
    said.set_item("promised", promised)?;
    said.set_item("contradicted", promised.map(|bound| satisfied.contradicts(bound)))?;
    let ended = PyDict::new(py);
    for (name, count) in [
        ("reached", tally.reached),
        ("unsafe", tally.r#unsafe),
        ("outside", tally.outside),
        ("no_action", tally.no_action),
        ("over", tally.over),
        ("unfinished", tally.unfinished),
    ] {
        ended.set_item(name, count)?;
    }
    said.set_item("ended", ended)?;
    said.set_item("steps", tally.steps)?;
    said.set_item("violations", tally.violations)?;
    Ok(said)
}

/// One run, step by step.
pub(crate) fn trajectory<'py>(
    py: Python<'py>,
    (stated, controller): ClosedLoop<'_>,
    start: &[f64],
    (run, seed, most_steps): (u64, u64, u64),
) -> PyResult<Bound<'py, PyDict>> {
    let trajectory = interruptible(py, |stop| {
        closed((stated, controller), most_steps).trajectory_until(start, (seed, run), stop)
    })?;
    let (n, p) = (controller.state_dimension(), controller.step_inputs());
    let states: Vec<f64> = trajectory.steps.iter().flat_map(|step| step.state.iter().copied()).collect();
    let inputs: Vec<f64> =
        trajectory.steps.iter().filter_map(|step| step.input.as_ref()).flatten().copied().collect();
    let steps = trajectory.steps.iter().filter(|step| step.input.is_some()).count();
    let said = PyDict::new(py);
    said.set_item("states", array(py, states, [trajectory.steps.len(), n])?)?;
    said.set_item("inputs", array(py, inputs, [steps, p])?)?;
    said.set_item("satisfied", trajectory.outcome.satisfied)?;
    Ok(said)
}

/// The closed loop with the problem's noise, as truly as it is known.
fn closed<'a>((stated, controller): ClosedLoop<'a>, most_steps: u64) -> Simulation<'a> {
    match stated {
        StatedProblem::Targets(problem) => {
            Simulation::new(problem, controller, Noise::of_plant(problem.noise()), most_steps)
        }
        StatedProblem::Inputs(problem) => {
            Simulation::of_inputs(problem, controller, ParameterChoice::Random, most_steps)
        }
    }
}
