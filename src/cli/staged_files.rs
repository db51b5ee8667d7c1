//! Files that appear when all of them are complete.

use super::CliError;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Files written beside their places: nobody ever sees half of one, nor one without the others.
#[derive(Debug, Default)]
pub(super) struct StagedFiles {
    files: Vec<(NamedTempFile, PathBuf)>,
}

impl StagedFiles {
    /// Writes a file through `fill`; it appears at `path` with [`commit`](Self::commit).
    ///
    /// # Errors
    /// [`CliError::Failure`] if writing fails.
    pub(crate) fn write(
        &mut self,
        path: &Path,
        fill: impl FnOnce(&mut BufWriter<&File>) -> io::Result<()>,
    ) -> Result<(), CliError> {
        let directory =
            path.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
        let write = || {
            let mut builder = tempfile::Builder::new();
            #[cfg(unix)]
            {
                use std::os::unix::fs::PermissionsExt;
                builder.permissions(std::fs::Permissions::from_mode(0o666));
            }
            let file: NamedTempFile = builder.tempfile_in(directory)?;
            let mut out = BufWriter::with_capacity(1 << 16, file.as_file());
            fill(&mut out)?;
            out.flush()?;
            drop(out);
            Ok(file)
        };
        let file = write().map_err(|error| failure(path, &error))?;
        self.files.push((file, path.to_owned()));
        Ok(())
    }

    /// Renames the files into their places, the first one written last.
    ///
    /// # Errors
    /// [`CliError::Failure`] if the system refuses.
    pub(crate) fn commit(self) -> Result<(), CliError> {
        for (file, path) in self.files.into_iter().rev() {
            file.persist(&path).map_err(|error| failure(&path, &error.error))?;
        }
        Ok(())
    }
}

fn failure(path: &Path, error: &io::Error) -> CliError {
    CliError::Failure(format!("{}: {error}", path.display()))
}
