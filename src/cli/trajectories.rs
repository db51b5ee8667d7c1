//! Trajectories as CSV.

use dynabs::controller::{Decision, Trajectory};
use imdp::numeric::shortest_decimal;
use std::io::{self, Write};

/// Writes one line per original step of `n` states and `p` inputs: `run`, `step`, the state `x…`, the input `u…` applied there, and `status`.
///
/// `status` is what the controller decided (`steer`, or how the run ended, with no input), and `between` where it
/// was not asked.
///
/// # Errors
/// What writing gives.
pub(super) fn write_trajectories(
    (n, p): (usize, usize),
    trajectories: impl Iterator<Item = Trajectory>,
    out: &mut impl Write,
) -> io::Result<()> {
    let named =
        |name: &str, count: usize| -> Vec<String> { (1..=count).map(|j| format!("{name}{j}")).collect() };
    let (states, inputs) = (named("x", n), named("u", p));
    writeln!(out, "run,step,{},{},status", states.join(","), inputs.join(","))?;
    for trajectory in trajectories {
        for step in &trajectory.steps {
            let state: Vec<_> = step.state.iter().map(|&x| shortest_decimal(x)).collect();
            let input = match &step.input {
                Some(u) => u.iter().map(|&u| shortest_decimal(u)).collect::<Vec<_>>().join(","),
                None => ",".repeat(p.saturating_sub(1)),
            };
            let status = match (step.decision, &step.input) {
                (None, _) => "between",
                (Some(Decision::Act { .. }), Some(_)) => "steer",
                (Some(Decision::Act { .. }), None) => "given_up",
                (Some(Decision::Reached), _) => "reached",
                (Some(Decision::Unsafe), _) => "unsafe",
                (Some(Decision::Outside), _) => "outside",
                (Some(Decision::NoAction), _) => "no_action",
                (Some(Decision::Over), _) => "over",
            };
            writeln!(out, "{},{},{},{input},{status}", trajectory.run, step.step, state.join(","))?;
        }
    }
    Ok(())
}
