//! `dynabs-check diff`: what changed between two runs.

use crate::exports::replace;
use crate::extensions::require_extension;
use crate::{CliError, print, thousands};
use clap::Args;
use dynabs::run::{RecordError, open_record};
use imdp::compare::{CompareError, DiffOptions, Differences, Reference, Section, Tolerance, diff};
use serde_json::json;
use std::fmt::Write as _;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// What to compare and how closely.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct DiffArguments {
    /// A run directory, the stem or .tra of explicit files, a native model, results in JSON or a reference file.
    left: PathBuf,

    /// The same, to compare with.
    #[arg(required_unless_present = "write_reference")]
    right: Option<PathBuf>,

    /// A number differs if it exceeds this distance and the relative one.
    #[arg(long, value_name = "E", default_value_t = 1e-9, value_parser = not_negative)]
    absolute: f64,

    /// A number differs if it exceeds this fraction of the larger one and the absolute distance.
    #[arg(long, value_name = "E", default_value_t = 1e-9, value_parser = not_negative)]
    relative: f64,

    /// Show at most this many differences of each part.
    #[arg(long, value_name = "N", default_value_t = 10)]
    most: usize,

    /// Write a reference file about LEFT, which has a model, instead of comparing.
    #[arg(long, value_name = "FILE", conflicts_with = "right")]
    write_reference: Option<PathBuf>,

    /// Print one JSON object instead of the list.
    #[arg(long)]
    json: bool,

    /// Print nothing but errors (and the object of --json).
    #[arg(short, long)]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  dynabs diff out/before out/after
  dynabs diff out/mine --write-reference mine.reference.json";

fn not_negative(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|x| x.is_finite() && *x >= 0.0);
    number.ok_or_else(|| "expected a number that is not negative".to_owned())
}

impl From<CompareError> for CliError {
    fn from(error: CompareError) -> Self {
        if error.is_io() { Self::Failure(error.to_string()) } else { Self::Input(error.to_string()) }
    }
}

impl From<RecordError> for CliError {
    fn from(error: RecordError) -> Self {
        match error {
            RecordError::Compare(error) => error.into(),
            RecordError::Open(error) => error.into(),
            RecordError::Problem(error) => error.into(),
            error => Self::Input(error.to_string()),
        }
    }
}

/// Runs the subcommand: exit code 0 if nothing differs, 1 if something does.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub fn run(arguments: &DiffArguments) -> Result<ExitCode, CliError> {
    if let Some(path) = &arguments.write_reference {
        require_extension("--write-reference", path, &["json"])?;
    }
    let mut left = open_record(&arguments.left)?;
    if let Some(file) = &arguments.write_reference {
        return write_reference(file, &Reference::new(&mut left)?);
    }
    // clap asks for it unless a reference is written.
    let right = open_record(arguments.right.as_deref().unwrap_or(Path::new("")))?;
    let names = (left.name.clone(), right.name.clone());
    let tolerance = Tolerance { absolute: arguments.absolute, relative: arguments.relative };
    let comparison = diff(left, right, &DiffOptions { tolerance, most: arguments.most })?;
    if arguments.json {
        let object = json!({
            "left": names.0,
            "right": names.1,
            "same": comparison.is_same(),
            "sections": comparison.sections,
            "notes": comparison.notes,
        });
        print(&format!("{object:#}\n"))?;
    } else if !arguments.quiet {
        print(&text(&comparison, (&names.0, &names.1)))?;
    }
    Ok(if comparison.is_same() { ExitCode::SUCCESS } else { ExitCode::from(1) })
}

fn write_reference(file: &Path, reference: &Reference) -> Result<ExitCode, CliError> {
    replace(file, |out| out.write_all(reference.to_json().as_bytes()))?;
    Ok(ExitCode::SUCCESS)
}

fn text(comparison: &Differences, (left, right): (&str, &str)) -> String {
    let mut text = String::new();
    for section in &comparison.sections {
        write_section(section, &mut text);
    }
    // Writing to a string cannot fail.
    for note in &comparison.notes {
        let _ = writeln!(text, "note: {note}");
    }
    let verdict = if comparison.is_same() { "do not differ" } else { "differ" };
    let _ = writeln!(text, "{left} and {right} {verdict}");
    text
}

fn write_section(section: &Section, text: &mut String) {
    let Section { part, compared, differences, worst, .. } = section;
    let compared = thousands(*compared);
    if *differences == 0 {
        let _ = writeln!(text, "{part:<10} same ({compared} compared)");
        return;
    }
    let _ = writeln!(text, "{part:<10} {} of {compared} differ, the worst first:", thousands(*differences));
    for difference in worst {
        let by = difference.by.map_or_else(String::new, |by| format!("by {by:.1e}"));
        let _ = writeln!(text, "  {by:<10} {}: {} | {}", difference.place, difference.left, difference.right);
    }
}
