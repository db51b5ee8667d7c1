//! Where runs start, and how sure one wants to be of what they show.

use super::CliError;
use dynabs::partition::{CellLookup, Grid};

/// A confidence.
pub(crate) fn probability(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|p| (0.5..1.0).contains(p));
    number.ok_or_else(|| "expected a number from 0.5 up to, but not including, 1".to_owned())
}

/// The state that runs start in.
pub(crate) fn start(from: Option<&str>, grid: &Grid, initial: Option<&[f64]>) -> Result<Vec<f64>, CliError> {
    let n = grid.dimension();
    let Some(text) = from else {
        return initial.map(<[f64]>::to_vec).ok_or_else(|| {
            let example = vec!["0"; n].join(",");
            CliError::Input(format!(
                "--from: found nothing, and the model has no initial state; expected {n} numbers such as --from={example}"
            ))
        });
    };
    let numbers: Option<Vec<f64>> =
        text.split(',').map(|x| x.trim().parse().ok().filter(|x: &f64| x.is_finite())).collect();
    let Some(x) = numbers.filter(|x| x.len() == n) else {
        return Err(CliError::Input(format!(
            "--from: found \"{text}\"; expected {n} numbers separated by commas, one per dimension of the state"
        )));
    };
    if CellLookup::new(grid).locate(&x).is_none() {
        return Err(CliError::Input(format!(
            "--from: found \"{text}\", outside the partition; expected a state in it, for which something is promised"
        )));
    }
    Ok(x)
}
