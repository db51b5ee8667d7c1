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

/// How long this process has sent, received and waited for others, in nanoseconds.
static EXCHANGED: AtomicU64 = AtomicU64::new(0);

/// Notes that numbers were exchanged until now.
#[cfg(feature = "mpi")]
pub(super) fn exchanged_since(start: std::time::Instant) {
    EXCHANGED.fetch_add(start.elapsed().as_nanos() as u64, Ordering::Relaxed);
}

/// How long numbers were exchanged, for people; nothing where there is nobody to exchange them with.
pub(super) fn exchanged() -> String {
    match EXCHANGED.load(Ordering::Relaxed) {
        0 => String::new(),
        time => format!("; of it exchanged {:.1?}", Duration::from_nanos(time)),
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
