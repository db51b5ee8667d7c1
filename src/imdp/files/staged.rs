//! A directory in which output is put together before it appears.

use super::directory::{PART, PREFIX, lock, remove};
use super::left_over;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{SystemTime, UNIX_EPOCH};

/// The staging directories of this process whose content does not count yet.
static PENDING: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// Removes all that this process has staged and not published; waits for what is being published.
pub fn abandon_all() {
    for path in PENDING.lock().unwrap_or_else(PoisonError::into_inner).drain(..) {
        remove(&path);
    }
}

/// A directory in which output is put together; dropping it removes it.
#[derive(Debug)]
pub struct StagedDirectory {
    path: PathBuf,
    /// Held as long as the process lives: what is not locked was left behind.
    _lock: Option<File>,
}

impl StagedDirectory {
    /// Creates one inside of `parent`, after removing what killed processes left there.
    ///
    /// # Errors
    /// What the system says.
    pub fn new(parent: &Path) -> io::Result<Self> {
        left_over::clear(parent);
        loop {
            let path = parent.join(fresh_name());
            match fs::create_dir(&path) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => continue,
                created => created?,
            }
            let lock = lock(&path);
            // Whoever saw it before it was locked took it for left behind.
            if fs::symlink_metadata(&path).is_ok() {
                PENDING.lock().unwrap_or_else(PoisonError::into_inner).push(path.clone());
                return Ok(Self { path, _lock: lock });
            }
        }
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Publishes the content by `publish`, which renames the directory or moves its files; what is left is removed.
    ///
    /// A signal that ends the process waits until it is done.
    ///
    /// # Errors
    /// Those of `publish`.
    pub fn publish<T, E>(&self, publish: impl FnOnce(&Path) -> Result<T, E>) -> Result<T, E> {
        let mut pending = PENDING.lock().unwrap_or_else(PoisonError::into_inner);
        let published = publish(&self.path)?;
        pending.retain(|path| *path != self.path);
        Ok(published)
    }

    /// Renames it to a name that ends in `suffix`, and returns that.
    ///
    /// # Errors
    /// What the system says.
    pub fn renamed(path: &Path, parent: &Path, suffix: &str) -> io::Result<PathBuf> {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        let renamed = parent.join(format!("{}{suffix}", name.trim_end_matches(PART)));
        fs::rename(path, &renamed)?;
        Ok(renamed)
    }
}

impl Drop for StagedDirectory {
    fn drop(&mut self) {
        remove(&self.path);
        PENDING.lock().unwrap_or_else(PoisonError::into_inner).retain(|path| *path != self.path);
    }
}

/// A name that no other process uses.
fn fresh_name() -> String {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let time = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |time| time.subsec_nanos());
    let count = COUNT.fetch_add(1, Ordering::Relaxed);
    format!("{PREFIX}{:x}-{time:x}-{count:x}{PART}", std::process::id())
}

/// Renames a file to a name that must be free.
///
/// # Errors
/// What the system says; [`io::ErrorKind::AlreadyExists`] if there is something of that name.
pub fn rename_new(from: &Path, to: &Path) -> io::Result<()> {
    #[cfg(any(target_os = "linux", target_vendor = "apple"))]
    {
        use rustix::fs::{CWD, RenameFlags, renameat_with};
        use rustix::io::Errno;
        match renameat_with(CWD, from, CWD, to, RenameFlags::NOREPLACE) {
            Err(Errno::INVAL | Errno::NOSYS | Errno::NOTSUP) => {}
            outcome => return Ok(outcome?),
        }
    }
    // A link is refused where there is a file already, on every system.
    fs::hard_link(from, to)?;
    fs::remove_file(from)
}
