//! The formats as such: which file is of which, and reading any of them.

use super::import::{ImportError, Imported, without_packing};
use super::{bmdp, drn, native, netcdf, prism, umb};
use crate::progress::Progress;
use std::fmt;
use std::path::{Path, PathBuf};

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
    /// All of PRISM's explicit files in one, .pexp; it is only read.
    Combined,
    /// The text format of bmdp-tool, .txt, which has no place for labels and variables.
    Bmdp,
    /// The NetCDF files of IntervalMDP.jl, .nc with .json beside, which have no place for labels and variables either.
    Netcdf,
}

impl Format {
    /// The formats that keep all there is to a model.
    pub const ALL: [Self; 4] = [Self::Prism, Self::Drn, Self::Umb, Self::Native];

    /// The formats of other programs, which keep part of it.
    pub const OTHERS: [Self; 3] = [Self::Combined, Self::Bmdp, Self::Netcdf];

    /// What there is to know about a format: the one table of it.
    fn facts(self) -> Facts {
        let (name, extensions, about): (_, &[_], _) = match self {
            Self::Prism => ("prism", &["tra", "sta", "lab"], "PRISM's explicit files: .tra, .sta and .lab"),
            Self::Drn => ("drn", &["drn"], "Storm's explicit text format, .drn"),
            Self::Umb => {
                ("umb", &["umb"], "The unified Markov binary format that PRISM and Storm read, .umb")
            }
            Self::Native => ("dynabs", &["dynabs"], "The compact format of this program, .dynabs"),
            Self::Combined => {
                ("pexp", &["pexp"], "All of PRISM's explicit files in one, .pexp; it is only read")
            }
            Self::Bmdp => (
                "bmdp",
                &["txt"],
                "The text format of bmdp-tool, .txt: transitions and the states to be reached only",
            ),
            Self::Netcdf => (
                "netcdf",
                &["nc"],
                "The NetCDF format of IntervalMDP.jl, .nc: transitions only; .json beside has what is asked",
            ),
        };
        Facts { name, extensions, about }
    }

    /// All formats that are read.
    pub fn all() -> impl Iterator<Item = Self> + Clone {
        Self::ALL.into_iter().chain(Self::OTHERS)
    }

    /// All formats that are written.
    pub fn written() -> impl Iterator<Item = Self> + Clone {
        Self::all().filter(|&format| format != Self::Combined)
    }

    /// The format of this name.
    pub fn of_name(name: &str) -> Option<Self> {
        Self::all().find(|format| format.name() == name)
    }

    /// Its name, by which it can be asked for.
    pub fn name(self) -> &'static str {
        self.facts().name
    }

    /// What it is, in a few words.
    pub fn about(self) -> &'static str {
        self.facts().about
    }

    /// The extensions of the files of a model, that of the transitions first.
    pub fn extensions(self) -> &'static [&'static str] {
        self.facts().extensions
    }

    /// The extension of its files; PRISM's transitions stand for all three.
    pub fn extension(self) -> &'static str {
        self.extensions()[0]
    }

    /// The extensions of the files of formats, for messages: `.tra, .drn, … or .nc`.
    pub fn endings(formats: impl Iterator<Item = Self>) -> String {
        let mut endings: Vec<_> = formats.map(|format| format!(".{}", format.extension())).collect();
        let last = endings.pop().unwrap_or_default();
        format!("{} or {last}", endings.join(", "))
    }

    /// The format that the extension of a path tells; `.gz` and `.xz` behind it do not count.
    ///
    /// PRISM's arguments `m.tra,sta,lab` and `m.all` mean its explicit files.
    pub fn of_path(path: &Path) -> Option<Self> {
        if prism::ExplicitFiles::listed(path).is_some() {
            return Some(Self::Prism);
        }
        let unpacked = without_packing(path);
        let extension = unpacked.extension()?.to_str()?;
        Self::all().find(|format| format.extension() == extension)
    }

    /// The files that a model is read from, the one with the transitions first.
    pub fn files(self, path: &Path) -> Vec<PathBuf> {
        match self {
            Self::Prism => prism::ExplicitFiles::of(path).all(),
            Self::Netcdf => {
                let specification = Some(path.with_extension("json")).filter(|path| path.exists());
                std::iter::once(path.to_owned()).chain(specification).collect()
            }
            _ => vec![path.to_owned()],
        }
    }

    /// What reading a file amounts to, in the units that [`import`](Self::import) tells its progress in.
    pub fn work(self, path: &Path) -> u64 {
        match self {
            // How many branches there are is known only when the archive is open.
            Self::Umb => 0,
            _ => std::fs::metadata(path).map_or(0, |metadata| metadata.len()),
        }
    }

    /// Reads a model; `progress` is told now and then how much more has been read.
    ///
    /// # Errors
    /// [`ImportError`] if the file is not as the format wants it.
    pub fn import(self, path: &Path, progress: &dyn Progress) -> Result<Imported, ImportError> {
        let mut before = 0;
        let progress = &mut |read: u64| {
            progress.advance(read.saturating_sub(before));
            before = read;
        };
        match self {
            Self::Prism => prism::import_files(&prism::ExplicitFiles::of(path), progress),
            Self::Combined => prism::import_combined(path, progress),
            Self::Bmdp => bmdp::import_with_progress(path, progress),
            Self::Netcdf => netcdf::import(path),
            Self::Drn => drn::import_with_progress(path, progress),
            Self::Umb => umb::import_with_progress(path, progress),
            Self::Native => match native::read(path) {
                Ok(model) => Ok(Imported { model, warnings: vec![], properties: String::new() }),
                Err(error) => Err(ImportError::Native { path: path.to_owned(), error }),
            },
        }
    }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// What there is to know about a format.
struct Facts {
    name: &'static str,
    extensions: &'static [&'static str],
    about: &'static str,
}
