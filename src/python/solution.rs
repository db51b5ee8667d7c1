//! Solutions: what is guaranteed from where, and the controller.

use crate::abstraction::{Kind, foreign};
use crate::arrays::{Doubles, array, states};
use crate::controller::Controller;
use crate::errors::refused;
use crate::problem::{Given, grid};
use crate::run::save;
use crate::simulation::{self, simulate, trajectory};
use dynabs::landing::LandingSolution;
use dynabs::model_file::StatedProblem;
use dynabs::partition::{CellId, GridAxis};
use dynabs::run::Manifest;
use imdp::model::StateId;
use imdp::solver::Answer;
use numpy::{IxDyn, PyArray, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::sync::Arc;

/// What is guaranteed from where, and the controller that attains it.
#[pyclass(frozen, module = "dynabs")]
pub(crate) struct Solution {
    given: Arc<Given>,
    kind: Arc<Kind>,
    solved: Solved,
    controller: Arc<dynabs::controller::Controller>,
    /// What the run was that this was opened from.
    manifest: Option<Manifest>,
}

/// Bounds and a policy.
pub(crate) enum Solved {
    Targets(Box<Answer>),
    Inputs(LandingSolution),
}

/// A number for each cell, in the shape of the partition.
type OfCells<'py> = Bound<'py, PyArray<f64, IxDyn>>;

#[pymethods]
impl Solution {
    /// A lower bound on the probability of success from every cell, in the shape of the partition: guaranteed with `confidence`.
    #[getter]
    fn lower<'py>(&self, py: Python<'py>) -> PyResult<OfCells<'py>> {
        let cells = (0..self.controller.num_cells()).map(CellId);
        self.of_cells(py, cells.map(|cell| self.controller.bound(cell)).collect())
    }

    /// An upper bound on what the abstraction allows, in the shape of the partition.
    #[getter]
    fn upper<'py>(&self, py: Python<'py>) -> PyResult<OfCells<'py>> {
        let upper = match (&*self.kind, &self.solved) {
            (Kind::Targets(abstraction), Solved::Targets(answer)) => {
                let of_state = |state: &StateId| answer.values.upper[state.index()];
                abstraction.state_of_cell.iter().map(of_state).collect()
            }
            (Kind::Inputs(_), Solved::Inputs(solution)) => {
                solution.values.upper[..self.controller.num_cells() as usize].to_vec()
            }
            _ => return Err(foreign()),
        };
        self.of_cells(py, upper)
    }

    /// The confidence with which bounds are guaranteed, 1 if the noise is known; None in reference mode, where nothing is.
    #[getter]
    fn confidence(&self) -> Option<f64> {
        self.controller.guarantee().confidence()
    }

    /// The lower bound from the initial state, or from the worst cell that has an action.
    #[getter]
    fn bound(&self) -> f64 {
        self.controller.promised().bound
    }

    /// What is promised, and what that rests on, in words.
    #[getter]
    fn promise(&self) -> String {
        self.controller.promise().join(" ")
    }

    /// The controller that attains the bounds.
    #[getter]
    fn controller(&self) -> Controller {
        Controller::new(self.controller.clone())
    }

    /// The lower bound from a state, (n,), or states, (m, n): a number or (m,); 0 outside the partition.
    fn lower_at<'py>(&self, py: Python<'py>, x: Doubles<'py>) -> PyResult<Bound<'py, PyAny>> {
        let n = self.controller.state_dimension();
        let (alone, numbers) = states("x", &x, n)?;
        let bounds: Vec<f64> =
            py.detach(|| numbers.chunks_exact(n).map(|x| self.controller.bound_at(x)).collect());
        match bounds[..] {
            [bound] if alone => Ok(bound.into_pyobject(py)?.into_any()),
            _ => {
                let count = bounds.len();
                Ok(array(py, bounds, count)?.into_any())
            }
        }
    }

    /// Runs the closed loop with the original system and its noise: how often the task was done, with a Clopper-Pearson interval.
    ///
    /// Runs start in `start`, or in the problem's initial state; those of unbounded tasks end after `most_steps` steps. The same
    /// seed gives the same runs. Returns a dict: runs, satisfied, lower, upper, confidence, promised, contradicted, ended, steps,
    /// violations (inputs outside of U: none).
    #[pyo3(signature = (runs=100_000, seed=0, start=None, most_steps=10_000, confidence=0.99))]
    fn simulate<'py>(
        &self,
        py: Python<'py>,
        runs: u64,
        seed: u64,
        start: Option<Doubles<'py>>,
        most_steps: u64,
        confidence: f64,
    ) -> PyResult<Bound<'py, PyDict>> {
        let from = simulation::start(&self.given.stated, &self.controller, start)?;
        simulate(py, (&self.given.stated, &self.controller), &from, (runs, seed, most_steps), confidence)
    }

    /// Writes the directory that `dynabs compile --solve --no-tra` writes, for `dynabs report`, `export`, `simulate` and dynabs.open.
    ///
    /// All files appear or none. With force, a run that is there already is replaced.
    #[pyo3(signature = (directory, force=false))]
    fn save(&self, py: Python<'_>, directory: PathBuf, force: bool) -> PyResult<()> {
        let given = (&*self.given, self.manifest.as_ref());
        save(py, given, (&self.kind, &self.solved), (&directory, force))
    }

    /// Run number `run` of those, step by step. Returns a dict: states (steps + 1, n), inputs (steps, p), satisfied.
    #[pyo3(signature = (run=0, seed=0, start=None, most_steps=10_000))]
    fn trajectory<'py>(
        &self,
        py: Python<'py>,
        run: u64,
        seed: u64,
        start: Option<Doubles<'py>>,
        most_steps: u64,
    ) -> PyResult<Bound<'py, PyDict>> {
        let from = simulation::start(&self.given.stated, &self.controller, start)?;
        trajectory(py, (&self.given.stated, &self.controller), &from, (run, seed, most_steps))
    }
}

impl Solution {
    /// The controller of what was solved.
    ///
    /// # Errors
    /// If the parts are of different problems, or make no controller: a mistake in this program.
    pub(crate) fn new(
        given: Arc<Given>,
        kind: Arc<Kind>,
        solved: Solved,
        manifest: Option<Manifest>,
    ) -> PyResult<Self> {
        let controller = match (&given.stated, &*kind, &solved) {
            (StatedProblem::Targets(problem), Kind::Targets(abstraction), Solved::Targets(answer)) => {
                dynabs::controller::Controller::new(problem, abstraction, answer).map_err(refused)?
            }
            (StatedProblem::Inputs(problem), Kind::Inputs(abstraction), Solved::Inputs(solution)) => {
                dynabs::controller::Controller::of_inputs(problem, abstraction, solution)
            }
            _ => return Err(foreign()),
        };
        Ok(Self { given, kind, solved, controller: Arc::new(controller), manifest })
    }

    fn of_cells<'py>(&self, py: Python<'py>, numbers: Vec<f64>) -> PyResult<OfCells<'py>> {
        let shape: Vec<usize> =
            grid(&self.given.stated).axes().iter().map(GridAxis::cells).map(|cells| cells as usize).collect();
        let count = numbers.len();
        array(py, numbers, count)?.reshape(shape)
    }
}
