//! `dynabs`: everything in one tool.

use super::check;
use super::compile::{CompileArguments, compile_or_init};
use super::init::write_starter;
use super::sweep;
use crate::resources::Resources;
use crate::schemas::SchemaName;
use crate::together::require_one;
use crate::{CliError, print};
use clap::{CommandFactory, Parser, Subcommand};
use clap_complete::Shell;
use std::path::PathBuf;
use std::process::ExitCode;

/// From a noisy control system to a controller with a proof.
#[derive(Clone, Debug, Parser)]
#[command(name = "dynabs", version, after_help = AFTER_HELP)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,

    #[command(flatten)]
    resources: Resources,
}

#[derive(Clone, Debug, Subcommand)]
enum Command {
    /// Write a model file to start from.
    #[command(after_help = "Example:\n  dynabs init my.json")]
    Init {
        /// The file, which must not exist.
        file: PathBuf,
    },
    /// Print the JSON Schema of the model file, or of something that is written or printed as JSON.
    #[command(
        after_help = "Examples:\n  dynabs schema > dynabs-problem.schema.json\n  dynabs schema manifest"
    )]
    Schema {
        /// Of what.
        #[arg(value_enum, default_value_t)]
        of: SchemaName,
    },
    /// Compile a model file into an interval MDP with guaranteed probabilities, and solve it.
    Compile(Box<CompileArguments>),
    /// Compile and solve a model with many settings, here or as an array of jobs for Slurm, and collect one table.
    Sweep(sweep::SweepArguments),
    #[command(flatten)]
    Check(check::Command),
    /// Print a script with which a shell completes this command.
    #[command(
        after_help = "Example:\n  dynabs completions bash > ~/.local/share/bash-completion/completions/dynabs"
    )]
    Completions {
        /// The shell.
        shell: Shell,
    },
    /// Write the manual pages of this tool to a directory.
    #[command(after_help = "Example:\n  dynabs man ~/.local/share/man/man1")]
    Man {
        /// The directory, which is created.
        directory: PathBuf,
    },
}

const AFTER_HELP: &str = "\
dynabs-compile is `dynabs compile`; dynabs-check has the subcommands that work on its output.

Exit codes:
  0  done (and every property true)
  1  a property is false, a comparison differs, a certificate is rejected,
     or a simulation contradicts the promise
  2  bad input or usage
  3  undecided or interrupted
  4  I/O, memory or internal error

Examples:
  dynabs init my.json
  dynabs compile my.json --solve -o out/mine
  dynabs explain out/mine
  dynabs simulate out/mine
  dynabs export out/mine -o mine.c";

/// Runs the tool.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub fn run(arguments: &Arguments) -> Result<ExitCode, CliError> {
    arguments.resources.apply()?;
    if !matches!(arguments.command, Command::Compile(_) | Command::Check(_)) {
        require_one("this command")?;
    }
    match &arguments.command {
        Command::Init { file } => write_starter(file, false)?,
        Command::Schema { of } => print(&of.text()?)?,
        Command::Compile(arguments) => return compile_or_init(arguments, Some("compile")),
        Command::Sweep(arguments) => return sweep::run(arguments),
        Command::Check(command) => return check::run_command(command),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(*shell, &mut Arguments::command(), "dynabs", &mut script);
            print(&String::from_utf8_lossy(&script))?;
        }
        Command::Man { directory } => {
            std::fs::create_dir_all(directory).map_err(|error| CliError::writing(directory, &error))?;
            clap_mangen::generate_to(Arguments::command(), directory)
                .map_err(|error| CliError::writing(directory, &error))?;
        }
    }
    Ok(ExitCode::SUCCESS)
}
