//! What killed processes left behind.

use super::directory::{FILES, PART, PREFIX, lock, remove, sync_directory};
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// Removes what killed processes staged in `directory`, and finishes what they had published.
///
/// Does what it can: what cannot be removed is in nobody's way.
pub fn clear(directory: &Path) {
    for (path, _lock) in claim(directory, PART, false) {
        remove(&path);
    }
    for (path, _lock) in claim(directory, FILES, false) {
        // Whoever reads the files is told.
        let _ = finish(&path, directory);
    }
}

/// Finishes what was published in `directory` and is not in its place yet; waits for a process that is at it.
///
/// # Errors
/// What the system says if a file cannot be moved to its place.
pub fn settle(directory: &Path) -> io::Result<()> {
    claim(directory, FILES, true).into_iter().try_for_each(|(path, _lock)| finish(&path, directory))
}

/// The directories of ours in `directory` whose name ends in `suffix` and that no living process has, locked; with
/// `wait`, those of living processes too, once they are done with them.
pub fn claim(directory: &Path, suffix: &str, wait: bool) -> Vec<(PathBuf, File)> {
    let Ok(entries) = fs::read_dir(directory) else { return vec![] };
    let is_ours = |name: &str| {
        let inside = name.strip_prefix(PREFIX).and_then(|name| name.strip_suffix(suffix));
        inside.is_some_and(|name| name.bytes().all(|byte| byte.is_ascii_hexdigit() || byte == b'-'))
    };
    let ours = entries.flatten().filter(|entry| entry.file_name().to_str().is_some_and(is_ours));
    let directories = ours.filter(|entry| entry.file_type().is_ok_and(|kind| kind.is_dir()));
    let paths = directories.map(|entry| entry.path());
    paths.filter_map(|path| Some((path.clone(), if wait { wait_for(&path) } else { lock(&path) }?))).collect()
}

/// Locks a directory as soon as nobody else has it; `None` if it is gone by then.
fn wait_for(path: &Path) -> Option<File> {
    let file = File::open(path).ok()?;
    // Where the system has no such locks, finishing is right as well: it can be done twice.
    let _ = file.lock();
    fs::symlink_metadata(path).is_ok().then_some(file)
}

/// Moves the files of a published directory to their places.
pub(super) fn finish(path: &Path, directory: &Path) -> io::Result<()> {
    for entry in fs::read_dir(path)? {
        let entry = entry?;
        match fs::rename(entry.path(), directory.join(entry.file_name())) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
            _ => {}
        }
    }
    match fs::remove_dir(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => sync_directory(directory),
    }
}
