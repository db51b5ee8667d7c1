//! Files that appear all at once or not at all.

use super::manifest::{Manifest, OutputFile};
use imdp::formats::HashingWriter;
use imdp::formats::WriteError;
use imdp::formats::row_states::EncodingError;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Why an output directory cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum RunDirectoryError {
    /// The place is taken by something that is not ours.
    #[error(
        "{path}: {found}; expected a new or empty directory, or one that dynabs-compile wrote\n  Choose another name with -o; --force replaces only directories written by dynabs-compile."
    )]
    Foreign {
        /// The path.
        path: String,
        /// What is there.
        found: &'static str,
    },
    /// An earlier run is there.
    #[error(
        "{path}: found the output of an earlier run; expected a new or empty directory\n  Choose another name with -o, or replace it with --force."
    )]
    Exists {
        /// The path.
        path: String,
    },
    /// The disk has no room.
    #[error(
        "{path}: the output needs {needed_mib} MiB but the disk has only {free_mib} MiB free\n  Leave out the explicit files with --no-tra, or choose another disk with -o."
    )]
    DiskFull {
        /// The path.
        path: String,
        /// The size of the output in MiB.
        needed_mib: u64,
        /// The free space in MiB.
        free_mib: u64,
    },
    /// The model cannot be written in a format.
    #[error(
        "{0}\n  Leave out the explicit files with --no-tra, or use --encoding rows, a coarser partition, or a smaller U or U'."
    )]
    Format(#[from] WriteError),
    /// The model or its property has no encoding with row states.
    #[error(transparent)]
    Encoding(#[from] EncodingError),
    /// The parts do not make a model.
    #[error(transparent)]
    Model(#[from] imdp::model::ImdpError),
    /// Reading or writing failed.
    #[error("{path}: {error}")]
    Io {
        /// The path.
        path: String,
        /// What the system said.
        error: io::Error,
    },
}

impl RunDirectoryError {
    /// Wraps what the system said about a path.
    pub fn io(path: &Path) -> impl FnOnce(io::Error) -> Self + '_ {
        move |error| Self::Io { path: path.display().to_string(), error }
    }
}

/// The name of the file that makes a directory ours.
pub(super) const MANIFEST: &str = "manifest.json";

/// An output directory under construction, beside the place where it will appear.
#[derive(Debug)]
pub struct Staging {
    target: PathBuf,
    directory: TempDir,
    /// The manifest of the run that is being replaced.
    replaces: Option<Manifest>,
    files: Vec<OutputFile>,
}

impl Staging {
    /// Prepares to write `target`; nothing appears there before [`commit`](Self::commit).
    ///
    /// # Errors
    /// [`RunDirectoryError`] if something else is there, or an earlier run and not `force`.
    pub fn begin(target: &Path, force: bool) -> Result<Self, RunDirectoryError> {
        let replaces = Self::check(target, force)?;
        let parent = match target.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent.to_path_buf(),
            _ => PathBuf::from("."),
        };
        fs::create_dir_all(&parent).map_err(RunDirectoryError::io(&parent))?;
        let mut builder = tempfile::Builder::new();
        builder.prefix(".dynabs-");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            builder.permissions(fs::Permissions::from_mode(0o777));
        }
        let directory = builder.tempdir_in(&parent).map_err(RunDirectoryError::io(&parent))?;
        Ok(Self { target: target.to_path_buf(), directory, replaces, files: vec![] })
    }

    /// Whether `target` may be written: a new place, an empty directory, or with `force` an earlier run.
    ///
    /// # Errors
    /// Those of [`begin`](Self::begin); nothing is created.
    pub fn check(target: &Path, force: bool) -> Result<Option<Manifest>, RunDirectoryError> {
        let path = || target.display().to_string();
        if !target.exists() && !target.is_symlink() {
            return Ok(None);
        }
        if !target.is_dir() {
            return Err(RunDirectoryError::Foreign { path: path(), found: "found a file" });
        }
        let mut entries = fs::read_dir(target).map_err(RunDirectoryError::io(target))?;
        if entries.next().is_none() {
            return Ok(None);
        }
        let manifest = fs::read(target.join(MANIFEST)).ok();
        match manifest.and_then(|bytes| serde_json::from_slice::<Manifest>(&bytes).ok()) {
            Some(manifest) if manifest.is_ours() && force => Ok(Some(manifest)),
            Some(manifest) if manifest.is_ours() => Err(RunDirectoryError::Exists { path: path() }),
            _ => {
                Err(RunDirectoryError::Foreign { path: path(), found: "found a directory with other files" })
            }
        }
    }

    /// Refuses if fewer than `bytes` are free where the output goes.
    ///
    /// # Errors
    /// [`RunDirectoryError::DiskFull`] with the estimate.
    pub fn require_space(&self, bytes: u64) -> Result<(), RunDirectoryError> {
        let free =
            fs4::available_space(self.directory.path()).map_err(RunDirectoryError::io(&self.target))?;
        if bytes <= free {
            return Ok(());
        }
        Err(RunDirectoryError::DiskFull {
            path: self.target.display().to_string(),
            needed_mib: bytes.div_ceil(1 << 20),
            free_mib: free >> 20,
        })
    }

    /// Writes one file through `fill`, hashing it, and makes sure that it is on the disk.
    ///
    /// # Errors
    /// [`RunDirectoryError::Io`] if writing fails.
    pub fn write(
        &mut self,
        name: &str,
        fill: impl FnOnce(&mut HashingWriter<BufWriter<File>>) -> io::Result<()>,
    ) -> Result<(), RunDirectoryError> {
        let shown = self.target.join(name);
        let write = || {
            let file = File::create(self.directory.path().join(name))?;
            let mut writer = HashingWriter::new(BufWriter::with_capacity(1 << 16, file));
            fill(&mut writer)?;
            let (buffered, bytes, sha256) = writer.finish();
            buffered.into_inner().map_err(io::IntoInnerError::into_error)?.sync_data()?;
            Ok(OutputFile { name: name.to_owned(), bytes, sha256 })
        };
        self.files.push(write().map_err(RunDirectoryError::io(&shown))?);
        Ok(())
    }

    /// The files written so far.
    pub fn files(&self) -> &[OutputFile] {
        &self.files
    }

    /// Puts everything into place, the manifest last.
    ///
    /// A new directory appears by one rename. In an existing one the old manifest goes first, so that at no
    /// time a manifest describes files of another run.
    ///
    /// # Errors
    /// [`RunDirectoryError::Io`] if the system refuses.
    pub fn commit(mut self, manifest: &Manifest) -> Result<(), RunDirectoryError> {
        let mut text = serde_json::to_string_pretty(manifest)
            .map_err(|error| RunDirectoryError::io(&self.target)(io::Error::other(error)))?;
        text.push('\n');
        self.write(MANIFEST, |out| out.write_all(text.as_bytes()))?;
        let place = |error| RunDirectoryError::io(&self.target)(error);
        if !self.target.exists() {
            return fs::rename(self.directory.keep(), &self.target).map_err(place);
        }
        if let Some(old) = &self.replaces {
            fs::remove_file(self.target.join(MANIFEST)).map_err(place)?;
            for file in &old.outputs {
                match fs::remove_file(self.target.join(&file.name)) {
                    Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(place(error)),
                    _ => {}
                }
            }
        }
        for file in &self.files {
            let (from, to) = (self.directory.path().join(&file.name), self.target.join(&file.name));
            fs::rename(from, to).map_err(place)?;
        }
        Ok(())
    }
}
