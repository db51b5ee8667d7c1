//! Compiles a control problem into an interval MDP for PRISM.

use dynabs_cli::commands::compile::run;
use dynabs_cli::start;
use std::process::ExitCode;

fn main() -> ExitCode {
    start(run)
}
