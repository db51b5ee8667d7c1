//! Solutions: what is guaranteed from where, and the controller.

use crate::arrays::{Doubles, array, states};
use crate::controller::Controller;
use crate::problem::grid;
use crate::simulation::{self, simulate, trajectory};
use dynabs::model_file::StatedProblem;
use dynabs::partition::{CellId, GridAxis};
use numpy::{IxDyn, PyArray, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::Arc;

/// What is guaranteed from where, and the controller that attains it.
#[pyclass(frozen, module = "dynabs")]
pub(crate) struct Solution {
    stated: Arc<StatedProblem>,
    controller: Arc<dynabs::controller::Controller>,
    /// By cell.
    upper: Vec<f64>,
}

/// A number for each cell, in the shape of the partition.
type OfCells<'py> = Bound<'py, PyArray<f64, IxDyn>>;

#[pymethods]
impl Solution {
    /// The guaranteed probability of success from every cell, in the shape of the partition.
    #[getter]
    fn lower<'py>(&self, py: Python<'py>) -> PyResult<OfCells<'py>> {
        let cells = (0..self.controller.num_cells()).map(CellId);
        self.of_cells(py, cells.map(|cell| self.controller.bound(cell)).collect())
    }

    /// An upper bound on what the abstraction allows, in the shape of the partition.
    #[getter]
    fn upper<'py>(&self, py: Python<'py>) -> PyResult<OfCells<'py>> {
        self.of_cells(py, self.upper.clone())
    }

    /// The guaranteed probability of success from the initial state, or from the worst cell that has an action.
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

    /// The guaranteed probability of success from a state, (n,), or states, (m, n): a number or (m,); 0 outside the partition.
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
        let from = simulation::start(&self.stated, &self.controller, start)?;
        simulate(py, (&self.stated, &self.controller), &from, (runs, seed, most_steps), confidence)
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
        let from = simulation::start(&self.stated, &self.controller, start)?;
        trajectory(py, (&self.stated, &self.controller), &from, (run, seed, most_steps))
    }
}

impl Solution {
    pub(crate) fn new(
        stated: Arc<StatedProblem>,
        controller: dynabs::controller::Controller,
        upper: Vec<f64>,
    ) -> Self {
        Self { stated, controller: Arc::new(controller), upper }
    }

    fn of_cells<'py>(&self, py: Python<'py>, numbers: Vec<f64>) -> PyResult<OfCells<'py>> {
        let shape: Vec<usize> =
            grid(&self.stated).axes().iter().map(GridAxis::cells).map(|cells| cells as usize).collect();
        let count = numbers.len();
        array(py, numbers, count)?.reshape(shape)
    }
}
