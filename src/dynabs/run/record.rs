//! A run directory as one side of a comparison.

use super::appearance::PROBLEM;
use super::error::OpenError;
use super::files::RunFiles;
use super::manifest::Manifest;
use super::open::problem_document;
use crate::Diagnostic;
use crate::abstraction::{AbstractionError, compile};
use crate::model_file::Document;
use imdp::compare::{self, CompareError, Record, Sizes};
use imdp::files::steady;
use std::path::Path;

/// Why a path is no side of a comparison.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecordError {
    /// What is there cannot be compared.
    #[error(transparent)]
    Compare(#[from] CompareError),
    /// A run directory is refused.
    #[error(transparent)]
    Open(#[from] OpenError),
    /// The problem of a run directory is refused.
    #[error(transparent)]
    Problem(#[from] Diagnostic),
    /// The problem of a run directory has no abstraction.
    #[error("{path}: {error}")]
    Abstraction {
        /// The path.
        path: String,
        /// Why.
        error: AbstractionError,
    },
}

/// Opens a run directory, or whatever [`compare::open`] opens.
///
/// A directory without a model, but with the problem that it was made of, is compiled again.
///
/// # Errors
/// [`RecordError`] if nothing is there, or something malformed.
pub fn open_record(path: &Path) -> Result<Record, RecordError> {
    let overtaken = |error| OpenError::Io { path: path.display().to_string(), error }.into();
    steady(&[path.to_owned()], overtaken, || open_once(path))
}

fn open_once(path: &Path) -> Result<Record, RecordError> {
    let Some(files) = RunFiles::find(path)? else { return Ok(compare::open(path)?) };
    for name in ["model.dynabs", "model.tra", "model.sta", "model.lab", "model.props"] {
        if path.join(name).exists() {
            files.verified(name)?;
        }
    }
    let mut record = compare::collect(path)?.unwrap_or_default();
    record.name = path.display().to_string();
    let manifest = files.manifest()?;
    record.title = format!("{} ({} mode)", manifest.name, manifest.mode);
    if record.sizes.is_none() {
        let Manifest { states, choices, transitions, .. } = manifest;
        record.sizes = Some(Sizes { states, choices, transitions, rows: None, entries: None });
    }
    let problem = path.join(PROBLEM);
    if record.model.is_none() && problem.exists() {
        compile_again(&problem, &problem_document(path, &files.read(PROBLEM)?)?, &mut record)?;
    }
    Ok(record)
}

/// Gets the model of a directory without one from the problem that it was made of.
fn compile_again(path: &Path, document: &Document, record: &mut Record) -> Result<(), RecordError> {
    let problem = document.problem()?;
    let refuse = |error| RecordError::Abstraction { path: path.display().to_string(), error };
    let abstraction = compile(&problem, &()).map_err(refuse)?;
    record.sizes = Some(Sizes::new(&abstraction.model));
    record.model = Some(abstraction.model);
    record.properties = vec![abstraction.property];
    record.notes.push(format!("{}: there is no model beside it, it was compiled again", path.display()));
    Ok(())
}
