//! `dynabs-check controller`: the refined feedback law as a file.

use crate::exports::replace;
use crate::run_source::Controlled;
use crate::{Bars, CliError, print};
use clap::Args;
use dynabs::controller::export::{
    ExportError, c_header, c_source, mat, matlab_source, npz, python_source, ros2_source, s_function_source,
    write_csv, write_input_json, write_json,
};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

/// Which controller to write where.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct ControllerArguments {
    /// A directory written by dynabs-compile.
    directory: PathBuf,

    /// The file to write, whose ending says what.
    ///
    /// .json describes everything, .csv lists cells and actions; to deploy: .c is C99 and .h its header, .py a Python module
    /// that needs NumPy alone, .m a function of MATLAB and Octave, _sfun.c an S-function of Simulink, _ros2.py a node of ROS 2;
    /// .npz and .mat hold the tables of these.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    /// Print nothing but errors.
    #[arg(short, long)]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  dynabs export out/mine -o mine.c
  dynabs export out/mine -o mine.json";

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
        run.require_text(
            "the controller in one piece",
            "Write .csv instead, or use fewer /partition/cells.",
        )?;
    }
    let (controller, name) = (run.controller(), run.name());
    let exported = match &form {
        Form::Json => {
            replace(path, |out| match &run {
                Controlled::Targets(refined) => write_json(controller, &refined.run.problem, out),
                Controlled::Inputs(..) => write_input_json(controller, name, out),
            })?;
            None
        }
        Form::Csv => {
            replace(path, |out| write_csv(controller, run.grid(), out))?;
            None
        }
        Form::C(file) => Some(c_source(controller, name, file).map(String::into_bytes)),
        Form::Header => Some(c_header(controller, name).map(String::into_bytes)),
        Form::SFunction(block) => Some(s_function_source(controller, name, block).map(String::into_bytes)),
        Form::Python => Some(python_source(controller, name).map(String::into_bytes)),
        Form::Ros2 => Some(ros2_source(controller, name).map(String::into_bytes)),
        Form::Matlab(function) => Some(matlab_source(controller, name, function).map(String::into_bytes)),
        Form::Npz => Some(npz(controller)),
        Form::Mat => Some(mat(controller)),
    };
    if let Some(exported) = exported {
        let bytes = exported.map_err(|error| not_exported(path, &error))?;
        replace(path, |out| out.write_all(&bytes))?;
    }
    if !arguments.quiet {
        let promise = controller.promise().join("\n  ");
        print(&format!("wrote {}\n  {promise}\n", path.display()))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn not_exported(path: &Path, error: &ExportError) -> CliError {
    match error {
        ExportError::HorizonTooLong { .. } | ExportError::Packing(_) => {
            CliError::Input(format!("{}: {error}\n  Write .json instead.", path.display()))
        }
        ExportError::Template(_) => CliError::Failure(error.to_string()),
    }
}

/// What is written, with what the file's name says.
#[derive(Debug, PartialEq, Eq)]
enum Form {
    Json,
    Csv,
    C(String),
    Header,
    SFunction(String),
    Python,
    Ros2,
    Matlab(String),
    Npz,
    Mat,
}

impl Form {
    fn of(path: &Path) -> Result<Self, CliError> {
        let file = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let Some((stem, ending)) = file.rsplit_once('.') else { return Err(unknown(path)) };
        Ok(match ending {
            "json" => Self::Json,
            "csv" => Self::Csv,
            "c" if stem.ends_with("_sfun") => Self::SFunction(named(path, stem)?),
            "c" => Self::C(file),
            "h" => Self::Header,
            "py" if stem.ends_with("_ros2") => Self::Ros2,
            "py" => {
                imported(path, stem)?;
                Self::Python
            }
            "m" => Self::Matlab(named(path, stem)?),
            "npz" => Self::Npz,
            "mat" => Self::Mat,
            _ => return Err(unknown(path)),
        })
    }
}

fn unknown(path: &Path) -> CliError {
    CliError::Input(format!(
        "--output: found \"{}\"; expected a file that ends in .json, .csv, .c, .h, .py, .m, .npz, .mat, _sfun.c or _ros2.py",
        path.display()
    ))
}

/// MATLAB calls a function by the name of its file.
fn named(path: &Path, stem: &str) -> Result<String, CliError> {
    let is_name = stem.len() <= 63
        && stem.starts_with(|c: char| c.is_ascii_alphabetic())
        && stem.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    if is_name && !MATLAB_WORDS.contains(&stem) {
        return Ok(stem.to_owned());
    }
    Err(CliError::Input(format!(
        "--output: found \"{}\"; expected a name, no word of the language, of letters, digits and _ that begins with a letter, 63 at most\n  \
         MATLAB calls a function by the name of its file.",
        path.display()
    )))
}

/// Python imports a module by the name of its file.
fn imported(path: &Path, stem: &str) -> Result<(), CliError> {
    let is_name = stem.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && stem.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    if is_name && !PYTHON_WORDS.contains(&stem) {
        return Ok(());
    }
    Err(CliError::Input(format!(
        "--output: found \"{}\"; expected a name, no word of the language, of letters, digits and _ that does not begin with a \
         digit\n  Python imports a module by the name of its file.",
        path.display()
    )))
}

/// What cannot be the name of a module of Python.
const PYTHON_WORDS: [&str; 35] = [
    "False", "None", "True", "and", "as", "assert", "async", "await", "break", "class", "continue", "def",
    "del", "elif", "else", "except", "finally", "for", "from", "global", "if", "import", "in", "is",
    "lambda", "nonlocal", "not", "or", "pass", "raise", "return", "try", "while", "with", "yield",
];

/// What cannot be the name of a function of MATLAB.
const MATLAB_WORDS: [&str; 20] = [
    "break",
    "case",
    "catch",
    "classdef",
    "continue",
    "else",
    "elseif",
    "end",
    "for",
    "function",
    "global",
    "if",
    "otherwise",
    "parfor",
    "persistent",
    "return",
    "spmd",
    "switch",
    "try",
    "while",
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ending_says_what_is_written() {
        let of = |name: &str| Form::of(Path::new(name));
        assert_eq!(of("out/a.b.c").unwrap(), Form::C("a.b.c".into()));
        assert_eq!(of("out/room_sfun.c").unwrap(), Form::SFunction("room_sfun".into()));
        assert_eq!(of("room_ros2.py").unwrap(), Form::Ros2);
        assert_eq!(of("room.py").unwrap(), Form::Python);
        assert_eq!(of("room.m").unwrap(), Form::Matlab("room".into()));
        for (name, expected) in [
            ("room.cpp", "ends in"),
            ("room", "ends in"),
            ("2d.m", "begins with a letter"),
            ("a-b_sfun.c", "letters"),
            ("end.m", "no word of the language"),
            ("class.py", "no word of the language"),
            ("my-room.py", "letters"),
            ("2d.py", "begin with a digit"),
        ] {
            let error = of(name).unwrap_err().to_string();
            assert!(error.contains(expected) && error.contains(name), "{error}");
        }
    }
}
