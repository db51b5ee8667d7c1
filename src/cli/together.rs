//! Processes that share the work of a tool, where there are several: they all run it, the first one speaks and writes.

use super::{CliError, exit_with};
use std::process::ExitCode;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

/// Runs a tool in this process, and in those that were started with it.
#[cfg(not(feature = "mpi"))]
pub(super) fn together(tool: impl FnOnce() -> Result<ExitCode, CliError>) -> ExitCode {
    exit_with(tool())
}

/// Runs a tool in this process, and in those that were started with it.
#[cfg(feature = "mpi")]
pub(super) fn together(tool: impl FnOnce() -> Result<ExitCode, CliError>) -> ExitCode {
    use super::mpi::Crew;
    match Crew::assemble() {
        Err(error) => exit_with(Err(error)),
        Ok(crew) => {
            let outcome = crew.work(tool);
            crew.part(outcome)
        }
    }
}

/// How long this process has sent, received and waited for others, in nanoseconds; how many bytes it has then had, in how many exchanges.
static EXCHANGED: [AtomicU64; 3] = [const { AtomicU64::new(0) }; 3];

/// Notes that so many bytes were exchanged until now.
#[cfg(feature = "mpi")]
pub(super) fn exchanged_since(start: std::time::Instant, bytes: usize) {
    let amounts = [start.elapsed().as_nanos() as u64, bytes as u64, 1];
    for (total, more) in EXCHANGED.iter().zip(amounts) {
        total.fetch_add(more, Ordering::Relaxed);
    }
}

/// What was exchanged and how long it took, for people; nothing where there is nobody to exchange it with.
pub(super) fn exchanged() -> String {
    let [time, bytes, exchanges] = EXCHANGED.each_ref().map(|total| total.load(Ordering::Relaxed));
    match exchanges {
        0 => String::new(),
        _ => format!(
            "; of it {:.1?} for {:.1} MB in {exchanges} exchanges",
            Duration::from_nanos(time),
            bytes as f64 / 1e6
        ),
    }
}

/// Refuses a command whose work is not shared, where there are others to share it with.
pub(super) fn require_one(command: &str) -> Result<(), CliError> {
    match imdp::ranks::size() {
        1 => Ok(()),
        found => Err(CliError::Input(format!(
            "{command}: found {found} processes; expected one: only compile and solve are shared\n  Start it without mpirun or srun."
        ))),
    }
}
