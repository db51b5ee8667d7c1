//! Jobs on this machine, several at a time.

use super::job::{Job, Outcome, Purpose};
use super::program::Program;
use crate::CliError;
use std::num::NonZero;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::{self, available_parallelism};

/// Runs the jobs that are open, so many at a time, and tells of every one that has ended.
///
/// # Errors
/// [`CliError::Failure`] if a process cannot be started.
pub(super) fn run(jobs: &[Job], at_once: Option<usize>, tell: impl Fn(&Job) + Sync) -> Result<(), CliError> {
    let processors = available_parallelism().map_or(1, NonZero::get);
    let workers = at_once.unwrap_or(processors).min(jobs.len());
    let program = Program::this(Some("compile"), (processors / workers.max(1)).max(1))?;
    let next = AtomicUsize::new(0);
    let failure = Mutex::new(None);
    let work = || {
        while let Some(job) = jobs.get(next.fetch_add(1, Ordering::Relaxed)) {
            if !matches!(job.outcome(Purpose::Run), Outcome::Open) {
                continue;
            }
            match job.run(&program, Purpose::Run) {
                Ok(()) => tell(job),
                Err(error) => {
                    next.store(jobs.len(), Ordering::Relaxed);
                    let failed = CliError::writing(&job.directory, &error);
                    failure.lock().unwrap_or_else(std::sync::PoisonError::into_inner).get_or_insert(failed);
                }
            }
        }
    };
    thread::scope(|scope| (0..workers).for_each(|_| drop(scope.spawn(work))));
    failure.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner).map_or(Ok(()), Err)
}
