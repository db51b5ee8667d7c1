//! The solution that a run holds, and what is wanted of one.

use super::appearance::SOLUTION;
use super::error::OpenError;
use super::files::RunFiles;
use crate::problem::{InputProblem, Problem};
use imdp::model::StateId;
use imdp::solution_file::{self, SolutionSubject};
use imdp::solver::{Solution, SolverOptions, Status};

/// The most grouped steps for which values are kept.
const MOST_STEPS: u64 = 60;

/// The most values that are kept for all steps together.
const MOST_VALUES: u64 = 600_000;

/// What controllers and reports need of a solution: the policy, and values with fewer steps left where they are few.
pub fn solution_options<'a>(problem: &Problem, options: &SolverOptions<'a>) -> SolverOptions<'a> {
    let memories = u64::from(problem.cell_task().memories());
    let maps = if memories > 1 { 1 + memories } else { 1 };
    let values = u64::from(problem.grid().num_cells()).saturating_mul(maps);
    let history = kept_steps(values, problem.horizon());
    SolverOptions { policy: true, history, ..*options }
}

/// What reports need of the solution of a problem whose actions are inputs; a task with a memory is another one later.
pub fn input_solution_options<'a>(problem: &InputProblem, options: &SolverOptions<'a>) -> SolverOptions<'a> {
    let has_memory = problem.cell_task().memories() > 1;
    let history = kept_steps(problem.grid().num_cells().into(), problem.horizon().filter(|_| !has_memory));
    SolverOptions { policy: true, history, ..*options }
}

/// For how many grouped steps so many values are kept.
fn kept_steps(values: u64, horizon: Option<u64>) -> usize {
    horizon.unwrap_or(0).min(MOST_STEPS).min((MOST_VALUES / values.max(1)).saturating_sub(1)) as usize
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
