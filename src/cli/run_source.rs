//! A run directory opened, with the solution that it holds or a new one: where controllers come from.

use super::input_run_source::SolvedInputs;
use super::{Bars, CliError};
use dynabs::controller::{Controller, ControllerError};
use dynabs::partition::{CellId, Grid};
use dynabs::run::{InputRun, OpenError, Run};
use imdp::files::is_fault_of_input;
use imdp::model::require_memory;
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
    let options = SolverOptions { progress: &**bars, ..SolverOptions::default() };
    let answer = run.solve(&options);
    bars.finish();
    let answer = answer.map_err(|error| CliError::Failure(error.to_string()))?;
    if answer.solution.status == Status::Interrupted {
        return Err(CliError::Interrupted);
    }
    let controller = Controller::new(&run.problem, &run.abstraction, &answer)?;
    Ok(Refined { run, answer, controller })
}

/// What a cell takes in a text: its bound, its kind, its place in tables and plots.
const BYTES_OF_CELL: u64 = 240;

/// What a decision takes in a text: two numbers, as values of JSON or digits.
const BYTES_OF_ENTRY: u64 = 180;

/// A run with its controller, whatever its actions are.
pub(super) enum Controlled {
    /// Actions are targets.
    Targets(Box<Refined>),
    /// Actions are inputs.
    Inputs(Box<SolvedInputs>, Box<Controller>),
}

impl Controlled {
    /// Opens a run, solves its task unless the run holds the solution, and refines the policy.
    ///
    /// # Errors
    /// [`CliError`] if the directory is no run, or if it was interrupted.
    pub(super) fn open(directory: &Path, bars: &Arc<Bars>) -> Result<Self, CliError> {
        if !InputRun::is_in(directory) {
            return refine(directory, bars).map(|refined| Self::Targets(Box::new(refined)));
        }
        bars.catch_interrupts();
        let SolvedInputs { run, solution } = SolvedInputs::open(directory, None, bars)?;
        let controller = Controller::of_inputs(&run.problem, &run.abstraction, &solution);
        Ok(Self::Inputs(Box::new(SolvedInputs { run, solution }), Box::new(controller)))
    }

    /// The controller.
    pub(super) fn controller(&self) -> &Controller {
        match self {
            Self::Targets(refined) => &refined.controller,
            Self::Inputs(_, controller) => controller,
        }
    }

    /// Fails if the controller as text, whole and in pieces, may not fit into memory.
    ///
    /// # Errors
    /// [`CliError::Input`] with the estimate and `remedy`.
    pub(super) fn require_text(&self, what: &str, remedy: &str) -> Result<(), CliError> {
        let controller = self.controller();
        let cells = || (0..controller.num_cells()).map(CellId);
        let of_memory =
            |memory| cells().map(|cell| controller.entries(memory, cell).len() as u64).sum::<u64>();
        let memories = controller.task().memories();
        let entries: u64 = (0..memories).map(of_memory).sum();
        let bytes = BYTES_OF_CELL * u64::from(controller.num_cells()) * u64::from(memories)
            + BYTES_OF_ENTRY * entries;
        require_memory(what, bytes).map_err(|error| CliError::Input(format!("{error}\n  {remedy}")))
    }

    /// The name of the model.
    pub(super) fn name(&self) -> &str {
        match self {
            Self::Targets(refined) => refined.run.problem.name(),
            Self::Inputs(solved, _) => solved.run.problem.name(),
        }
    }

    /// The partition.
    pub(super) fn grid(&self) -> &Grid {
        match self {
            Self::Targets(refined) => refined.run.problem.grid(),
            Self::Inputs(solved, _) => solved.run.problem.grid(),
        }
    }

    /// The state from which the guarantee is wanted, if it is one.
    pub(super) fn initial_state(&self) -> Option<&[f64]> {
        match self {
            Self::Targets(refined) => refined.run.problem.initial_state(),
            Self::Inputs(solved, _) => solved.run.problem.initial_state(),
        }
    }
}
