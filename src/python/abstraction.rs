//! Abstractions, and their solution.

use crate::errors::refused;
use crate::imdp_model::Model;
use crate::problem::Given;
use crate::solution::{Solution, Solved};
use crate::work::interruptible;
use dynabs::abstraction::inputs::InputAbstraction;
use dynabs::model_file::StatedProblem;
use dynabs::run::{input_solution_options, solution_options};
use imdp::solver::{Answer, SolverOptions};
use pyo3::prelude::*;
use std::sync::Arc;

/// An interval MDP whose intervals are guaranteed, and what its states and actions mean.
#[pyclass(frozen, module = "dynabs")]
pub(crate) struct Abstraction {
    given: Arc<Given>,
    kind: Arc<Kind>,
}

/// What a problem was abstracted to.
pub(crate) enum Kind {
    Targets(Box<dynabs::abstraction::Abstraction>),
    Inputs(Box<InputAbstraction>),
}

#[pymethods]
impl Abstraction {
    /// What deserves a look.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        let warnings = match &*self.kind {
            Kind::Targets(abstraction) => &abstraction.warnings,
            Kind::Inputs(abstraction) => &abstraction.warnings,
        };
        warnings.iter().map(ToString::to_string).collect()
    }

    /// The property of the task, in PRISM's syntax (where actions are targets).
    #[getter]
    fn property(&self) -> PyResult<String> {
        self.targets().map(|abstraction| abstraction.property.to_string())
    }

    /// The interval MDP (where actions are targets): a dynabs.imdp.Model.
    #[getter]
    fn model(&self) -> PyResult<Model> {
        self.targets().map(|abstraction| Model::of(abstraction.model.clone()))
    }

    /// Solves the task: bounds on the probability of success from every cell, and the controller that attains them.
    fn solve(&self, py: Python<'_>) -> PyResult<Solution> {
        let solved = match (&self.given.stated, &*self.kind) {
            (StatedProblem::Targets(problem), Kind::Targets(abstraction)) => {
                let answer = interruptible(py, |stop| {
                    let options = SolverOptions { progress: stop, ..SolverOptions::default() };
                    let options = solution_options(problem, &options);
                    Answer::new(&abstraction.model, &abstraction.property, &options)
                })?;
                Solved::Targets(Box::new(answer.map_err(refused)?))
            }
            (StatedProblem::Inputs(problem), Kind::Inputs(abstraction)) => {
                let solution = interruptible(py, |stop| {
                    let options = SolverOptions { progress: stop, ..SolverOptions::default() };
                    abstraction.question().solve(&input_solution_options(problem, &options))
                })?;
                Solved::Inputs(solution)
            }
            _ => return Err(foreign()),
        };
        Solution::new(self.given.clone(), self.kind.clone(), solved, None)
    }
}

impl Abstraction {
    pub(crate) fn new(given: Arc<Given>, kind: Kind) -> Self {
        Self { given, kind: Arc::new(kind) }
    }

    fn targets(&self) -> PyResult<&dynabs::abstraction::Abstraction> {
        match &*self.kind {
            Kind::Targets(abstraction) => Ok(abstraction),
            Kind::Inputs(_) => Err(refused(
                "actions: found inputs, which are solved on a lattice; expected targets, whose model is an interval MDP in memory\n  \
                 dynabs compile writes the model of inputs as files, which dynabs.imdp.Model.read reads.",
            )),
        }
    }
}

/// What parts of different problems are.
pub(crate) fn foreign() -> PyErr {
    refused("found an abstraction of another problem; expected that of this one")
}
