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
            ExitCode::from(match error {
                CliError::Input(_) => 2,
                CliError::Interrupted => 3,
                _ => 4,
            })
        }
    }
}
