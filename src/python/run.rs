//! Runs: directories that the command line and Python write and open.

use crate::abstraction::{Kind, foreign};
use crate::errors::refused;
use crate::problem::Given;
use crate::solution::{Solution, Solved};
use crate::work::interruptible;
use dynabs::model_file::StatedProblem;
use dynabs::run::{InputRun, Manifest, Run, WriteOptions, write_input_run, write_run};
use imdp::solver::SolverOptions;
use pyo3::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Opens a directory that `dynabs compile` or Solution.save wrote: a Solution, solved again if the directory has none.
///
/// Nothing in it is believed before its hash is that of the manifest.
#[pyfunction]
pub(crate) fn open(py: Python<'_>, directory: PathBuf) -> PyResult<Solution> {
    if InputRun::is_in(&directory) {
        let run = interruptible(py, |_| InputRun::open(&directory))?.map_err(refused)?;
        let solution = interruptible(py, |stop| {
            run.solution(&SolverOptions { progress: stop, ..SolverOptions::default() })
        })?;
        let InputRun { manifest, document, problem, abstraction, .. } = run;
        let given = Given::new(document, StatedProblem::Inputs(Box::new(problem)));
        let kind = Kind::Inputs(Box::new(abstraction));
        return Solution::new(given, Arc::new(kind), Solved::Inputs(solution), Some(manifest));
    }
    let run = interruptible(py, |stop| Run::open(&directory, stop))?.map_err(refused)?;
    let answer =
        interruptible(py, |stop| run.solve(&SolverOptions { progress: stop, ..SolverOptions::default() }))?;
    let answer = answer.map_err(refused)?;
    let Run { manifest, document, problem, abstraction, .. } = run;
    let given = Given::new(document, StatedProblem::Targets(Box::new(problem)));
    let kind = Kind::Targets(Box::new(abstraction));
    Solution::new(given, Arc::new(kind), Solved::Targets(Box::new(answer)), Some(manifest))
}

/// Writes a run; what was opened keeps its manifest.
///
/// # Errors
/// If the place is taken, or writing fails.
pub(crate) fn save(
    py: Python<'_>,
    (Given { document, source, stated }, manifest): (&Given, Option<&Manifest>),
    (kind, solved): (&Kind, &Solved),
    (directory, force): (&Path, bool),
) -> PyResult<()> {
    let options = WriteOptions { force, ..WriteOptions::default() };
    let written = match (stated, kind, solved) {
        (StatedProblem::Targets(problem), Kind::Targets(abstraction), Solved::Targets(answer)) => {
            interruptible(py, |stop| {
                let new = || Manifest::new(document, source, problem, abstraction);
                let manifest = manifest.cloned().unwrap_or_else(new);
                let options = WriteOptions { solution: Some(&answer.solution), ..options };
                write_run(directory, document, problem, abstraction, manifest, options, stop)
            })?
        }
        (StatedProblem::Inputs(problem), Kind::Inputs(abstraction), Solved::Inputs(solution)) => {
            interruptible(py, |stop| {
                let new = || Manifest::of_inputs(document, source, problem, abstraction);
                let manifest = manifest.cloned().unwrap_or_else(new);
                let solution = solution.of_pairs();
                let options = WriteOptions { solution: Some(&solution), ..options };
                write_input_run(directory, document, problem, None, manifest, &options, stop)
            })?
        }
        _ => return Err(foreign()),
    };
    written.map(drop).map_err(refused)
}
