//! Other people's solvers: finding them, running them, reading back what they computed.
//!
//! An engine runs as a program of its own in a temporary directory, with a limit on its time and memory, and is
//! ended with everything that it started when it exceeds them or the user interrupts. Its
//! answer counts only if it ended by itself, without an error, and left one probability for every state:
//! everything else is an [`EngineFailure`].

mod cross_check;
mod engine;
mod failure;
mod find;
mod finding;
mod judge;
mod prism;
mod process;
mod process_group;
mod question;
mod raised;
mod storm;
mod storm_question;
mod strategy;
mod values;

pub use cross_check::{CrossCheckOptions, cross_check};
pub use engine::Engine;
pub use failure::{EngineFailure, EngineMissing};
pub use finding::{Agreement, CrossCheckFile, Finding, StrategyFinding};
pub use prism::Prism;
pub use process::RunLimits;
pub use question::{EngineAnswer, EngineQuestion, Handed, QuestionKind, Reply, Subject};
pub use raised::raised;
pub use storm::Storm;
pub use strategy::Strategy;

use crate::files::StagedDirectory;
use std::io;
use std::path::Path;

/// A directory for one run, gone with its value; what killed processes left of theirs goes as well.
fn scratch() -> io::Result<StagedDirectory> {
    let directory = StagedDirectory::new(&std::env::temp_dir())?;
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        std::fs::set_permissions(directory.path(), std::fs::Permissions::from_mode(0o700))?;
    }
    Ok(directory)
}

/// Gives a file a second name.
fn link(file: &Path, name: &Path) -> io::Result<()> {
    let file = std::path::absolute(file)?;
    #[cfg(unix)]
    return std::os::unix::fs::symlink(file, name);
    #[cfg(not(unix))]
    return std::fs::copy(file, name).map(drop);
}

/// Refuses to begin a file that will not fit into a directory.
fn require_space(directory: &Path, bytes: u64) -> io::Result<()> {
    let free = fs4::available_space(directory)?;
    if bytes <= free {
        return Ok(());
    }
    let (needed, free) = (bytes.div_ceil(1 << 20), free >> 20);
    Err(io::Error::new(
        io::ErrorKind::StorageFull,
        format!("it needs {needed} MiB, {free} MiB are free; set TMPDIR to a larger disk"),
    ))
}
