//! Trajectories as CSV.

use dynabs::controller::{Decision, Moment, Simulation};
use imdp::numeric::shortest_decimal;
use std::io::{self, Write};

/// Writes one line per original step of `n` states and `p` inputs: `run`, `step`, the state `x…`, the input `u…` applied there, and `status`;
/// each as it happens, so that nothing has to be kept.
///
/// `status` is what the controller decided (`steer`, or how the run ended, with no input), and `between` where it
/// was not asked.
///
/// # Errors
/// What writing gives.
pub(super) fn write_trajectories(
    simulation: &Simulation<'_>,
    (start, seed, runs): (&[f64], u64, u64),
    (n, p): (usize, usize),
    out: &mut impl Write,
) -> io::Result<()> {
    let named =
        |name: &str, count: usize| -> Vec<String> { (1..=count).map(|j| format!("{name}{j}")).collect() };
    let (states, inputs) = (named("x", n), named("u", p));
    writeln!(out, "run,step,{},{},status", states.join(","), inputs.join(","))?;
    for run in 0..runs {
        let mut written = Ok(());
        simulation.watch(start, seed, run, |moment| {
            if written.is_ok() {
                written = write_moment(run, moment, p, out);
            }
        });
        written?;
    }
    Ok(())
}

fn write_moment(run: u64, moment: Moment<'_>, p: usize, out: &mut impl Write) -> io::Result<()> {
    let numbers =
        |numbers: &[f64]| numbers.iter().map(|&x| shortest_decimal(x)).collect::<Vec<_>>().join(",");
    let input = moment.u.map_or_else(|| ",".repeat(p.saturating_sub(1)), numbers);
    let status = match (moment.decision, moment.u) {
        (None, _) => "between",
        (Some(Decision::Act { .. }), Some(_)) => "steer",
        (Some(Decision::Act { .. }), None) => "given_up",
        (Some(Decision::Reached), _) => "reached",
        (Some(Decision::Unsafe), _) => "unsafe",
        (Some(Decision::Outside), _) => "outside",
        (Some(Decision::NoAction), _) => "no_action",
        (Some(Decision::Over), _) => "over",
    };
    writeln!(out, "{run},{},{},{input},{status}", moment.step, numbers(moment.x))
}
