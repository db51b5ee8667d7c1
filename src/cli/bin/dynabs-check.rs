//! Solves interval MDPs by robust value iteration, natively and soundly.

use clap::Parser;
use dynabs_cli::commands::check::{Arguments, run};
use dynabs_cli::exit_with;
use std::process::ExitCode;

fn main() -> ExitCode {
    exit_with(run(&Arguments::parse()))
}
