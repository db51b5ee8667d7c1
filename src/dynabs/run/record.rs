//! A run directory as one side of a comparison.

use super::manifest::Manifest;
use super::staging::MANIFEST;
use super::write::PROBLEM;
use crate::Diagnostic;
use crate::abstraction::{AbstractionError, compile};
use crate::model_file::Document;
use imdp::compare::{self, CompareError, Record, Sizes};
use std::fs;
use std::path::Path;

/// Why a path is no side of a comparison.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RecordError {
    /// What is there cannot be compared.
    #[error(transparent)]
    Compare(#[from] CompareError),
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
    let manifest = path.join(MANIFEST);
    if !manifest.is_file() {
        return Ok(compare::open(path)?);
    }
    let mut record = compare::collect(path)?.unwrap_or_default();
    record.name = path.display().to_string();
    read_manifest(&manifest, &mut record)?;
    let problem = path.join(PROBLEM);
    if record.model.is_none() && problem.exists() {
        compile_again(&problem, &mut record)?;
    }
    Ok(record)
}

fn read_manifest(path: &Path, record: &mut Record) -> Result<(), CompareError> {
    let manifest: Manifest = serde_json::from_str(&read(path)?).map_err(|error| CompareError::Unusable {
        path: path.display().to_string(),
        found: error.to_string(),
        expected: "a manifest written by dynabs-compile",
    })?;
    record.title = format!("{} ({} mode)", manifest.name, manifest.mode);
    if record.sizes.is_none() {
        let Manifest { states, choices, transitions, .. } = manifest;
        record.sizes = Some(Sizes { states, choices, transitions, rows: None, entries: None });
    }
    Ok(())
}

/// Gets the model of a directory without one from the problem that it was made of.
fn compile_again(path: &Path, record: &mut Record) -> Result<(), RecordError> {
    let problem = Document::parse(path, &read(path)?)?.problem()?;
    let refuse = |error| RecordError::Abstraction { path: path.display().to_string(), error };
    let abstraction = compile(&problem, &()).map_err(refuse)?;
    record.sizes = Some(Sizes::new(&abstraction.model));
    record.model = Some(abstraction.model);
    record.properties = vec![abstraction.property];
    record.notes.push(format!("{}: there is no model beside it, it was compiled again", path.display()));
    Ok(())
}

fn read(path: &Path) -> Result<String, CompareError> {
    fs::read_to_string(path).map_err(|error| CompareError::Io { path: path.display().to_string(), error })
}
