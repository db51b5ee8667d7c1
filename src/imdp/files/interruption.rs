//! Telling writing that was ended by the user from writing that failed.

use std::fmt;
use std::io;

/// The user does not want the output any more.
#[derive(Debug)]
struct Interruption;

impl fmt::Display for Interruption {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("interrupted, nothing was written")
    }
}

impl std::error::Error for Interruption {}

/// What a writer returns when it is asked to stop.
///
/// Not [`io::ErrorKind::Interrupted`]: that one is tried again.
pub fn interruption() -> io::Error {
    io::Error::other(Interruption)
}

/// Whether an error is an [`interruption`].
pub fn is_interruption(error: &io::Error) -> bool {
    error.get_ref().is_some_and(|inner| inner.is::<Interruption>())
}
