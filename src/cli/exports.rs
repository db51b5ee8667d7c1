//! Values and policies as files, in PRISM's forms.

use super::CliError;
use imdp::evaluation::Evaluation;
use imdp::files::Outputs;
use imdp::model::{IntervalMdp, RowId, StateId};
use imdp::property::Verdict;
use imdp::solver::{Answer, Policy};
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

/// Writes one line per state: its lower bound, or for thresholds `true`, `false` or `undecided`.
///
/// The form of PRISM's `-exportvector`.
///
/// # Errors
/// What writing gives.
pub(super) fn write_values(model: &IntervalMdp, answer: &Answer, out: &mut impl Write) -> io::Result<()> {
    for state in StateId::first(model.num_states()) {
        match answer.verdict_of(state) {
            None => {
                let value = answer.values.lower[state.index()];
                writeln!(out, "{}", imdp::numeric::shortest_decimal(value))?;
            }
            Some(Verdict::Holds) => writeln!(out, "true")?,
            Some(Verdict::Fails) => writeln!(out, "false")?,
            Some(Verdict::Unknown) => writeln!(out, "undecided")?,
        }
    }
    Ok(())
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
    for state in StateId::first(model.num_states()) {
        match (evaluation.bounds(state), evaluation.verdict(state)) {
            (Some((lower, _)), _) if lower.is_finite() => {
                writeln!(out, "{}", imdp::numeric::shortest_decimal(lower))?;
            }
            // As PRISM writes it.
            (Some((lower, _)), _) => writeln!(out, "{}", if lower > 0.0 { "Infinity" } else { "-Infinity" })?,
            (None, Some(Verdict::Holds)) => writeln!(out, "true")?,
            (None, Some(Verdict::Fails)) => writeln!(out, "false")?,
            (None, _) => writeln!(out, "undecided")?,
        }
    }
    Ok(())
}

/// Writes `state=action`, or `state,step=action` for a policy that changes over time.
///
/// The form of PRISM's `-exportstrat f:type=actions,states=false`; a step counts the steps elapsed. A choice
/// without a name is given by its index.
///
/// # Errors
/// What writing gives.
pub(super) fn write_policy(model: &IntervalMdp, policy: &Policy, out: &mut impl Write) -> io::Result<()> {
    let first_choices = first_choices(model);
    for state in StateId::first(model.num_states()) {
        let name = |choice: u32| {
            let row = model.choices().row_of_choice(state, choice);
            action_name(model, first_choices[state.index()] + u64::from(choice), row, choice)
        };
        match policy.horizon() {
            None => {
                if let Some(choice) = policy.choice(state, 0) {
                    writeln!(out, "{state}={}", name(choice))?;
                }
            }
            Some(horizon) => {
                for step in 0..horizon {
                    if let Some(choice) = policy.choice(state, step) {
                        writeln!(out, "{state},{step}={}", name(choice))?;
                    }
                }
            }
        }
    }
    Ok(())
}

/// Writes the lower bound of every cell, one per line.
///
/// # Errors
/// What writing gives.
pub(super) fn write_cell_values(lower: &[f64], out: &mut impl Write) -> io::Result<()> {
    lower.iter().try_for_each(|&value| writeln!(out, "{}", imdp::numeric::shortest_decimal(value)))
}

/// Writes `cell=input`, or `cell,step=input` for a policy that changes over time; a step counts the steps elapsed.
///
/// # Errors
/// What writing gives.
pub(super) fn write_cell_policy(policy: &Policy, cells: u32, out: &mut impl Write) -> io::Result<()> {
    for cell in 0..cells {
        for step in 0..policy.horizon().unwrap_or(1) {
            match (policy.choice(StateId(cell), step), policy.horizon()) {
                (None, _) => {}
                (Some(input), None) => writeln!(out, "{cell}=u_{input}")?,
                (Some(input), Some(_)) => writeln!(out, "{cell},{step}=u_{input}")?,
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
