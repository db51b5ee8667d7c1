//! `dynabs-check solve`: properties of a model.

use crate::exports::{write_cell_policy, write_cell_values, write_evaluated, write_policy, write_values};
use crate::input_run_source::SolvedInputs;
use crate::input_summary::InputResult;
use crate::limits::LimitArguments;
use crate::model_source::{LoadedModel, load, model_help};
use crate::progress::SOLVING;
use crate::questions::{Asked, QuestionArguments};
use crate::resources::times;
use crate::results::{PropertyResult, exit_code, table};
use crate::{Bars, CliError, print, print_json, warn};
use clap::Args;
use dynabs::run::InputRun;
use imdp::certificate::{self, FileDigest};
use imdp::compare::ResultsFile;
use imdp::evaluation::{Evaluation, direct};
use imdp::files::Outputs;
use imdp::model::IntervalMdp;
use imdp::property::{Compound, Inquiry, Property};
use imdp::ranks;
use imdp::solver::{Answer, SolverOptions};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// What to solve and how.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct SolveArguments {
    #[arg(help = model_help())]
    path: PathBuf,

    #[command(flatten)]
    questions: QuestionArguments,

    /// Read model.tra of a directory instead of its native file.
    #[arg(long)]
    explicit: bool,

    /// Write the lower bound of every state, or true/false, one per line (for one property).
    #[arg(long, value_name = "FILE")]
    values: Option<PathBuf>,

    /// Write the policy as `state=action` or `state,step=action` (for one property).
    #[arg(long, value_name = "FILE")]
    policy: Option<PathBuf>,

    /// Write what is needed to check the result again with `verify` (for one property). For a directory of actions "inputs"
    /// it is the model of its files that is solved, not the lattice.
    #[arg(long, value_name = "FILE")]
    certificate: Option<PathBuf>,

    #[command(flatten)]
    limits: LimitArguments,

    /// Print one JSON object instead of the table.
    #[arg(long)]
    json: bool,

    /// Print nothing but errors (and the object of --json).
    #[arg(short, long)]
    quiet: bool,

    /// Print all digits, how each computation ended and how long it took, too.
    #[arg(short, long, conflicts_with_all = ["quiet", "json"])]
    verbose: bool,
}

const EXAMPLES: &str = "\
Examples:
  dynabs solve out/mine
  dynabs solve model.drn -p 'Pmaxmin=? [ F<=8 \"goal\" ]' --policy policy.txt";

impl SolveArguments {
    /// Whether files are to be written.
    fn is_written(&self) -> bool {
        [&self.values, &self.policy, &self.certificate].into_iter().any(Option::is_some)
    }
}

/// Runs the subcommand.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub fn run(arguments: &SolveArguments) -> Result<ExitCode, CliError> {
    let bars = Arc::new(Bars::new(arguments.quiet));
    let start = Instant::now();
    let is_input_task =
        InputRun::is_in(&arguments.path) && !arguments.explicit && arguments.questions.is_empty();
    if is_input_task && arguments.certificate.is_none() {
        return solve_inputs(arguments, &bars);
    }
    let (loaded, (mut questions, digests)) = load(&arguments.path, arguments.explicit, &bars, |loaded| {
        let is_told = arguments.certificate.is_some() || ranks::size() > 1;
        let digests = if is_told { loaded.digests()? } else { vec![] };
        Ok((arguments.questions.read(loaded)?, digests))
    })?;
    ranks::require_same(&(arguments, &questions, &digests));
    let reading = start.elapsed();
    if is_input_task {
        // A certificate is about the model of the directory: of its two bounds, the one that a controller guarantees.
        questions.truncate(1);
    }
    if arguments.is_written() && questions.len() != 1 {
        let found = questions.len();
        return Err(CliError::Input(format!(
            "--values, --policy, --certificate: found {found} properties; expected one, chosen by -p"
        )));
    }
    if !arguments.quiet {
        loaded.warnings.iter().for_each(|warning| warn(&format!("warning: {warning}\n")));
    }
    let mut results = Vec::with_capacity(questions.len());
    bars.expect(vec![(SOLVING, 1.0); questions.len()]);
    bars.catch_interrupts();
    for question in &questions {
        let outcome = match question.problem() {
            Some(problem) => Err(CliError::Input(problem)),
            None => solve(arguments, (&loaded, &digests), question, &bars),
        };
        match outcome {
            Ok(result) => results.push(result),
            // One that cannot be answered does not keep the others from it.
            Err(CliError::Input(problem)) if questions.len() > 1 => {
                warn(&format!("error: {problem}\n"));
                results.push(PropertyResult::failed(&question.entry.text, problem));
            }
            Err(error) => return Err(error),
        }
    }
    let code = exit_code(&results);
    if arguments.json {
        print_json(&report(&loaded.model, results, &loaded.warnings, reading))?;
    } else if !arguments.quiet {
        if arguments.verbose {
            warn(&times(&[("reading", reading), ("solving", start.elapsed() - reading)]));
        }
        print(&table(&results, arguments.verbose))?;
    }
    Ok(code)
}

/// Answers one property and writes what was asked for about it.
fn solve(
    arguments: &SolveArguments,
    (loaded, digests): (&LoadedModel, &[FileDigest]),
    question: &Asked,
    bars: &Bars,
) -> Result<PropertyResult, CliError> {
    let wanted = Wanted { policy: arguments.policy.is_some(), evidence: arguments.certificate.is_some() };
    let nature = arguments.questions.nature();
    match &question.entry.inquiry {
        Ok(Inquiry::Probability(property)) => {
            let property = direct(property.clone(), &loaded.model, nature);
            let (answer, mut result) = answer(&loaded.model, &property, &arguments.limits, wanted, bars)?;
            let claim = loaded.claim(&property, [answer.lower, answer.upper]);
            result.guarantee = claim.map_err(|error| CliError::Input(format!("{property}: {error}")))?;
            write_files(arguments, (loaded, digests), &property, answer)?;
            Ok(result)
        }
        Ok(Inquiry::Compound(compound)) => {
            let start = Instant::now();
            let evaluation = arguments.limits.with_options(bars, |options| {
                let options = SolverOptions { policy: wanted.policy, evidence: wanted.evidence, ..*options };
                Evaluation::new(&loaded.model, compound, nature, &options)
            });
            let mut evaluation =
                evaluation.map_err(|error| CliError::Input(format!("{compound}: {error}")))?;
            write_evaluation(arguments, (loaded, digests), compound, &mut evaluation)?;
            let mut result =
                PropertyResult::of_evaluation(compound, &evaluation, &loaded.model, start.elapsed());
            let bounds =
                result.recorded.lower.zip(result.recorded.upper).map(|(lower, upper)| [lower, upper]);
            result.guarantee = loaded.claim_of_expression(&compound.to_string(), bounds);
            Ok(result)
        }
        Err(error) => Err(CliError::Input(error.to_string())),
    }
}

/// Writes what was asked for about an expression.
fn write_evaluation(
    arguments: &SolveArguments,
    (loaded, digests): (&LoadedModel, &[FileDigest]),
    compound: &Compound,
    evaluation: &mut Evaluation,
) -> Result<(), CliError> {
    if !arguments.is_written() || !ranks::dismiss() {
        return Ok(());
    }
    let mut files = Outputs::default();
    if let Some(path) = &arguments.values {
        let written = files.write(path, |out| write_evaluated(&loaded.model, &*evaluation, out));
        written.map_err(|error| CliError::writing(path, &error))?;
    }
    if let Some(path) = &arguments.policy {
        let Some(policy) = &evaluation.policy else {
            return Err(CliError::Input(
                "--policy: found an expression whose policy needs a memory or is none; expected a single operator P of F, G, U \
                 or X, or R"
                    .to_owned(),
            ));
        };
        let written = files.write(path, |out| write_policy(&loaded.model, policy, out));
        written.map_err(|error| CliError::writing(path, &error))?;
    }
    if let Some(path) = &arguments.certificate {
        let nature = arguments.questions.nature();
        let derivation = evaluation.derivation(compound, nature, &loaded.model, digests.to_vec());
        let Some(derivation) = derivation else {
            return Err(CliError::Input(format!(
                "--certificate: found {compound}, which has a part that nothing proves: an automaton of a file, an F or U that \
                 begins after some steps, an infinite value that hangs on a tiny probability, or bounds that did not converge; \
                 expected F, G, U, X, R and LTL, perhaps inside of each other"
            )));
        };
        let written = files.write(path, |out| certificate::write_derivation(&derivation, out));
        written.map_err(|error| CliError::writing(path, &error))?;
    }
    files.commit().map_err(|error| CliError::Failure(error.to_string()))
}

/// The task of a run whose actions are inputs, on the lattice itself.
fn solve_inputs(arguments: &SolveArguments, bars: &Arc<Bars>) -> Result<ExitCode, CliError> {
    bars.catch_interrupts();
    let start = Instant::now();
    let options = arguments.limits.options();
    let SolvedInputs { run, solution } = SolvedInputs::open(&arguments.path, Some(&options), bars)?;
    let result = InputResult::new(&run.problem, &run.abstraction, &solution, start.elapsed());
    let result = result.with_exported(&run.problem, &run.abstraction, &options);
    if arguments.is_written() && !ranks::dismiss() {
        return Ok(ExitCode::SUCCESS);
    }
    let mut files = Outputs::default();
    if let Some(path) = &arguments.values {
        let written = files.write(path, |out| write_cell_values(&solution.values.lower, out));
        written.map_err(|error| CliError::writing(path, &error))?;
    }
    if let Some(path) = &arguments.policy {
        let cells = run.problem.grid().num_cells();
        let written = files.write(path, |out| write_cell_policy(&solution.policy, cells, out));
        written.map_err(|error| CliError::writing(path, &error))?;
    }
    files.commit().map_err(|error| CliError::Failure(error.to_string()))?;
    if arguments.json {
        print(&format!("{:#}\n", json!({"version": env!("CARGO_PKG_VERSION"), "results": [result]})))?;
    } else if !arguments.quiet {
        let initial =
            if run.problem.initial_state().is_some() { "at the initial state" } else { "over all cells" };
        print(&format!("{}\n{}", run.manifest.property, result.text(initial, arguments.verbose)))?;
    }
    Ok(result.exit_code())
}

/// Writes what was asked for about one property; all files appear together.
fn write_files(
    arguments: &SolveArguments,
    (loaded, digests): (&LoadedModel, &[FileDigest]),
    property: &Property,
    mut answer: Answer,
) -> Result<(), CliError> {
    if !arguments.is_written() || !ranks::dismiss() {
        return Ok(());
    }
    let model = &loaded.model;
    let mut files = Outputs::default();
    let failure = |path: &Path| {
        let path = path.to_owned();
        move |error| CliError::writing(&path, &error)
    };
    if let Some(path) = &arguments.values {
        files.write(path, |out| write_values(model, &answer, out)).map_err(failure(path))?;
    }
    if let (Some(path), Some(policy)) = (&arguments.policy, &answer.solution.policy) {
        files.write(path, |out| write_policy(model, policy, out)).map_err(failure(path))?;
    }
    if let Some(path) = &arguments.certificate
        && let Some(certificate) = answer.certificate(property, digests.to_vec())
    {
        files.write(path, |out| certificate::write(&certificate, out)).map_err(failure(path))?;
    }
    files.commit().map_err(|error| CliError::Failure(error.to_string()))
}

/// What is wanted of an answer besides the values.
#[derive(Clone, Copy)]
struct Wanted {
    policy: bool,
    evidence: bool,
}

/// Answers one property, with the current gap on display.
fn answer(
    model: &IntervalMdp,
    property: &Property,
    limits: &LimitArguments,
    wanted: Wanted,
    bars: &Bars,
) -> Result<(Answer, PropertyResult), CliError> {
    let start = Instant::now();
    let answer = limits.with_options(bars, |options| {
        Answer::new(
            model,
            property,
            &SolverOptions { policy: wanted.policy, evidence: wanted.evidence, ..*options },
        )
    });
    let answer = answer.map_err(|error| CliError::Input(format!("{property}: {error}")))?;
    let result = PropertyResult::new(property, &answer, model, start.elapsed());
    Ok((answer, result))
}

fn report(
    model: &IntervalMdp,
    results: Vec<PropertyResult>,
    warnings: &[String],
    reading: Duration,
) -> ResultsFile<PropertyResult> {
    let size = model.size();
    ResultsFile {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        states: Some(size.states),
        choices: Some(size.choices),
        transitions: Some(size.transitions),
        rows: Some(size.rows),
        results,
        warnings: warnings.to_vec(),
        seconds: [("reading".to_owned(), reading.as_secs_f64())].into(),
    }
}
