//! From the process to a tool and back.

use super::output::is_muted;
use super::together::together;
use super::{CliError, print, signals, warn};
use clap::Parser;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;

/// Runs a tool with the arguments of the process; every end has a documented exit code.
pub fn start<A: Parser>(run: fn(&A) -> Result<ExitCode, CliError>) -> ExitCode {
    together(|| attempt(run))
}

fn attempt<A: Parser>(run: fn(&A) -> Result<ExitCode, CliError>) -> Result<ExitCode, CliError> {
    signals::watch()?;
    // As PRISM spells it.
    let given = std::env::args_os().map(|given| if given == "-const" { "--const".into() } else { given });
    let arguments = match A::try_parse_from(given) {
        Ok(arguments) => arguments,
        Err(error) => return Ok(usage(&error)),
    };
    // Nothing is used afterwards that a panic could have left in the middle.
    catch_unwind(AssertUnwindSafe(|| run(&arguments))).unwrap_or_else(|_| {
        let mistake = "the above should not happen; it is a mistake in dynabs, please report it";
        Err(CliError::Failure(mistake.to_owned()))
    })
}

/// Shows a help text, or what is wrong with the arguments.
fn usage(error: &clap::Error) -> ExitCode {
    let has_control = |argument: std::ffi::OsString| argument.to_string_lossy().chars().any(char::is_control);
    if is_muted() {
        // The first process says it.
    } else if !std::env::args_os().any(has_control) {
        // With colours, where there are some.
        let _ = error.print();
    } else if error.use_stderr() {
        warn(&error.to_string());
    } else {
        let _ = print(&error.to_string());
    }
    ExitCode::from(if error.use_stderr() { 2 } else { 0 })
}
