//! The solution that a run holds, and what is wanted of one.

use super::appearance::SOLUTION;
use super::error::OpenError;
use super::files::RunFiles;
use crate::problem::Problem;
use imdp::model::StateId;
use imdp::solution_file::{self, SolutionSubject};
use imdp::solver::{Solution, SolverOptions, Status};

/// The most grouped steps for which values are kept.
const MOST_STEPS: u64 = 60;

/// The most values that are kept for all steps together.
const MOST_VALUES: u64 = 600_000;

/// What controllers and reports need of a solution: the policy, and values with fewer steps left where they are few.
pub fn solution_options<'a>(problem: &Problem, options: &SolverOptions<'a>) -> SolverOptions<'a> {
    let cells = u64::from(problem.grid().num_cells());
    let steps = problem.horizon().unwrap_or(0).min(MOST_STEPS).min((MOST_VALUES / cells).saturating_sub(1));
    SolverOptions { policy: true, history: steps as usize, ..*options }
}

/// What a solution on the lattice is of; the problem says the rest.
pub(super) const ON_LATTICE: &str = "the task, by memory and cell";

/// Whether a solution is as good as another computation would be.
pub(super) fn is_final(solution: &Solution) -> bool {
    solution.policy.is_some()
        && matches!(solution.status, Status::HorizonReached | Status::Converged | Status::PrecisionLimit)
}

/// The solution of `property` that a run holds, if it does: of what `file` says, with so many states and these choices.
pub(super) fn stored(
    files: &RunFiles,
    (file, property): (&str, &str),
    states: usize,
    is_choice: &dyn Fn(StateId, u32) -> bool,
) -> Result<Option<Solution>, OpenError> {
    let Some(sha256) = files.sha256(file).filter(|_| files.sha256(SOLUTION).is_some()) else {
        return Ok(None);
    };
    let subject = SolutionSubject { property, sha256, states, is_choice };
    let solution = solution_file::read(&files.read(SOLUTION)?, &subject);
    solution.map(Some).map_err(|error| OpenError::Solution { path: files.path(SOLUTION), error })
}
