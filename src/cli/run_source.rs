//! A run directory opened and solved: where controllers come from.

use super::{Bars, CliError};
use dynabs::controller::{Controller, ControllerError};
use dynabs::run::{OpenError, Run};
use imdp::files::is_fault_of_input;
use imdp::progress::Progress;
use imdp::solver::{Answer, SolverOptions, Status};
use std::path::Path;
use std::sync::Arc;

impl From<OpenError> for CliError {
    fn from(error: OpenError) -> Self {
        match error {
            OpenError::Io { error: ref io, .. } if !is_fault_of_input(io) => Self::Failure(error.to_string()),
            _ => Self::Input(error.to_string()),
        }
    }
}

impl From<ControllerError> for CliError {
    fn from(error: ControllerError) -> Self {
        Self::Failure(error.to_string())
    }
}

/// A run, solved, with its controller.
pub(super) struct Refined {
    pub(super) run: Run,
    pub(super) answer: Answer,
    pub(super) controller: Controller,
}

/// Opens a run, solves its task unless the run holds the solution, and refines the policy.
///
/// # Errors
/// [`CliError`] if the directory is no run, or if it was interrupted.
pub(super) fn refine(directory: &Path, bars: &Arc<Bars>) -> Result<Refined, CliError> {
    let run = Run::open(directory, &**bars)?;
    bars.catch_interrupts();
    let progress =
        |iteration, gap: f64| bars.note(|| format!("iteration {iteration}, bounds {gap:.1e} apart"));
    let options = SolverOptions {
        interrupt: Some(bars.interrupt()),
        progress: Some(&progress),
        ..SolverOptions::default()
    };
    let answer = run.solve(&options);
    bars.finish();
    let answer = answer.map_err(|error| CliError::Failure(error.to_string()))?;
    if answer.solution.status == Status::Interrupted {
        return Err(CliError::Interrupted);
    }
    let controller = Controller::new(&run.problem, &run.abstraction, &answer)?;
    Ok(Refined { run, answer, controller })
}
