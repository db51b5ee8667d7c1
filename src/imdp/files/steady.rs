//! Reading files that another process may replace meanwhile.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// A reader that is overtaken so often gives up.
const ATTEMPTS: usize = 100;

/// Which files some paths lead to: equal as long as none of them is replaced or written to.
#[derive(Debug, PartialEq, Eq)]
struct Snapshot(Vec<Option<Identity>>);

/// Number, size and age of a file.
type Identity = ((u64, u64), u64, Option<SystemTime>);

impl Snapshot {
    /// What `paths` lead to now.
    fn of(paths: &[PathBuf]) -> Self {
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
/// Those of `read`, and `overtaken` of what to say if the files were replaced during every attempt.
pub fn steady<T, E>(
    paths: &[PathBuf],
    overtaken: impl FnOnce(io::Error) -> E,
    mut read: impl FnMut() -> Result<T, E>,
) -> Result<T, E> {
    for _ in 0..ATTEMPTS {
        let before = Snapshot::of(paths);
        let outcome = read();
        if Snapshot::of(paths) == before {
            return outcome;
        }
    }
    Err(overtaken(io::Error::other(format!(
        "found other files after each of {ATTEMPTS} attempts to read them; expected files that nobody is writing; run it again \
         when they are written"
    ))))
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
        let paths = std::slice::from_ref(&one);
        let replaced = |times: usize| {
            let mut rounds = 0;
            let text = steady(
                paths,
                |error| error,
                || {
                    let text = fs::read_to_string(&one);
                    rounds += 1;
                    if rounds <= times {
                        fs::write(&other, format!("new {rounds}")).unwrap();
                        fs::rename(&other, &one).unwrap();
                    }
                    text
                },
            );
            (text, rounds)
        };
        let (text, rounds) = replaced(2);
        assert_eq!((text.unwrap().as_str(), rounds), ("new 2", 3));
        // Files of two writers are given to nobody, however long one waits.
        let (text, rounds) = replaced(usize::MAX);
        assert!(text.unwrap_err().to_string().contains("nobody is writing"));
        assert_eq!(rounds, ATTEMPTS);
    }
}
