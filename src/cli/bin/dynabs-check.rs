//! Solves interval MDPs by robust value iteration, natively and soundly.

use dynabs_cli::commands::check::run;
use dynabs_cli::start;
use std::process::ExitCode;

fn main() -> ExitCode {
    start(run)
}
