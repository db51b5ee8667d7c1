//! `dynabs-check controller`: the refined feedback law as a file.

use crate::exports::replace;
use crate::run_source::Controlled;
use crate::{Bars, CliError, print};
use clap::Args;
use dynabs::controller::export::{CSourceError, c_source, write_csv, write_input_json, write_json};
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
    let run = Controlled::open(&arguments.directory, &bars)?;
    if !matches!(form, Form::Csv) {
        run.require_text("the controller as one text", "Write .csv instead, or use fewer /partition/cells.")?;
    }
    let controller = run.controller();
    match form {
        Form::Json => replace(path, |out| match &run {
            Controlled::Targets(refined) => write_json(controller, &refined.run.problem, out),
            Controlled::Inputs(..) => write_input_json(controller, run.name(), out),
        })?,
        Form::Csv => replace(path, |out| write_csv(controller, run.grid(), out))?,
        Form::C => {
            let file = path.file_name().unwrap_or_default().to_string_lossy();
            let text = c_source(controller, run.name(), &file).map_err(|error| no_c_source(path, &error))?;
            replace(path, |out| out.write_all(text.as_bytes()))?;
        }
    }
    if !arguments.quiet {
        let promise = controller.promise().join("\n  ");
        print(&format!("wrote {}\n  {promise}\n", path.display()))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn no_c_source(path: &Path, error: &CSourceError) -> CliError {
    match error {
        CSourceError::HorizonTooLong { .. } => {
            CliError::Input(format!("{}: {error}\n  Write .json instead.", path.display()))
        }
        CSourceError::Template { .. } => CliError::Failure(error.to_string()),
    }
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
