//! `dynabs-check controller`: the refined feedback law as a file.

use crate::exports::replace;
use crate::input_run_source::SolvedInputs;
use crate::run_source::{Refined, refine};
use crate::{Bars, CliError, print};
use clap::Args;
use dynabs::controller::export::{
    CSourceError, c_source, input_c_source, write_csv, write_input_csv, write_input_json, write_json,
};
use dynabs::run::InputRun;
use imdp::solver::SolverOptions;
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
    if InputRun::is_in(&arguments.directory) {
        return write_inputs(arguments, &form, &bars);
    }
    let Refined { run, controller, .. } = refine(&arguments.directory, &bars)?;
    let problem = &run.problem;
    match form {
        Form::Json => replace(path, |out| write_json(&controller, problem, out))?,
        Form::Csv => replace(path, |out| write_csv(&controller, problem.grid(), out))?,
        Form::C => {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            let text = c_source(&controller, problem, &name).map_err(|error| no_c_source(path, &error))?;
            replace(path, |out| out.write_all(text.as_bytes()))?;
        }
    }
    if !arguments.quiet {
        let promise = controller.promise().join("\n  ");
        print(&format!("wrote {}\n  {promise}\n", path.display()))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The controller of a run whose actions are inputs.
fn write_inputs(
    arguments: &ControllerArguments,
    form: &Form,
    bars: &Arc<Bars>,
) -> Result<ExitCode, CliError> {
    let path = &arguments.output;
    bars.catch_interrupts();
    let options = SolverOptions { policy: true, ..SolverOptions::default() };
    let solved = SolvedInputs::open(&arguments.directory, &options, bars)?;
    let (controller, problem) = (solved.controller(), &solved.run.problem);
    match form {
        Form::Json => replace(path, |out| write_input_json(&controller, problem.name(), out))?,
        Form::Csv => replace(path, |out| write_input_csv(&controller, problem.grid(), out))?,
        Form::C => {
            let file = path.file_name().unwrap_or_default().to_string_lossy();
            let text = input_c_source(&controller, problem.name(), &file);
            let text = text.map_err(|error| no_c_source(path, &error))?;
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
            CliError::Input(format!("{}: found {error}\n  Write .json instead.", path.display()))
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
