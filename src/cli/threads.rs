//! The thread pool.

use super::CliError;

/// Makes the tool compute with this many threads, or with one per processor.
///
/// # Errors
/// [`CliError::Failure`] if the system gives no threads.
pub fn use_threads(threads: Option<u16>) -> Result<(), CliError> {
    let builder = rayon::ThreadPoolBuilder::new().num_threads(threads.map_or(0, usize::from));
    builder.build_global().map_err(|error| CliError::Failure(format!("threads: {error}")))
}
