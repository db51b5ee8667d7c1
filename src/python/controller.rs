//! Controllers, for one state or an array of them.

use crate::arrays::{Doubles, Whole, array, states};
use crate::errors::refused;
use dynabs::controller::RunMemory;
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use rayon::prelude::*;
use std::sync::Arc;

/// The feedback law c(x, k).
///
/// status, u = controller(x, k=0) looks at states after k groups of d steps. x is (n,) for one state or (m, n) for m of them, k
/// a number or m of them. status is a number or (m,), a dynabs.Status; u is (d, p) or (m, d, p), the inputs of the next d steps,
/// and not a number where the status is not 0. If the task has a memory it is status, u, memory = controller(x, k, memory): a
/// run begins with controller.start, or None, and every state at which the controller is asked is looked at once, in order.
#[pyclass(frozen, module = "dynabs")]
pub(crate) struct Controller {
    controller: Arc<dynabs::controller::Controller>,
}

/// States per parallel task.
const STATES_PER_TASK: usize = 1024;

#[pymethods]
impl Controller {
    /// n.
    #[getter]
    fn states(&self) -> usize {
        self.controller.state_dimension()
    }

    /// p, the inputs of one step.
    #[getter]
    fn inputs(&self) -> usize {
        self.controller.step_inputs()
    }

    /// d, the steps between two looks at the state.
    #[getter]
    fn group_steps(&self) -> usize {
        self.controller.group_steps()
    }

    /// In groups of steps; None if there is none.
    #[getter]
    fn horizon(&self) -> Option<u64> {
        self.controller.horizon()
    }

    /// The memory with which a run begins; None if the task needs none.
    #[getter]
    fn start(&self) -> Option<u32> {
        self.has_memory().then(|| self.controller.task().memories())
    }

    /// Statuses, inputs and, if the task has a memory, memories.
    #[pyo3(signature = (x, k=Whole::One(0), memory=None))]
    fn __call__<'py>(
        &self,
        py: Python<'py>,
        x: Doubles<'py>,
        k: Whole,
        memory: Option<Whole>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let controller = &*self.controller;
        let (n, d, p) = (controller.state_dimension(), controller.group_steps(), controller.step_inputs());
        let (alone, numbers) = states("x", &x, n)?;
        let count = numbers.len() / n;
        let elapsed = k.of("k", count)?;
        let mut memories = self.memories(memory, count)?;
        let mut statuses = vec![0i64; count];
        // A system may have no input, but parts of an array are not empty.
        let width = (d * p).max(1);
        let mut inputs = vec![f64::NAN; count * width];
        py.detach(|| {
            let asked = numbers.par_chunks_exact(n).zip(&elapsed).zip(&mut memories);
            let said = statuses.par_iter_mut().zip(inputs.par_chunks_exact_mut(width));
            said.zip(asked).with_min_len(STATES_PER_TASK).for_each(|((status, u), ((x, &k), memory))| {
                *status = controller.control(x, k, memory, &mut u[..d * p]).status().into();
            });
        });
        inputs.truncate(count * d * p);
        let numbers_of_memories = memories.iter().map(|memory| memory.number(self.memories_of_task()));
        let memories: Vec<u32> = numbers_of_memories.collect();
        let (has_memory, first) = (self.has_memory(), (statuses.first().copied(), memories.first().copied()));
        match (alone, has_memory) {
            (true, false) => (first.0, array(py, inputs, [d, p])?).into_bound_py_any(py),
            (true, true) => (first.0, array(py, inputs, [d, p])?, first.1).into_bound_py_any(py),
            (false, _) => {
                let statuses = array(py, statuses, count)?;
                let inputs = array(py, inputs, [count, d, p])?;
                if has_memory {
                    (statuses, inputs, array(py, memories, count)?).into_bound_py_any(py)
                } else {
                    (statuses, inputs).into_bound_py_any(py)
                }
            }
        }
    }
}

impl Controller {
    pub(crate) fn new(controller: Arc<dynabs::controller::Controller>) -> Self {
        Self { controller }
    }

    fn has_memory(&self) -> bool {
        self.controller.task().letters().is_some()
    }

    fn memories_of_task(&self) -> u32 {
        self.controller.task().memories()
    }

    /// What is remembered of so many runs.
    fn memories(&self, given: Option<Whole>, count: usize) -> PyResult<Vec<RunMemory>> {
        let Some(given) = given else { return Ok(vec![RunMemory::default(); count]) };
        if !self.has_memory() {
            return Err(refused("memory: found one; expected none, for the task needs none"));
        }
        let memories = self.memories_of_task();
        let memory = |number: u64| {
            let known = u32::try_from(number).ok().and_then(|number| RunMemory::of_number(number, memories));
            known.ok_or_else(|| {
                refused(format!("memory: found {number}; expected a number from 0 to {}", memories + 2))
            })
        };
        given.of("memory", count)?.into_iter().map(memory).collect()
    }
}
