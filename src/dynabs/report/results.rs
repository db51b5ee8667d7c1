//! What other engines said, if a run was cross-checked.

use crate::run::Manifest;
use imdp::certificate::FileDigest;
use imdp::engines::CrossCheckFile;
use std::io;
use std::path::{Path, PathBuf};

/// The file in a run's directory with what `dynabs-check crosscheck DIR --json` printed.
pub const CROSS_CHECK: &str = "crosscheck.json";

/// Why cross-check results cannot be shown.
#[derive(Debug, thiserror::Error)]
pub enum CrossCheckError {
    /// The file is there but cannot be read.
    #[error("{path}: {error}", path = path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What went wrong.
        error: io::Error,
    },
    /// The file is something else.
    #[error("{path}: found something else ({error}); expected the findings of a cross-check in JSON\n  Write it again or remove the file.", path = path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// Where it stops making sense.
        error: serde_json::Error,
    },
    /// The answers are about another model, or do not say which.
    #[error("{path}: found answers about another model; they are not shown\n  Cross-check this one again.", path = path.display())]
    OtherModel {
        /// The file.
        path: PathBuf,
    },
}

/// What engines said about the run in a directory with this manifest; `None` if they were not asked.
///
/// # Errors
/// [`CrossCheckError`] if the file is there but unreadable or something else, or about another model.
pub fn read_cross_checks(
    directory: &Path,
    manifest: &Manifest,
) -> Result<Option<CrossCheckFile>, CrossCheckError> {
    let path = directory.join(CROSS_CHECK);
    match imdp::files::read(&path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(CrossCheckError::Io { path, error }),
        Ok(bytes) => {
            let found = serde_json::from_slice::<CrossCheckFile>(&bytes);
            let found = found.map_err(|error| CrossCheckError::Malformed { path: path.clone(), error })?;
            match is_about(&found.model, manifest) {
                true => Ok(Some(found)),
                false => Err(CrossCheckError::OtherModel { path }),
            }
        }
    }
}

/// Whether every file that was asked about is one of the run.
fn is_about(model: &[FileDigest], manifest: &Manifest) -> bool {
    let is_output = |file: &FileDigest| {
        let name = format!("model.{}", file.kind);
        manifest.outputs.iter().any(|output| output.name == name && output.sha256 == file.sha256)
    };
    !model.is_empty() && model.iter().all(is_output)
}
