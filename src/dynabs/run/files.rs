//! The files of a run, held against its manifest.

use super::appearance::{MANIFEST, settle};
use super::error::OpenError;
use super::manifest::{Manifest, OutputFile};
use imdp::files;
use imdp::formats::{sha256_hex, sha256_of_file};
use serde::Deserialize;
use std::io;
use std::path::{Path, PathBuf};

/// The files of a run: none of them is believed before it is the one that the manifest lists.
#[derive(Clone, Debug)]
pub struct RunFiles {
    directory: PathBuf,
    manifest: Vec<u8>,
    outputs: Vec<OutputFile>,
}

/// What every version of a manifest says.
#[derive(Deserialize)]
struct Head {
    format: String,
    #[serde(default)]
    outputs: Vec<OutputFile>,
}

impl RunFiles {
    /// The files of the run in a directory, after finishing what a killed process had decided to write there; none if
    /// there is no manifest.
    ///
    /// # Errors
    /// [`OpenError::Io`] if the manifest cannot be read, [`OpenError::NoRun`] if it is none of ours.
    pub fn find(directory: &Path) -> Result<Option<Self>, OpenError> {
        let io = |path: &Path| {
            let path = path.display().to_string();
            move |error| OpenError::Io { path, error }
        };
        if !directory.is_dir() {
            return Ok(None);
        }
        settle(directory).map_err(io(directory))?;
        let path = directory.join(MANIFEST);
        let manifest = match files::read(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            read => read.map_err(io(&path))?,
        };
        let mut files = Self { directory: directory.to_owned(), manifest, outputs: vec![] };
        let head: Head = serde_json::from_slice(&files.manifest).map_err(|error| files.not_read(&error))?;
        if !Manifest::is_format(&head.format) {
            return Err(files.refuse(format!("the {MANIFEST} of another format")));
        }
        files.outputs = head.outputs;
        Ok(Some(files))
    }

    /// The manifest as a whole.
    ///
    /// # Errors
    /// [`OpenError::NoRun`] if it is one of another version.
    pub fn manifest(&self) -> Result<Manifest, OpenError> {
        serde_json::from_slice(&self.manifest).map_err(|error| self.not_read(&error))
    }

    /// Reads a file that the manifest lists.
    ///
    /// # Errors
    /// [`OpenError::NoRun`] without it, [`OpenError::Changed`] if it is another one.
    pub fn read(&self, name: &str) -> Result<Vec<u8>, OpenError> {
        let path = self.directory.join(name);
        let bytes = files::read(&path).map_err(|error| self.unreadable(name, error))?;
        self.compare(name, &sha256_hex(&bytes))?;
        Ok(bytes)
    }

    /// The path of a file after a look at whether it is the one that the manifest lists.
    ///
    /// # Errors
    /// Those of [`read`](Self::read).
    pub fn verified(&self, name: &str) -> Result<PathBuf, OpenError> {
        let path = self.directory.join(name);
        let hash = sha256_of_file(&path).map_err(|error| self.unreadable(name, error))?;
        self.compare(name, &hash)?;
        Ok(path)
    }

    /// The path of a file, for messages.
    pub(super) fn path(&self, name: &str) -> String {
        self.directory.join(name).display().to_string()
    }

    /// The SHA-256 that the manifest gives a file.
    pub fn sha256(&self, name: &str) -> Option<&str> {
        self.outputs.iter().find(|file| file.name == name).map(|file| file.sha256.as_str())
    }

    pub(super) fn compare(&self, name: &str, sha256: &str) -> Result<(), OpenError> {
        if self.sha256(name) == Some(sha256) {
            return Ok(());
        }
        Err(OpenError::Changed { path: self.path(name) })
    }

    pub(super) fn refuse(&self, found: String) -> OpenError {
        OpenError::NoRun { path: self.directory.display().to_string(), found }
    }

    fn not_read(&self, error: &serde_json::Error) -> OpenError {
        self.refuse(format!("a {MANIFEST} that cannot be read ({error})"))
    }

    fn unreadable(&self, name: &str, error: io::Error) -> OpenError {
        match error.kind() {
            io::ErrorKind::NotFound => self.refuse(format!("no {name}")),
            _ => OpenError::Io { path: self.path(name), error },
        }
    }
}
