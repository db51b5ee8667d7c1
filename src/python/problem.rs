//! Problems, read from documents.

use crate::abstraction::{Abstraction, Kind};
use crate::arrays::array;
use crate::errors::{mistake, refused};
use crate::work::interruptible;
use dynabs::abstraction::compile;
use dynabs::abstraction::inputs::InputAbstraction;
use dynabs::model_file::{Document, StatedProblem};
use dynabs::partition::{Grid, GridAxis};
use imdp::numeric::to_f64;
use numpy::{Ix1, PyArray};
use pyo3::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A control problem: dynamics, noise, inputs, partition, task.
///
/// Problem(document, directory=".") takes what a model file says as a dict (docs/guide.md); wherever the file has lists of
/// numbers, arrays will do. Files that it names are looked for in the directory.
#[pyclass(frozen, module = "dynabs")]
pub(crate) struct Problem {
    given: Arc<Given>,
}

/// What was given: a document, and the problem that it states.
pub(crate) struct Given {
    pub(crate) document: Document,
    /// Its text, as it was read.
    pub(crate) source: String,
    pub(crate) stated: StatedProblem,
}

impl Given {
    /// What a run holds, whose text nobody asks for: it has a manifest.
    pub(crate) fn new(document: Document, stated: StatedProblem) -> Arc<Self> {
        Arc::new(Self { document, source: String::new(), stated })
    }
}

/// One number for each dimension of the state.
type Numbers<'py> = Bound<'py, PyArray<f64, Ix1>>;

#[pymethods]
impl Problem {
    #[new]
    #[pyo3(signature = (document, directory=PathBuf::from(".")))]
    fn new(py: Python<'_>, document: Bound<'_, PyAny>, directory: PathBuf) -> PyResult<Self> {
        let text: String = py.import("dynabs._document")?.call_method1("text", (document,))?.extract()?;
        Self::parsed(py, &directory.join("problem"), &text)
    }

    /// Reads a model file; files that it names are looked for beside it.
    #[staticmethod]
    fn read(py: Python<'_>, path: PathBuf) -> PyResult<Self> {
        let text = imdp::files::read_text(&path);
        let text = text
            .map_err(|error| refused(format!("{}: found {error}; expected a model file", path.display())))?;
        Self::parsed(py, &path, &text)
    }

    /// The name.
    #[getter]
    fn name(&self) -> &str {
        match &self.given.stated {
            StatedProblem::Targets(problem) => problem.name(),
            StatedProblem::Inputs(problem) => problem.name(),
        }
    }

    /// "targets" or "inputs".
    #[getter]
    fn actions(&self) -> &'static str {
        match &self.given.stated {
            StatedProblem::Targets(_) => "targets",
            StatedProblem::Inputs(_) => "inputs",
        }
    }

    /// The number of cells in each dimension.
    #[getter]
    fn cells(&self) -> Vec<u32> {
        self.grid().axes().iter().map(GridAxis::cells).collect()
    }

    /// The lower faces of the partition, (n,).
    #[getter]
    fn lower<'py>(&self, py: Python<'py>) -> PyResult<Numbers<'py>> {
        self.sides(py, GridAxis::lower)
    }

    /// The upper faces of the partition, (n,).
    #[getter]
    fn upper<'py>(&self, py: Python<'py>) -> PyResult<Numbers<'py>> {
        self.sides(py, GridAxis::upper)
    }

    /// The state that runs start in, (n,); None if there is none.
    #[getter]
    fn initial_state<'py>(&self, py: Python<'py>) -> PyResult<Option<Numbers<'py>>> {
        let initial = match &self.given.stated {
            StatedProblem::Targets(problem) => problem.initial_state(),
            StatedProblem::Inputs(problem) => problem.initial_state(),
        };
        initial.map(|x| array(py, x.to_vec(), x.len())).transpose()
    }

    /// The number of (grouped) steps; None if there is no horizon.
    #[getter]
    fn horizon(&self) -> Option<u64> {
        match &self.given.stated {
            StatedProblem::Targets(problem) => problem.horizon(),
            StatedProblem::Inputs(problem) => problem.horizon(),
        }
    }

    /// What deserves a look.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        let warnings = match &self.given.stated {
            StatedProblem::Targets(problem) => problem.warnings(),
            StatedProblem::Inputs(problem) => problem.warnings(),
        };
        warnings.iter().map(ToString::to_string).collect()
    }

    /// Abstracts the problem to an interval MDP whose intervals are guaranteed.
    fn compile(&self, py: Python<'_>) -> PyResult<Abstraction> {
        match &self.given.stated {
            StatedProblem::Targets(problem) => {
                let abstraction = interruptible(py, |stop| compile(problem, stop))?.map_err(refused)?;
                let abstraction = abstraction.with_costs(problem).map_err(refused)?;
                Ok(Abstraction::new(self.given.clone(), Kind::Targets(Box::new(abstraction))))
            }
            StatedProblem::Inputs(problem) => {
                let abstraction = interruptible(py, |_| InputAbstraction::new(problem))?;
                let kind = Kind::Inputs(Box::new(abstraction.map_err(refused)?));
                Ok(Abstraction::new(self.given.clone(), kind))
            }
        }
    }
}

impl Problem {
    fn parsed(py: Python<'_>, path: &Path, text: &str) -> PyResult<Self> {
        let given = interruptible(py, |_| {
            let document = Document::parse(path, text)?;
            let stated = document.stated()?;
            Ok(Given { document, source: text.to_owned(), stated })
        })?;
        Ok(Self { given: Arc::new(given.map_err(|error| mistake(&error))?) })
    }

    fn grid(&self) -> &Grid {
        grid(&self.given.stated)
    }

    fn sides<'py>(
        &self,
        py: Python<'py>,
        side: impl Fn(&GridAxis) -> &imdp::numeric::Rational,
    ) -> PyResult<Numbers<'py>> {
        let sides: Vec<f64> = self.grid().axes().iter().map(|axis| to_f64(side(axis))).collect();
        let n = sides.len();
        array(py, sides, n)
    }
}

/// The partition of a problem.
pub(crate) fn grid(stated: &StatedProblem) -> &Grid {
    match stated {
        StatedProblem::Targets(problem) => problem.grid(),
        StatedProblem::Inputs(problem) => problem.grid(),
    }
}
