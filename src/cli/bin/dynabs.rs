//! From a noisy control system to a controller with a proof: everything in one tool.

use dynabs_cli::commands::all::run;
use dynabs_cli::start;
use std::process::ExitCode;

fn main() -> ExitCode {
    start(run)
}
