//! Abstractions, and their solution.

use crate::errors::refused;
use crate::imdp_model::Model;
use crate::problem::grid;
use crate::solution::Solution;
use crate::work::interruptible;
use dynabs::abstraction::inputs::InputAbstraction;
use dynabs::controller::Controller;
use dynabs::model_file::StatedProblem;
use imdp::solver::{Answer, SolverOptions};
use pyo3::prelude::*;
use std::sync::Arc;

/// An interval MDP whose intervals are guaranteed, and what its states and actions mean.
#[pyclass(frozen, module = "dynabs")]
pub(crate) struct Abstraction {
    stated: Arc<StatedProblem>,
    kind: Kind,
}

enum Kind {
    Targets(Box<dynabs::abstraction::Abstraction>),
    Inputs(Box<InputAbstraction>),
}

#[pymethods]
impl Abstraction {
    /// What deserves a look.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        let warnings = match &self.kind {
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
        match (&*self.stated, &self.kind) {
            (StatedProblem::Targets(problem), Kind::Targets(abstraction)) => {
                let answer = interruptible(py, |stop| {
                    let options = SolverOptions { policy: true, progress: stop, ..SolverOptions::default() };
                    Answer::new(&abstraction.model, &abstraction.property, &options)
                })?;
                let answer = answer.map_err(refused)?;
                let controller = Controller::new(problem, abstraction, &answer).map_err(refused)?;
                let upper = abstraction.state_of_cell.iter().map(|state| answer.values.upper[state.index()]);
                Ok(Solution::new(self.stated.clone(), controller, upper.collect()))
            }
            (StatedProblem::Inputs(problem), Kind::Inputs(abstraction)) => {
                let solution = interruptible(py, |stop| {
                    let options = SolverOptions { progress: stop, ..SolverOptions::default() };
                    abstraction.question().solve(&options)
                })?;
                let controller = Controller::of_inputs(problem, abstraction, &solution);
                let cells = grid(&self.stated).num_cells() as usize;
                let upper = solution.values.upper[..cells].to_vec();
                Ok(Solution::new(self.stated.clone(), controller, upper))
            }
            _ => Err(refused("found an abstraction of another problem; expected that of this one")),
        }
    }
}

impl Abstraction {
    pub(crate) fn of_targets(
        stated: Arc<StatedProblem>,
        abstraction: dynabs::abstraction::Abstraction,
    ) -> Self {
        Self { stated, kind: Kind::Targets(Box::new(abstraction)) }
    }

    pub(crate) fn of_inputs(stated: Arc<StatedProblem>, abstraction: InputAbstraction) -> Self {
        Self { stated, kind: Kind::Inputs(Box::new(abstraction)) }
    }

    fn targets(&self) -> PyResult<&dynabs::abstraction::Abstraction> {
        match &self.kind {
            Kind::Targets(abstraction) => Ok(abstraction),
            Kind::Inputs(_) => Err(refused(
                "actions: found inputs, which are solved on a lattice; expected targets, whose model is an interval MDP in memory\n  \
                 dynabs compile writes the model of inputs as files, which dynabs.imdp.Model.read reads.",
            )),
        }
    }
}
