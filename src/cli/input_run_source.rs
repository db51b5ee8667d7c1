//! A run whose actions are inputs, opened and solved.

use super::{Bars, CliError};
use dynabs::landing::LandingSolution;
use dynabs::run::InputRun;
use imdp::progress::Progress;
use imdp::ranks;
use imdp::solver::{SolverOptions, Status};
use std::path::Path;

/// A run, solved.
pub(super) struct SolvedInputs {
    pub(super) run: InputRun,
    pub(super) solution: LandingSolution,
}

impl SolvedInputs {
    /// Opens a run and solves its task as these options say; without any, unless the run holds the solution.
    ///
    /// # Errors
    /// [`CliError`] if the directory is no run, or if it was interrupted.
    pub(super) fn open(
        directory: &Path,
        given: Option<&SolverOptions<'_>>,
        bars: &Bars,
    ) -> Result<Self, CliError> {
        let run = InputRun::open(directory)?;
        ranks::require_same(&run.problem);
        let options = given.copied().unwrap_or_default();
        let options = SolverOptions { progress: bars, ..options };
        let solution = match given {
            Some(_) => run.solve(&options),
            None => run.solution(&options),
        };
        bars.finish();
        if solution.status == Status::Interrupted {
            return Err(CliError::Interrupted);
        }
        Ok(Self { run, solution })
    }
}
