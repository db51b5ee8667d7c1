//! `dynabs-check`: its subcommands.

use super::controller::{ControllerArguments, run as controller};
use super::convert::{ConvertArguments, run as convert};
use super::crosscheck::{CrosscheckArguments, run as crosscheck};
use super::diff::{DiffArguments, run as diff};
use super::explain::{ExplainArguments, run as explain};
use super::report::{ReportArguments, run as report};
use super::simulate::{SimulateArguments, run as simulate};
use super::solve::{SolveArguments, run as solve};
use super::validate::{ValidateArguments, run as validate};
use super::verify::{VerifyArguments, run as verify};
use crate::CliError;
use crate::resources::Resources;
use crate::together::require_one;
use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Solve interval MDPs by robust value iteration with bounds from below and above; write and simulate controllers.
#[derive(Clone, Debug, Parser)]
#[command(name = "dynabs-check", version, after_help = AFTER_HELP)]
pub struct CheckArguments {
    #[command(subcommand)]
    command: Command,

    #[command(flatten)]
    resources: Resources,
}

/// What `dynabs-check` can do.
#[derive(Clone, Debug, Subcommand)]
pub(super) enum Command {
    /// Solve properties of a compiled model or of a model in a file.
    Solve(SolveArguments),
    /// Write the controller of a compiled model as JSON, CSV or C.
    #[command(visible_alias = "export")]
    Controller(ControllerArguments),
    /// Simulate the closed loop of a compiled model and compare with what is promised.
    Simulate(SimulateArguments),
    /// Say why the bound of a compiled model is low, and what to change; for actions that are targets.
    Explain(ExplainArguments),
    /// Run the closed loop with fresh samples, each once, and say what that proves; for actions that are targets.
    Validate(ValidateArguments),
    /// Check a certificate of `solve --certificate` in exact arithmetic; exit code 1 if it is rejected.
    Verify(VerifyArguments),
    /// Write a model in another format, or with one state per row.
    Convert(ConvertArguments),
    /// Show a compiled model, its value function and closed loop as one HTML page.
    Report(ReportArguments),
    /// Compare two run directories, models, results or reference files; exit code 1 on a difference.
    Diff(DiffArguments),
    /// Ask PRISM or Storm the same, and compare the values of all states; exit code 1 if one disagrees.
    Crosscheck(CrosscheckArguments),
}

const AFTER_HELP: &str = "\
Exit codes: 0 done (and every property true), 1 a property is false at an initial state, a comparison differs,
a certificate is rejected or a simulation contradicts the promise, 2 bad input or usage, 3 undecided (limit, interrupt,
the bounds straddle the threshold, or an engine gave no answer), 4 I/O, memory or internal error (also an input outside U).";

/// Runs the tool.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub fn run(arguments: &CheckArguments) -> Result<ExitCode, CliError> {
    arguments.resources.apply()?;
    run_command(&arguments.command)
}

/// Runs a subcommand.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub(super) fn run_command(command: &Command) -> Result<ExitCode, CliError> {
    if !matches!(command, Command::Solve(_)) {
        require_one("this command")?;
    }
    match command {
        Command::Solve(arguments) => solve(arguments),
        Command::Controller(arguments) => controller(arguments),
        Command::Simulate(arguments) => simulate(arguments),
        Command::Explain(arguments) => explain(arguments),
        Command::Validate(arguments) => validate(arguments),
        Command::Verify(arguments) => verify(arguments),
        Command::Convert(arguments) => convert(arguments),
        Command::Report(arguments) => report(arguments),
        Command::Diff(arguments) => diff(arguments),
        Command::Crosscheck(arguments) => crosscheck(arguments),
    }
}
