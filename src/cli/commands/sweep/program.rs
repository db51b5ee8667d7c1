//! This program again, for one job.

use crate::CliError;
use imdp::model::given_memory;
use std::path::PathBuf;
use std::process::Command;

/// How to call `compile` in a process of its own: what it runs out of is lost for one job only.
pub(in crate::commands) struct Program {
    path: PathBuf,
    /// The name of `compile` among its commands; none if it has no others.
    subcommand: Option<&'static str>,
    /// How many threads a job may use.
    threads: usize,
}

impl Program {
    /// The running program.
    ///
    /// # Errors
    /// [`CliError::Failure`] if the system does not say where it is.
    pub(in crate::commands) fn this(
        subcommand: Option<&'static str>,
        threads: usize,
    ) -> Result<Self, CliError> {
        let path =
            std::env::current_exe().map_err(|error| CliError::Failure(format!("this program: {error}")))?;
        Ok(Self { path, subcommand, threads })
    }

    /// The command without the arguments of a job.
    pub(super) fn compile(&self) -> Command {
        let mut command = Command::new(&self.path);
        command.args(self.subcommand).args(["--threads", &self.threads.to_string()]);
        if let Some(bytes) = given_memory() {
            command.args(["--memory", &bytes.to_string()]);
        }
        command
    }
}
