//! What other engines said, if a run was cross-checked.

use serde::Deserialize;
use std::io;
use std::path::{Path, PathBuf};

/// The file in a run's directory with what `dynabs-check crosscheck DIR --json` printed.
pub const CROSS_CHECK: &str = "crosscheck.json";

/// The answers of other engines.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct CrossChecks {
    pub(super) findings: Vec<Finding>,
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
}

impl CrossChecks {
    /// The results in a run's directory; `None` if there are none.
    ///
    /// # Errors
    /// [`CrossCheckError`] if the file is there but unreadable or something else.
    pub fn read(directory: &Path) -> Result<Option<Self>, CrossCheckError> {
        let path = directory.join(CROSS_CHECK);
        match std::fs::read(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(CrossCheckError::Io { path, error }),
            Ok(bytes) => serde_json::from_slice(&bytes)
                .map(Some)
                .map_err(|error| CrossCheckError::Malformed { path, error }),
        }
    }
}
