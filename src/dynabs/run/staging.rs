//! Files that appear all at once or not at all.

use super::appearance::{Appearance, AppearanceError, MANIFEST, settle};
use super::manifest::{Manifest, OutputFile};
use imdp::files::{self, StagedDirectory};
use imdp::formats::HashingWriter;
use imdp::formats::WriteError;
use imdp::formats::row_states::EncodingError;
use serde::Deserialize;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// Why an output directory cannot be written.
#[derive(Debug, thiserror::Error)]
pub enum RunDirectoryError {
    /// The place is taken by something that is not ours.
    #[error("{path}: {found}; expected a new or empty directory, or one that dynabs-compile wrote")]
    Foreign {
        /// The path.
        path: String,
        /// What is there.
        found: &'static str,
    },
    /// An earlier run is there.
    #[error("{path}: found the output of an earlier run; expected a new or empty directory")]
    Exists {
        /// The path.
        path: String,
    },
    /// Another process wrote there meanwhile.
    #[error(
        "{path}: found what another process wrote meanwhile; expected what was there before\n  Nothing was written."
    )]
    Raced {
        /// The path.
        path: String,
    },
    /// The disk has no room.
    #[error(
        "{path}: found a disk with {free_mib} MiB free; expected the {needed_mib} MiB that the output needs"
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
    #[error("{0}")]
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

/// An output directory under construction, beside the place where it will appear or inside of it.
#[derive(Debug)]
pub struct Staging {
    /// The place, as it was given.
    shown: PathBuf,
    /// The place without links.
    target: PathBuf,
    appearance: Appearance,
    directory: StagedDirectory,
    files: Vec<OutputFile>,
}

impl Staging {
    /// Prepares to write `target`; nothing appears there before [`commit`](Self::commit).
    ///
    /// # Errors
    /// [`RunDirectoryError`] if something else is there, or an earlier run and not `force`.
    pub fn begin(target: &Path, force: bool) -> Result<Self, RunDirectoryError> {
        Self::check(target, force)?;
        let io = || RunDirectoryError::io(target);
        let given_parent = target.parent().filter(|parent| !parent.as_os_str().is_empty());
        fs::create_dir_all(given_parent.unwrap_or(Path::new("."))).map_err(io())?;
        let foreign = |found| RunDirectoryError::Foreign { path: target.display().to_string(), found };
        let place = files::resolve(target).map_err(io())?.ok_or_else(|| foreign("found a file in use"))?;
        let parent = place.parent().ok_or_else(|| foreign("found the root directory"))?;
        let mut appearance = Appearance::at(&place, parent).map_err(io())?;
        let directory = match StagedDirectory::new(appearance.staged_in(&place, parent)) {
            // Whoever may not write beside a directory may still write in it.
            Err(_) if place.is_dir() => {
                appearance = Appearance::within(&place);
                StagedDirectory::new(&place)
            }
            created => created,
        };
        Ok(Self {
            shown: target.to_path_buf(),
            directory: directory.map_err(io())?,
            target: place,
            appearance,
            files: vec![],
        })
    }

    /// Whether `target` may be written: a new place, an empty directory, or with `force` an earlier run.
    ///
    /// What a killed process left behind in it is removed, or finished if it was about to be all there.
    ///
    /// # Errors
    /// Those of [`begin`](Self::begin).
    pub fn check(target: &Path, force: bool) -> Result<(), RunDirectoryError> {
        let path = || target.display().to_string();
        match fs::symlink_metadata(target) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
            Err(error) => return Err(RunDirectoryError::io(target)(error)),
            Ok(_) if !target.is_dir() => {
                return Err(RunDirectoryError::Foreign { path: path(), found: "found a file" });
            }
            Ok(_) => {}
        }
        settle(target).map_err(RunDirectoryError::io(target))?;
        files::clear(target);
        let mut entries = fs::read_dir(target).map_err(RunDirectoryError::io(target))?;
        if entries.next().is_none() {
            return Ok(());
        }
        match is_run(target) {
            true if force => Ok(()),
            true => Err(RunDirectoryError::Exists { path: path() }),
            false => {
                Err(RunDirectoryError::Foreign { path: path(), found: "found a directory with other files" })
            }
        }
    }

    /// Refuses if fewer than `bytes` are free where the output goes.
    ///
    /// # Errors
    /// [`RunDirectoryError::DiskFull`] with the estimate.
    pub fn require_space(&self, bytes: u64) -> Result<(), RunDirectoryError> {
        let free = fs4::available_space(self.directory.path()).map_err(RunDirectoryError::io(&self.shown))?;
        if bytes <= free {
            return Ok(());
        }
        Err(RunDirectoryError::DiskFull {
            path: self.shown.display().to_string(),
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
        let shown = self.shown.join(name);
        let write = || {
            let file = File::create_new(self.directory.path().join(name))?;
            let mut writer = HashingWriter::new(BufWriter::with_capacity(1 << 16, file));
            fill(&mut writer)?;
            let (buffered, bytes, sha256) = writer.finish();
            buffered.into_inner().map_err(io::IntoInnerError::into_error)?.sync_all()?;
            Ok(OutputFile { name: name.to_owned(), bytes, sha256 })
        };
        self.files.push(write().map_err(RunDirectoryError::io(&shown))?);
        Ok(())
    }

    /// The files written so far.
    pub fn files(&self) -> &[OutputFile] {
        &self.files
    }

    /// Puts everything into place at once, the manifest with it.
    ///
    /// Of an earlier run nothing stays; other files in its directory do.
    ///
    /// # Errors
    /// [`RunDirectoryError::Raced`] if another process wrote there meanwhile, [`RunDirectoryError::Io`] if the system
    /// refuses.
    pub fn commit(mut self, manifest: &Manifest) -> Result<(), RunDirectoryError> {
        let mut text = serde_json::to_string_pretty(manifest)
            .map_err(|error| RunDirectoryError::io(&self.shown)(io::Error::other(error)))?;
        text.push('\n');
        self.write(MANIFEST, |out| out.write_all(text.as_bytes()))?;
        files::sync_directory(self.directory.path()).map_err(RunDirectoryError::io(&self.shown))?;
        let published = self.directory.publish(|staged| self.appearance.publish(staged, &self.target));
        published.map_err(|error| match error {
            AppearanceError::Raced => RunDirectoryError::Raced { path: self.shown.display().to_string() },
            AppearanceError::Io(error) => RunDirectoryError::io(&self.shown)(error),
        })
    }
}

/// Whether there is a manifest of ours, of whatever version; nothing else of it is believed.
fn is_run(directory: &Path) -> bool {
    #[derive(Deserialize)]
    struct Head {
        format: String,
    }
    let bytes = files::read(&directory.join(MANIFEST)).ok();
    let head = bytes.and_then(|bytes| serde_json::from_slice::<Head>(&bytes).ok());
    head.is_some_and(|head| Manifest::is_format(&head.format))
}
