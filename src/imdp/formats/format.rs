//! The formats as such: which file is of which, and reading any of them.

use super::import::{ImportError, Imported};
use super::{drn, native, prism, umb};
use std::fmt;
use std::path::Path;

/// A format of interval MDPs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Format {
    /// PRISM's explicit files: .tra, .sta and .lab.
    Prism,
    /// Storm's explicit text format, .drn.
    Drn,
    /// The unified Markov binary format that PRISM and Storm read, .umb.
    Umb,
    /// The compact format of this program, .dynabs.
    Native,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 4] = [Self::Prism, Self::Drn, Self::Umb, Self::Native];

    /// The extension of its files; PRISM's transitions stand for all three.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Prism => "tra",
            Self::Drn => "drn",
            Self::Umb => "umb",
            Self::Native => "dynabs",
        }
    }

    /// The format that the extension of a path tells.
    pub fn of_path(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?;
        Self::ALL.into_iter().find(|format| format.extension() == extension)
    }

    /// What reading a file amounts to, in the units that [`import`](Self::import) tells its progress in.
    pub fn work(self, path: &Path) -> u64 {
        match self {
            // How many branches there are is known only when the archive is open.
            Self::Umb => 0,
            _ => std::fs::metadata(path).map_or(0, |metadata| metadata.len()),
        }
    }

    /// Reads a model; `progress` is told now and then how much has been read.
    ///
    /// # Errors
    /// [`ImportError`] if the file is not as the format wants it.
    pub fn import(
        self,
        path: &Path,
        progress: &mut (dyn FnMut(u64) + Send),
    ) -> Result<Imported, ImportError> {
        match self {
            Self::Prism => prism::import_with_progress(path, None, None, progress),
            Self::Drn => drn::import_with_progress(path, progress),
            Self::Umb => umb::import_with_progress(path, progress),
            Self::Native => match native::read(path) {
                Ok(model) => Ok(Imported { model, warnings: vec![] }),
                Err(error) => Err(ImportError::Native { path: path.to_owned(), error }),
            },
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Prism => "prism",
            Self::Drn => "drn",
            Self::Umb => "umb",
            Self::Native => "dynabs",
        })
    }
}
