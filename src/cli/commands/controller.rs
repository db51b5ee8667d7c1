//! `dynabs-check controller`: the refined feedback law as a file.

use crate::exports::replace;
use crate::run_source::{Refined, refine};
use crate::{Bars, CliError, print};
use clap::Args;
use dynabs::controller::export::{CSourceError, c_source, write_csv, write_json};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

/// Which controller to write where.
#[derive(Clone, Debug, Args)]
pub struct ControllerArguments {
    /// A directory written by dynabs-compile.
    directory: PathBuf,

    /// The file to write: .json describes everything, .csv lists cells and actions, .c is C99 to deploy.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    /// Print nothing but errors.
    #[arg(short, long)]
    quiet: bool,
}

/// Runs the subcommand.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub fn run(arguments: &ControllerArguments) -> Result<ExitCode, CliError> {
    let path = &arguments.output;
    let form = Form::of(path)?;
    let bars = Arc::new(Bars::new(arguments.quiet));
    let Refined { run, controller, .. } = refine(&arguments.directory, &bars)?;
    let problem = &run.problem;
    match form {
        Form::Json => replace(path, |out| write_json(&controller, problem, out))?,
        Form::Csv => replace(path, |out| write_csv(&controller, problem.grid(), out))?,
        Form::C => {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let text = c_source(&controller, problem, &name).map_err(|error| match error {
                CSourceError::HorizonTooLong { .. } => {
                    CliError::Input(format!("{}: found {error}\n  Write .json instead.", path.display()))
                }
                CSourceError::Template { .. } => CliError::Failure(error.to_string()),
            })?;
            replace(path, |out| out.write_all(text.as_bytes()))?;
        }
    }
    if !arguments.quiet {
        let promise = controller.promise().join("\n  ");
        print(&format!("wrote {}\n  {promise}\n", path.display()))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// What is written.
enum Form {
    Json,
    Csv,
    C,
}

impl Form {
    fn of(path: &Path) -> Result<Self, CliError> {
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("json") => Ok(Self::Json),
            Some("csv") => Ok(Self::Csv),
            Some("c") => Ok(Self::C),
            _ => Err(CliError::Input(format!(
                "--output: found \"{}\"; expected a file that ends in .json, .csv or .c",
                path.display()
            ))),
        }
    }
}
