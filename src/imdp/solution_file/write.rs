//! Writing solutions.

use super::header::{FORMAT, Header};
use crate::model::StateId;
use crate::solver::{Policy, Solution};
use std::io::{self, Write};

/// Writes the solution of `property` on what the file with this SHA-256 says; equal solutions give equal bytes.
///
/// # Errors
/// Those of the writer, and [`io::ErrorKind::InvalidInput`] for a solution without a policy.
pub fn write(property: &str, sha256: &str, solution: &Solution, out: &mut impl Write) -> io::Result<()> {
    let policy = solution.policy.as_ref();
    let policy =
        policy.ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "no policy was computed"))?;
    let states = solution.values.lower.len();
    let header = Header {
        format: FORMAT.to_owned(),
        property: property.to_owned(),
        model: sha256.to_owned(),
        states,
        status: solution.status,
        iterations: solution.iterations,
        horizon: policy.horizon(),
        changes: policy.num_entries(),
        history: solution.history.len(),
    };
    serde_json::to_writer(&mut *out, &header)?;
    out.write_all(b"\n")?;
    numbers(&solution.values.lower, out)?;
    numbers(&solution.values.upper, out)?;
    changes(policy, states, out)?;
    solution.history.iter().try_for_each(|lower| numbers(lower, out))
}

fn numbers(values: &[f64], out: &mut impl Write) -> io::Result<()> {
    values.iter().try_for_each(|value| out.write_all(&value.to_le_bytes()))
}

fn changes(policy: &Policy, states: usize, out: &mut impl Write) -> io::Result<()> {
    let states = StateId::first(states);
    states.clone().try_for_each(|s| out.write_all(&(policy.changes(s).len() as u32).to_le_bytes()))?;
    for (left, choice) in states.flat_map(|s| policy.changes(s)) {
        out.write_all(&left.to_le_bytes())?;
        out.write_all(&choice.to_le_bytes())?;
    }
    Ok(())
}
