//! `dynabs-check verify`: certificates, checked in exact arithmetic.

use crate::model_source::{LoadedModel, load};
use crate::results::number;
use crate::{Bars, CliError, print, thousands};
use clap::Args;
use imdp::certificate::{CertificateError, Statement, read_statement_file};
use imdp::evaluation::check_derivation;
use imdp::files::is_fault_of_input;
use imdp::verify::{Proved, Rejection, check};
use serde_json::json;
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// What to check against what.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct VerifyArguments {
    /// A certificate written by `solve --certificate`.
    certificate: PathBuf,

    /// The model that was solved: the directory or the .tra file.
    path: PathBuf,

    /// Print one JSON object.
    #[arg(long)]
    json: bool,

    /// Print nothing but errors (and the object of --json).
    #[arg(short, long)]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  dynabs solve out/mine -p 'Pmaxmin=? [ F \"reached\" ]' --certificate mine.cert
  dynabs verify mine.cert out/mine";

/// Runs the subcommand.
///
/// # Errors
/// [`CliError`], which knows its exit code; a rejection is none.
pub fn run(arguments: &VerifyArguments) -> Result<ExitCode, CliError> {
    let bars = Bars::new(arguments.quiet);
    let start = Instant::now();
    let shown = arguments.certificate.display();
    let statement = read_statement_file(&arguments.certificate).map_err(|error| match error {
        CertificateError::Io(ref io) if !is_fault_of_input(io) => {
            CliError::Failure(format!("{shown}: {error}"))
        }
        _ => CliError::Input(format!("{shown}: {error}")),
    })?;
    let files = match &statement {
        Statement::Probability(certificate) => &certificate.files,
        Statement::Expression(derivation) => &derivation.files,
    };
    let explicit = files.iter().any(|file| file.kind == "tra");
    let (loaded, digests) = load(&arguments.path, explicit, &bars, LoadedModel::digests)?;
    let (asked, outcome) = match &statement {
        Statement::Probability(certificate) => {
            (certificate.property.to_string(), check(certificate, &loaded.model, &digests))
        }
        Statement::Expression(derivation) => {
            (derivation.expression.clone(), check_derivation(derivation, &loaded.model, &digests))
        }
    };
    if let Err(Rejection::Memory(error)) = outcome {
        return Err(CliError::Input(error.to_string()));
    }
    if arguments.json {
        print(&format!("{:#}\n", report(&asked, &outcome, start.elapsed())))?;
    } else if !arguments.quiet {
        print(&summary(&asked, &outcome, start.elapsed()))?;
    }
    Ok(if outcome.is_ok() { ExitCode::SUCCESS } else { ExitCode::from(1) })
}

fn summary(property: &str, outcome: &Result<Proved, Rejection>, time: Duration) -> String {
    match outcome {
        Err(rejection) => format!("{property}\n  rejected   {rejection}\n"),
        Ok(proved) => format!(
            "{property}\n  accepted   {}value in [{:?}, {:?}] at the initial state   {} states, steps: {}, rows: {}, \
             {time:.1?}\n",
            proved.verdict.map_or_else(String::new, |verdict| format!("{verdict}   ")),
            proved.lower,
            proved.upper,
            thousands(proved.states),
            thousands(proved.steps),
            thousands(proved.rows),
        ),
    }
}

fn report(property: &str, outcome: &Result<Proved, Rejection>, time: Duration) -> serde_json::Value {
    match outcome {
        Err(rejection) => {
            json!({"property": property, "accepted": false, "reason": rejection.to_string()})
        }
        Ok(proved) => json!({
            "property": property,
            "accepted": true,
            "lower": number(proved.lower),
            "upper": number(proved.upper),
            "verdict": proved.verdict.map(|verdict| verdict.to_string()),
            "states": proved.states,
            "steps": proved.steps,
            "rows": proved.rows,
            "seconds": time.as_secs_f64(),
        }),
    }
}
