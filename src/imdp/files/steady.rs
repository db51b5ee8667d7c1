//! Reading files that another process may replace meanwhile.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// A reader that is overtaken so often is given what it found.
const ATTEMPTS: usize = 20;

/// Which files some paths lead to: equal as long as none of them is replaced or written to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Snapshot(Vec<Option<Identity>>);

/// Number, size and age of a file.
type Identity = ((u64, u64), u64, Option<SystemTime>);

impl Snapshot {
    /// What `paths` lead to now.
    pub fn of(paths: &[PathBuf]) -> Self {
        let identity = |path: &Path| {
            let metadata = fs::metadata(path).ok()?;
            Some((number(&metadata), metadata.len(), metadata.modified().ok()))
        };
        Self(paths.iter().map(|path| identity(path)).collect())
    }
}

/// Reads again as often as `paths` lead to other files afterwards: files of two writers are never mixed.
///
/// # Errors
/// Those of `read`.
pub fn steady<T, E>(paths: &[PathBuf], mut read: impl FnMut() -> Result<T, E>) -> Result<T, E> {
    for _ in 1..ATTEMPTS {
        let before = Snapshot::of(paths);
        let outcome = read();
        if Snapshot::of(paths) == before {
            return outcome;
        }
    }
    read()
}

#[cfg(unix)]
fn number(metadata: &fs::Metadata) -> (u64, u64) {
    use std::os::unix::fs::MetadataExt;
    (metadata.dev(), metadata.ino())
}

#[cfg(not(unix))]
fn number(_: &fs::Metadata) -> (u64, u64) {
    (0, 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_replaced_meanwhile_is_read_again() {
        let scratch = tempfile::tempdir().unwrap();
        let (one, other) = (scratch.path().join("one"), scratch.path().join("other"));
        fs::write(&one, "old").unwrap();
        let mut rounds = 0;
        let text = steady(std::slice::from_ref(&one), || {
            let text = fs::read_to_string(&one);
            rounds += 1;
            if rounds < 3 {
                fs::write(&other, format!("new {rounds}")).unwrap();
                fs::rename(&other, &one).unwrap();
            }
            text
        });
        assert_eq!((text.unwrap().as_str(), rounds), ("new 2", 3));
    }
}
