//! `dynabs-check explain`: why the bound of a run is low, and what to change.

use crate::run_source::{Refined, refine};
use crate::{Bars, CliError, print};
use clap::Args;
use dynabs::abstraction::Abstraction;
use dynabs::explain::explain;
use imdp::progress::Progress;
use imdp::property::Verdict;
use imdp::solver::Answer;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

/// What to explain.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct ExplainArguments {
    /// A directory written by dynabs-compile.
    directory: PathBuf,

    /// Print one JSON object.
    #[arg(long)]
    json: bool,

    /// Print no progress.
    #[arg(short, long)]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  dynabs explain out/mine
  dynabs explain out/mine --json";

/// Runs the subcommand.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub fn run(arguments: &ExplainArguments) -> Result<ExitCode, CliError> {
    let bars = Arc::new(Bars::new(arguments.quiet));
    let Refined { run, answer, controller } = refine(&arguments.directory, &bars)?;
    let explanation = explain(&run.problem, &run.abstraction, &answer, &controller, &*bars);
    if bars.is_interrupted() {
        return Err(CliError::Interrupted);
    }
    if arguments.json {
        let object = serde_json::to_string_pretty(&explanation)
            .map_err(|error| CliError::Failure(format!("the explanation has no JSON form: {error}")))?;
        print(&format!("{object}\n"))?;
    } else {
        print(&explanation.to_string())?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Larger models are explained when that is asked for.
const QUICKLY_EXPLAINED: usize = 1_000_000;

/// What is said unasked where a larger model has a low bound.
pub(super) const HINT: &str =
    "the bound is low: `dynabs-check explain`, with the directory of this run, says why and what to change";

/// Whether a bound is low: it misses its threshold, or it is below one half.
pub(super) fn is_low(answer: &Answer) -> bool {
    answer.verdict == Some(Verdict::Fails) || answer.lower < 0.5
}

/// Whether an explanation, which solves the model with other intervals, takes no longer than a look at the result.
pub(super) fn is_soon_explained(abstraction: &Abstraction) -> bool {
    abstraction.model.rows().num_entries() <= QUICKLY_EXPLAINED
}
