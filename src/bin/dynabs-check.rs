//! Solves interval MDPs by robust value iteration, natively and soundly.

use clap::Parser;
use dynabs::cli::check::{Arguments, run};
use dynabs::cli::exit_with;
use std::process::ExitCode;

fn main() -> ExitCode {
    exit_with(run(&Arguments::parse()))
}
