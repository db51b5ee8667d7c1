//! How the tools end.

use super::{CliError, warn};
use std::process::ExitCode;

/// Reports an error on stderr and turns the outcome into an exit code.
///
/// 0 done, 2 bad input or usage, 3 interrupted, 4 I/O or internal error; 1 is up to the tool.
pub fn exit_with(outcome: Result<ExitCode, CliError>) -> ExitCode {
    match outcome {
        Ok(code) => code,
        Err(error) => {
            warn(&format!("error: {error}\n"));
            error.exit_code().into()
        }
    }
}

impl CliError {
    /// The exit code of the tool that stopped because of it.
    pub(crate) fn exit_code(&self) -> u8 {
        match self {
            Self::Input(_) => 2,
            Self::Interrupted => 3,
            Self::Failure(_) => 4,
        }
    }
}
