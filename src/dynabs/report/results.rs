//! What other engines said, if a run was cross-checked.

use crate::run::Manifest;
use serde::Deserialize;
use std::io;
use std::path::{Path, PathBuf};

/// The file in a run's directory with what `dynabs-check crosscheck DIR --json` printed.
pub const CROSS_CHECK: &str = "crosscheck.json";

/// The answers of other engines.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct CrossChecks {
    /// The files of the model that was asked about.
    #[serde(default)]
    model: Vec<ModelFile>,
    pub(super) findings: Vec<Finding>,
}

/// A file of a model.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
struct ModelFile {
    kind: String,
    sha256: String,
}

/// What one engine said about one property.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub(super) struct Finding {
    pub(super) engine: String,
    #[serde(default)]
    pub(super) version: Option<String>,
    pub(super) property: String,
    /// Its least and greatest value of the initial states.
    #[serde(default)]
    pub(super) value: Option<[f64; 2]>,
    /// Our bounds then.
    pub(super) ours: [f64; 2],
    #[serde(default)]
    pub(super) difference: Option<f64>,
    #[serde(default)]
    pub(super) seconds: Option<f64>,
    pub(super) agreement: String,
}

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
    #[error("{path}: found something else ({error}); expected what `dynabs-check crosscheck --json` prints\n  Write it again or remove the file.", path = path.display())]
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

impl CrossChecks {
    /// The results in the directory of a run with this manifest; `None` if there are none.
    ///
    /// # Errors
    /// [`CrossCheckError`] if the file is there but unreadable or something else, or about another model.
    pub fn read(directory: &Path, manifest: &Manifest) -> Result<Option<Self>, CrossCheckError> {
        let path = directory.join(CROSS_CHECK);
        match imdp::files::read(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(CrossCheckError::Io { path, error }),
            Ok(bytes) => {
                let found = serde_json::from_slice::<Self>(&bytes);
                let found =
                    found.map_err(|error| CrossCheckError::Malformed { path: path.clone(), error })?;
                if found.is_about(manifest) {
                    Ok(Some(found))
                } else {
                    Err(CrossCheckError::OtherModel { path })
                }
            }
        }
    }

    /// Whether every file that was asked about is one of the run.
    fn is_about(&self, manifest: &Manifest) -> bool {
        let is_output = |file: &ModelFile| {
            let name = format!("model.{}", file.kind);
            manifest.outputs.iter().any(|output| output.name == name && output.sha256 == file.sha256)
        };
        !self.model.is_empty() && self.model.iter().all(is_output)
    }
}
