//! Directories of ours: what they are called, who has them, how they go.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::Path;

/// What the names of staging directories begin with.
pub(super) const PREFIX: &str = ".dynabs-";
/// What the names of those end with whose content does not count yet.
pub(super) const PART: &str = ".part";
/// What the names of those end with whose files are on the way to their places.
pub(super) const FILES: &str = ".files";

/// Locks a directory; `None` if another process has it, or the system has no such locks.
pub(super) fn lock(path: &Path) -> Option<File> {
    let file = File::open(path).ok()?;
    match file.try_lock() {
        Ok(()) => Some(file),
        Err(TryLockError::WouldBlock | TryLockError::Error(_)) => None,
    }
}

/// Removes a directory with the files in it; it has no directories of ours.
pub(super) fn remove(path: &Path) {
    // Nobody is waiting for this to succeed.
    for entry in fs::read_dir(path).into_iter().flatten().flatten() {
        let _ = fs::remove_file(entry.path());
    }
    let _ = fs::remove_dir(path);
}

/// Makes sure that what was created, renamed or removed in a directory is on the disk.
///
/// # Errors
/// What the system says; directories that cannot be synchronised are no error.
pub fn sync_directory(directory: &Path) -> io::Result<()> {
    if cfg!(unix) {
        match File::open(directory)?.sync_all() {
            Err(error) if error.kind() == io::ErrorKind::InvalidInput => {}
            outcome => outcome?,
        }
    }
    Ok(())
}
