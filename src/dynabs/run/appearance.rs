//! How the directory of a run takes its place.

use imdp::files::{StagedDirectory, claim, sync_directory};
use imdp::formats::Format;
use std::fs::{self, File};
use std::io;
use std::path::Path;

/// The name of the file that makes a directory ours.
pub(super) const MANIFEST: &str = "manifest.json";
/// The name of the problem in a run's directory.
pub(super) const PROBLEM: &str = "problem.json";
/// The name of the noise samples in a run's directory.
pub(super) const NOISE: &str = "noise.csv";

/// The name of the native model in a run's directory.
pub const NATIVE_MODEL: &str = "model.dynabs";
/// The name of the solution in a run's directory.
pub(super) const SOLUTION: &str = "solution.bin";

/// What the names of directories end with whose files are on the way into the directory that they are in.
const RUN: &str = ".run";

/// How the directory of a run takes its place.
#[derive(Clone, Copy, Debug)]
pub(super) enum Appearance {
    /// By one rename, to a free name or onto an empty directory.
    Rename,
    /// By one exchange with the directory of the earlier run, which was this one.
    Exchange(Option<Identity>),
    /// File by file inside of a directory that cannot be renamed; its manifest was this one.
    Within(Option<Identity>),
}

/// Why a directory cannot take its place.
#[derive(Debug, thiserror::Error)]
pub(super) enum AppearanceError {
    /// Another process was there first.
    #[error("another process was there first")]
    Raced,
    /// The system refused.
    #[error(transparent)]
    Io(#[from] io::Error),
}

/// Which file or directory it is, whatever its name.
type Identity = (u64, u64);

impl Appearance {
    /// Chooses how a run appears at `target`, a path without links, which is free, empty or an earlier run.
    pub(super) fn at(target: &Path, parent: &Path) -> io::Result<Self> {
        if !target.exists() {
            return Ok(Self::Rename);
        }
        let mut entries = fs::read_dir(target)?.flatten();
        let has_directory = entries.any(|entry| entry.file_type().is_ok_and(|kind| kind.is_dir()));
        if !is_renamable(target, parent) || has_directory {
            return Ok(Self::within(target));
        }
        if fs::metadata(target)?.permissions().readonly() {
            return Err(io::Error::new(io::ErrorKind::PermissionDenied, "it is read-only"));
        }
        let is_empty = fs::read_dir(target)?.next().is_none();
        Ok(if is_empty { Self::Rename } else { Self::Exchange(identity(target)) })
    }

    /// Chooses that the directory stays and its files are replaced.
    pub(super) fn within(target: &Path) -> Self {
        Self::Within(identity(&target.join(MANIFEST)))
    }

    /// Where the run has to be staged: everything is renamed within one file system.
    pub(super) fn staged_in<'a>(&self, target: &'a Path, parent: &'a Path) -> &'a Path {
        if matches!(self, Self::Within(_)) { target } else { parent }
    }

    /// Puts the complete directory `staged` into its place.
    ///
    /// One rename or one exchange, so that at every moment the old or the new run is there as a whole. Where the file
    /// system has no exchange, or the directory itself has to stay (a mount point, the current directory, one with
    /// directories of the user's in it), renaming the staged directory into `target` decides, its files are moved to
    /// their places with the manifest last, and [`settle`] finishes that if the process is killed.
    pub(super) fn publish(self, staged: &Path, target: &Path) -> Result<(), AppearanceError> {
        if let Ok(metadata) = fs::metadata(target) {
            fs::set_permissions(staged, metadata.permissions())?;
        }
        let outcome = self.place(staged, target);
        if outcome.is_ok()
            && let Some(parent) = target.parent()
        {
            sync_directory(parent)?;
        }
        outcome
    }

    fn place(self, staged: &Path, target: &Path) -> Result<(), AppearanceError> {
        match self {
            Self::Rename => {
                use io::ErrorKind::{AlreadyExists, DirectoryNotEmpty, NotADirectory};
                return fs::rename(staged, target).map_err(|error| match error.kind() {
                    AlreadyExists | DirectoryNotEmpty | NotADirectory => AppearanceError::Raced,
                    _ => error.into(),
                });
            }
            Self::Exchange(old) => {
                if identity(target) != old {
                    return Err(AppearanceError::Raced);
                }
                if keep_others(target, staged).is_ok() {
                    if exchange(staged, target)? {
                        if identity(staged) != old {
                            exchange(staged, target)?;
                            return Err(AppearanceError::Raced);
                        }
                        return Ok(keep_late(staged, target)?);
                    }
                    drop_others(staged)?;
                }
            }
            Self::Within(_) => {}
        }
        // One at a time.
        let directory = File::open(target)?;
        let _ = directory.lock();
        if let Self::Within(old) = self
            && identity(&target.join(MANIFEST)) != old
        {
            return Err(AppearanceError::Raced);
        }
        let journal = StagedDirectory::renamed(staged, target, RUN)?;
        Ok(move_in(&journal, target)?)
    }
}

/// Finishes what a killed process had decided to write into `directory`; waits for a process that is at it.
///
/// # Errors
/// What the system says if a file cannot be moved to its place.
pub(super) fn settle(directory: &Path) -> io::Result<()> {
    claim(directory, RUN, true).into_iter().try_for_each(|(journal, _lock)| move_in(&journal, directory))
}

/// Whether a file in the directory of a run is one that a run can have: the others are the user's.
fn is_own(name: &str) -> bool {
    const STEMS: [&str; 2] = ["model", "rows"];
    let is_ours = |extension: &str| {
        extension == "props"
            || Format::ALL.iter().flat_map(|format| format.extensions()).any(|own| *own == extension)
    };
    let is_part = |(stem, extension): (&str, &str)| match extension {
        // Several structures have numbers.
        "srew" | "trew" => STEMS.contains(&stem.trim_end_matches(|c: char| c.is_ascii_digit())),
        extension => STEMS.contains(&stem) && is_ours(extension),
    };
    [MANIFEST, PROBLEM, NOISE, SOLUTION].contains(&name) || name.split_once('.').is_some_and(is_part)
}

/// Whether a file is one of the user's in the directory of a run, by its name.
fn is_other(name: &std::ffi::OsStr) -> bool {
    !name.to_str().is_some_and(|name| is_own(name) || name.starts_with(".dynabs-"))
}

/// Gives the files of the user's in `target` a second name in `staged`; all or none.
fn keep_others(target: &Path, staged: &Path) -> io::Result<()> {
    let link = || {
        for entry in fs::read_dir(target)? {
            let name = entry?.file_name();
            if is_other(&name) {
                fs::hard_link(target.join(&name), staged.join(&name))?;
            }
        }
        Ok(())
    };
    let linked = link();
    if linked.is_err() {
        drop_others(staged)?;
    }
    linked
}

fn drop_others(staged: &Path) -> io::Result<()> {
    for entry in fs::read_dir(staged)? {
        let entry = entry?;
        if is_other(&entry.file_name()) {
            fs::remove_file(entry.path())?;
        }
    }
    Ok(())
}

/// Moves what came into the old directory at the last moment to the new one.
fn keep_late(old: &Path, new: &Path) -> io::Result<()> {
    for entry in fs::read_dir(old)? {
        let name = entry?.file_name();
        if is_other(&name) && fs::symlink_metadata(new.join(&name)).is_err() {
            fs::rename(old.join(&name), new.join(&name))?;
        }
    }
    Ok(())
}

/// Moves the files of a run from `journal`, a directory in `target`, to their places; can be done again.
fn move_in(journal: &Path, target: &Path) -> io::Result<()> {
    let manifest = target.join(MANIFEST);
    let there = |path: &Path| fs::symlink_metadata(path).is_ok();
    // As long as the old manifest is there, nothing has been moved yet.
    if there(&manifest) && there(&journal.join(MANIFEST)) {
        for entry in fs::read_dir(target)? {
            let name = entry?.file_name();
            let is_old =
                name.to_str().is_some_and(is_own) && name != MANIFEST && !there(&journal.join(&name));
            if is_old {
                fs::remove_file(target.join(&name))?;
            }
        }
        fs::remove_file(&manifest)?;
    }
    let mut names = Vec::new();
    for entry in fs::read_dir(journal)? {
        names.push(entry?.file_name());
    }
    names.sort_by_key(|name| name == MANIFEST);
    for name in names {
        fs::rename(journal.join(&name), target.join(&name))?;
    }
    fs::remove_dir(journal)?;
    sync_directory(target)
}

/// Exchanges two directories at once; `false` where that cannot be done.
#[cfg(any(target_os = "linux", target_vendor = "apple"))]
fn exchange(one: &Path, other: &Path) -> io::Result<bool> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    use rustix::io::Errno;
    match renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE) {
        Ok(()) => Ok(true),
        Err(Errno::INVAL | Errno::NOSYS | Errno::NOTSUP) => Ok(false),
        Err(error) => Err(error.into()),
    }
}

#[cfg(not(any(target_os = "linux", target_vendor = "apple")))]
fn exchange(_: &Path, _: &Path) -> io::Result<bool> {
    Ok(false)
}

#[cfg(unix)]
fn identity(path: &Path) -> Option<Identity> {
    use std::os::unix::fs::MetadataExt;
    let metadata = fs::symlink_metadata(path).ok()?;
    Some((metadata.dev(), metadata.ino()))
}

#[cfg(not(unix))]
fn identity(path: &Path) -> Option<Identity> {
    fs::symlink_metadata(path).ok().map(|_| (0, 0))
}

/// Whether a directory may get another name: it is no mount point, and nobody stands in it as far as we know.
fn is_renamable(directory: &Path, parent: &Path) -> bool {
    let current = std::env::current_dir().and_then(fs::canonicalize);
    !current.is_ok_and(|current| current.starts_with(directory)) && mount(directory) == mount(parent)
}

/// The mount that a directory belongs to.
#[cfg(target_os = "linux")]
fn mount(path: &Path) -> Option<u64> {
    use rustix::fs::{AtFlags, CWD, StatxFlags, statx};
    statx(CWD, path, AtFlags::empty(), StatxFlags::MNT_ID).ok().map(|found| found.stx_mnt_id)
}

#[cfg(not(target_os = "linux"))]
fn mount(path: &Path) -> Option<u64> {
    identity(path).map(|(device, _)| device)
}
