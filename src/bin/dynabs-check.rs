//! Solves and compares interval MDPs.

use clap::{Parser, Subcommand};
use dynabs::cli::diff::{DiffArguments, run};
use dynabs::cli::exit_with;
use std::process::ExitCode;

/// Solve and compare interval MDPs.
#[derive(Clone, Debug, Parser)]
#[command(name = "dynabs-check", version)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Clone, Debug, Subcommand)]
enum Command {
    /// Compare two run directories, models, results or reference files; exit code 1 on a difference.
    Diff(DiffArguments),
}

fn main() -> ExitCode {
    let Command::Diff(arguments) = Arguments::parse().command;
    exit_with(run(&arguments))
}
