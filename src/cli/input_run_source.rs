//! A run whose actions are inputs, opened and solved.

use super::{Bars, CliError};
use dynabs::landing::LandingSolution;
use dynabs::run::InputRun;
use imdp::progress::Progress;
use imdp::solver::{SolverOptions, Status};
use std::path::Path;

/// A run, solved.
pub(super) struct SolvedInputs {
    pub(super) run: InputRun,
    pub(super) solution: LandingSolution,
}

impl SolvedInputs {
    /// Opens a run and solves its task: the same every time.
    ///
    /// # Errors
    /// [`CliError`] if the directory is no run, or if it was interrupted.
    pub(super) fn open(directory: &Path, options: &SolverOptions<'_>, bars: &Bars) -> Result<Self, CliError> {
        let run = InputRun::open(directory)?;
        let progress =
            |step, change: f64| bars.note(|| format!("step {step}, values change by {change:.1e}"));
        let options =
            SolverOptions { interrupt: Some(bars.interrupt()), progress: Some(&progress), ..*options };
        let solution = run.solve(&options);
        bars.finish();
        if solution.status == Status::Interrupted {
            return Err(CliError::Interrupted);
        }
        Ok(Self { run, solution })
    }
}
