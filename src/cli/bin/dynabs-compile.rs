//! Compiles a control problem into an interval MDP for PRISM.

use clap::Parser;
use dynabs_cli::commands::compile::{Arguments, run};
use dynabs_cli::exit_with;
use std::process::ExitCode;

fn main() -> ExitCode {
    exit_with(run(&Arguments::parse()))
}
