//! Properties answered, and certificates.

use crate::arrays::array;
use crate::errors::refused;
use crate::imdp_model::Model;
use crate::work::interruptible;
use imdp::certificate::{self, FileDigest, Statement, read_statement_file};
use imdp::evaluation::{Evaluation, check_derivation, direct};
use imdp::files::Outputs;
use imdp::model::{IntervalMdp, StateId};
use imdp::progress::Progress;
use imdp::property::{Definitions, Inquiry, Verdict, parse_inquiry};
use imdp::solver::{Answer, SolverOptions, ValueBounds};
use imdp::verify::check;
use numpy::{Ix1, PyArray};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Bounds on a property in every state; of a formula, 1 where it holds and 0 where it does not.
#[pyclass(frozen, name = "Result", module = "dynabs.imdp")]
pub(crate) struct PropertyResult {
    values: ValueBounds,
    initial: Vec<usize>,
    verdict: Option<Verdict>,
}

/// A property in PRISM's syntax.
pub(crate) struct Asked(Inquiry);

/// An answer with what proves it, if that was wanted.
struct Answered {
    result: PropertyResult,
    proof: Option<Statement>,
}

#[pymethods]
impl PropertyResult {
    /// Lower bounds, (states,).
    #[getter]
    fn lower<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray<f64, Ix1>>> {
        array(py, self.values.lower.clone(), self.values.lower.len())
    }

    /// Upper bounds, (states,).
    #[getter]
    fn upper<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray<f64, Ix1>>> {
        array(py, self.values.upper.clone(), self.values.upper.len())
    }

    /// The least lower and the greatest upper bound of the initial states.
    #[getter]
    fn value(&self) -> (f64, f64) {
        let initial = || self.initial.iter();
        let lower = initial().map(|&state| self.values.lower[state]).fold(f64::INFINITY, f64::min);
        (lower, initial().map(|&state| self.values.upper[state]).fold(f64::NEG_INFINITY, f64::max))
    }

    /// Whether a threshold or formula holds in the initial states: None if it is none, or undecided.
    #[getter]
    fn holds(&self) -> Option<bool> {
        match self.verdict? {
            Verdict::Holds => Some(true),
            Verdict::Fails => Some(false),
            Verdict::Unknown => None,
        }
    }
}

impl Asked {
    pub(crate) fn parse(text: &str) -> PyResult<Self> {
        let inquiry = parse_inquiry(text, &Definitions::default());
        inquiry.map(Self).map_err(|error| refused(format!("property: {error}")))
    }

    /// The answer; with digests of the model's files, its proof too.
    pub(crate) fn answer(
        &self,
        model: &IntervalMdp,
        progress: &dyn Progress,
        digests: Option<Vec<FileDigest>>,
    ) -> Result<PropertyResult, String> {
        self.answered(model, progress, digests).map(|answered| answered.result)
    }

    fn answered(
        &self,
        model: &IntervalMdp,
        progress: &dyn Progress,
        digests: Option<Vec<FileDigest>>,
    ) -> Result<Answered, String> {
        let options = SolverOptions { progress, evidence: digests.is_some(), ..SolverOptions::default() };
        let initial = model.initial().ones().collect();
        match &self.0 {
            Inquiry::Probability(property) => {
                let property = direct(property.clone(), model, None);
                let mut answer =
                    Answer::new(model, &property, &options).map_err(|error| error.to_string())?;
                let proof = digests.and_then(|digests| answer.certificate(&property, digests));
                let proof = proof.map(|proof| Statement::Probability(Box::new(proof)));
                let result = PropertyResult { values: answer.values, initial, verdict: answer.verdict };
                Ok(Answered { result, proof })
            }
            Inquiry::Compound(compound) => {
                let evaluation = Evaluation::new(model, compound, None, &options);
                let mut evaluation = evaluation.map_err(|error| error.to_string())?;
                let verdicts =
                    model.initial().ones().map(|state| evaluation.verdict(StateId::from_index(state)));
                let verdict = verdicts.collect::<Option<Vec<_>>>().map(together);
                let proof = digests.and_then(|digests| evaluation.derivation(compound, None, model, digests));
                let values = evaluation.value_bounds(model.num_states());
                Ok(Answered {
                    result: PropertyResult { values, initial, verdict },
                    proof: proof.map(Statement::Expression),
                })
            }
        }
    }
}

/// Whether something holds in all of some states.
fn together(verdicts: Vec<Verdict>) -> Verdict {
    if verdicts.contains(&Verdict::Fails) {
        Verdict::Fails
    } else if verdicts.contains(&Verdict::Unknown) {
        Verdict::Unknown
    } else {
        Verdict::Holds
    }
}

/// Answers a property and writes the certificate.
pub(crate) fn certified(
    asked: &Asked,
    (model, digests): (&IntervalMdp, Vec<FileDigest>),
    path: &Path,
    progress: &dyn Progress,
) -> Result<PropertyResult, String> {
    let Answered { result, proof } = asked.answered(model, progress, Some(digests))?;
    let mut text = vec![];
    let written = match proof {
        Some(Statement::Probability(proof)) => certificate::write(&proof, &mut text),
        Some(Statement::Expression(proof)) => certificate::write_derivation(&proof, &mut text),
        None => {
            return Err("property: found one with a part that nothing proves; expected F, G, U, X, R or LTL"
                .to_owned());
        }
    };
    let mut files = Outputs::default();
    let placed =
        written.and_then(|()| files.write(path, |out| out.write_all(&text))).and_then(|()| files.commit());
    placed.map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(result)
}

/// Checks a certificate against a model, in exact arithmetic: verify(certificate, model).
///
/// Returns a dict (property, lower, upper, states, steps, rows): what was proved of which property; what does not follow is an
/// Error.
#[pyfunction]
pub(crate) fn verify<'py>(
    py: Python<'py>,
    certificate: PathBuf,
    model: &Model,
) -> PyResult<Bound<'py, PyDict>> {
    let digests = model.digests(py)?;
    let proved = interruptible(py, |_| {
        let statement = read_statement_file(&certificate).map_err(|error| error.to_string())?;
        let outcome = match &statement {
            Statement::Probability(certificate) => check(certificate, model.model(), &digests),
            Statement::Expression(derivation) => check_derivation(derivation, model.model(), &digests),
        };
        let property = match &statement {
            Statement::Probability(certificate) => certificate.property.to_string(),
            Statement::Expression(derivation) => derivation.expression.clone(),
        };
        outcome.map(|proved| (property, proved)).map_err(|rejection| rejection.to_string())
    })?;
    let (property, proved) =
        proved.map_err(|error| refused(format!("{}: {error}", certificate.display())))?;
    let said = PyDict::new(py);
    said.set_item("property", property)?;
    said.set_item("lower", proved.lower)?;
    said.set_item("upper", proved.upper)?;
    said.set_item("states", proved.states)?;
    said.set_item("steps", proved.steps)?;
    said.set_item("rows", proved.rows)?;
    Ok(said)
}
