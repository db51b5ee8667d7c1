//! The thread pool.

use super::CliError;
use std::num::NonZero;
use std::thread::available_parallelism;

/// More threads than this, or than four for every processor, only get into each other's way.
const MANY: usize = 64;

/// Makes the tool compute with this many threads, or with one per processor.
///
/// # Errors
/// [`CliError::Input`] for more threads than make sense, [`CliError::Failure`] if the system gives none.
pub fn use_threads(threads: Option<u16>) -> Result<(), CliError> {
    let threads = threads.map_or(0, usize::from);
    let most = MANY.max(4 * available_parallelism().map_or(1, NonZero::get));
    if threads > most {
        return Err(CliError::Input(format!(
            "--threads: found {threads}; expected at most {most} on this machine"
        )));
    }
    let builder = rayon::ThreadPoolBuilder::new().num_threads(threads);
    builder.build_global().map_err(|error| {
        CliError::Failure(format!(
            "threads: found {error}; expected that the system gives them; give fewer by --threads"
        ))
    })
}
