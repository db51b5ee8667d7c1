//! Values and policies as files, in PRISM's forms.

use super::CliError;
use imdp::evaluation::{Evaluation, Values};
use imdp::files::Outputs;
use imdp::formats::{PolicyEntry, StateValues};
use imdp::model::{IntervalMdp, RowId, StateId};
use imdp::property::Verdict;
use imdp::solver::{Answer, Policy};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Writes one line per state: its lower bound, or for thresholds `true`, `false` or `undecided`.
///
/// # Errors
/// What writing gives.
pub(super) fn write_values(model: &IntervalMdp, answer: &Answer, out: &mut impl Write) -> io::Result<()> {
    let verdicts: Option<Vec<Verdict>> =
        StateId::first(model.num_states()).map(|state| answer.verdict_of(state)).collect();
    match verdicts.filter(|_| answer.objective.threshold.is_some()) {
        Some(verdicts) => StateValues::Verdicts(verdicts).write(out),
        None => StateValues::Numbers(answer.values.lower.clone()).write(out),
    }
}

/// Writes one line per state for an expression: the lower bound of its value, or `true`, `false` or `undecided`.
///
/// # Errors
/// What writing gives.
pub(super) fn write_evaluated(
    model: &IntervalMdp,
    evaluation: &Evaluation,
    out: &mut impl Write,
) -> io::Result<()> {
    let states = StateId::first(model.num_states());
    let verdicts: Option<Vec<Verdict>> = states.clone().map(|state| evaluation.verdict(state)).collect();
    match verdicts.filter(|_| matches!(evaluation.values, Values::Truth(_))) {
        Some(verdicts) => StateValues::Verdicts(verdicts).write(out),
        None => {
            let lower = |state| evaluation.bounds(state).map_or(f64::NEG_INFINITY, |(lower, _)| lower);
            StateValues::Numbers(states.map(lower).collect()).write(out)
        }
    }
}

/// Writes `state=action`, or `state,step=action` for a policy that changes over time.
///
/// A choice without a name is given by its index.
///
/// # Errors
/// What writing gives.
pub(super) fn write_policy(model: &IntervalMdp, policy: &Policy, out: &mut impl Write) -> io::Result<()> {
    let first_choices = first_choices(model);
    let name = |state: StateId, choice: u32| {
        let row = model.choices().row_of_choice(state, choice);
        action_name(model, first_choices[state.index()] + u64::from(choice), row, choice)
    };
    write_entries(policy, model.num_states(), name, out)
}

/// Writes the lower bound of every cell, one per line.
///
/// # Errors
/// What writing gives.
pub(super) fn write_cell_values(lower: &[f64], out: &mut impl Write) -> io::Result<()> {
    StateValues::Numbers(lower.to_vec()).write(out)
}

/// Writes `cell=input`, or `cell,step=input` for a policy that changes over time; a step counts the steps elapsed.
///
/// # Errors
/// What writing gives.
pub(super) fn write_cell_policy(policy: &Policy, cells: u32, out: &mut impl Write) -> io::Result<()> {
    write_entries(policy, cells as usize, |_, input| format!("u_{input}"), out)
}

/// What a policy decides in each state, at every step if it changes over time.
fn write_entries(
    policy: &Policy,
    states: usize,
    name: impl Fn(StateId, u32) -> String,
    out: &mut impl Write,
) -> io::Result<()> {
    let steps = policy.horizon();
    for state in StateId::first(states) {
        for step in 0..steps.unwrap_or(1) {
            if let Some(choice) = policy.choice(state, step) {
                let (step, action) = (steps.map(|_| step), name(state, choice).into());
                writeln!(out, "{}", PolicyEntry { state, step, action })?;
            }
        }
    }
    Ok(())
}

/// Per state, the number of choices of the states before it.
fn first_choices(model: &IntervalMdp) -> Vec<u64> {
    let choices = model.choices();
    let mut total = 0;
    let of_state = |state: StateId| {
        let first = total;
        total += choices.ranges(state).iter().map(|range| range.len() as u64).sum::<u64>();
        total += u64::from(choices.is_absorbing(state));
        first
    };
    StateId::first(model.num_states()).map(of_state).collect()
}

fn action_name(model: &IntervalMdp, index: u64, row: Option<RowId>, choice: u32) -> String {
    model.actions().name(index, row).map_or_else(|| choice.to_string(), Into::into)
}

/// Writes a file beside its place and renames it: nobody ever sees half of it.
pub(super) fn replace(
    path: &Path,
    fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
) -> Result<(), CliError> {
    let mut files = Outputs::default();
    let written = files.write(path, fill).and_then(|()| files.commit());
    written.map_err(|error| CliError::writing(path, &error))
}
