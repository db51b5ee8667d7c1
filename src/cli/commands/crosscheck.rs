//! `dynabs-check crosscheck`: the same question to other people's solvers.

use super::solve::LimitArguments;
use crate::crosscheck_table::table;
use crate::model_source::{LoadedModel, load};
use crate::questions::QuestionArguments;
use crate::{Bars, CliError, print, warn};
use clap::{Args, ValueEnum};
use dynabs::run::NATIVE_MODEL;
use imdp::engines::{
    Agreement, CrossCheckOptions, Engine, EngineMissing, Finding, Prism, RunLimits, Storm, Subject,
    cross_check, raised,
};
use imdp::evaluation::direct;
use imdp::formats::prism::check_names;
use imdp::model::available_memory;
use imdp::property::{Inquiry, Property};
use serde_json::json;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

/// What to ask, whom, and for how long.
#[derive(Clone, Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub struct CrosscheckArguments {
    /// A directory written by dynabs-compile, or a .tra file with .sta and .lab beside it.
    path: PathBuf,

    /// The engine to ask.
    #[arg(long, value_enum, default_value_t = With::All)]
    with: With,

    #[command(flatten)]
    questions: QuestionArguments,

    /// PRISM's program. Default: $PRISM, or prism in PATH.
    #[arg(long, value_name = "PATH")]
    prism: Option<PathBuf>,

    /// A Python that can import stormpy. Default: $DYNABS_PYTHON, that of $VIRTUAL_ENV, or python3.
    #[arg(long, value_name = "PATH")]
    python: Option<PathBuf>,

    /// End an engine that takes longer than this many seconds for one property.
    #[arg(long, value_name = "SECONDS", default_value_t = 600.0, value_parser = super::solve::seconds)]
    timeout: f64,

    /// Unbounded properties: how close our own bounds must be.
    #[arg(long, value_name = "E", default_value_t = 1e-10, value_parser = super::solve::positive)]
    epsilon: f64,

    /// Print one JSON object instead of the table.
    #[arg(long)]
    json: bool,

    /// Print nothing but errors (and the object of --json).
    #[arg(short, long)]
    quiet: bool,
}

/// Which engines to ask.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum With {
    /// PRISM's explicit engine.
    Prism,
    /// Storm, by its Python bindings.
    Storm,
    /// Both.
    All,
}

const AFTER_HELP: &str = "\
Compares the values of all states with our bounds, and what an engine's strategy is worth with what it claims.
Exit codes: 0 every engine agrees; 1 one disagrees; 2 bad input, or none of the engines is installed; 3 nobody
disagrees, but an engine is missing, failed, ran out of time or memory, or one of us stopped too early to tell.

Examples:
  dynabs-check crosscheck out --with all
  dynabs-check crosscheck out --with prism --prism ~/prism/bin/prism --memory 8g -p 'Pmaxmin=? [ F \"reached\" ]'";

/// No engine does anything with less.
const LEAST_MEMORY_MIB: u64 = 16;

/// Runs the subcommand; an engine may use so much memory in bytes, else three quarters of what is available.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub fn run(arguments: &CrosscheckArguments, memory: Option<u64>) -> Result<ExitCode, CliError> {
    let Engines { found, missing } = find_engines(arguments)?;
    let bars = Arc::new(Bars::new(arguments.quiet));
    let loaded = load(&arguments.path, false, &bars)?;
    let properties = properties(&arguments.questions, &loaded)?;
    let digests = loaded.digests()?;
    let failure = |error| CliError::Failure(format!("{}: {error}", arguments.path.display()));
    let raised = raised(&loaded.model).map_err(failure)?;
    // Files that only we read are written again for the engines.
    let as_is = check_names(&loaded.model).is_ok() && !loaded.has_own_layout;
    let files = explicit_files(&arguments.path, raised.is_some()).filter(|_| as_is);
    let subject = Subject { model: &loaded.model, raised: raised.as_ref(), files: files.as_ref() };
    say(arguments, &loaded.warnings, "warning: ");
    say(arguments, &missing.iter().map(ToString::to_string).collect::<Vec<_>>(), "missing: ");

    bars.catch_interrupts();
    let available = || available_memory().map_or(4 << 30, |(bytes, _)| bytes / 4 * 3);
    let memory_mib = (memory.unwrap_or_else(available) >> 20).max(LEAST_MEMORY_MIB);
    let limits = RunLimits {
        timeout: Duration::from_secs_f64(arguments.timeout),
        memory_mib,
        interrupt: Some(bars.interrupt()),
    };
    let engines: Vec<&dyn Engine> = found.iter().map(|engine| &**engine).collect();
    let findings = LimitArguments::of_epsilon(arguments.epsilon).with_options(&bars, |solver| {
        cross_check(&subject, &properties, &engines, &CrossCheckOptions { solver: *solver, limits })
    })?;
    if arguments.json {
        let object = json!({
            "version": env!("CARGO_PKG_VERSION"),
            "path": arguments.path.display().to_string(),
            "model": digests.iter().map(|file| json!({"kind": file.kind, "sha256": file.sha256})).collect::<Vec<_>>(),
            "agree": missing.is_empty() && agree(&findings),
            "findings": findings,
            "missing": missing.iter().map(|missing| missing.engine).collect::<Vec<_>>(),
        });
        print(&format!("{object:#}\n"))?;
    } else if !arguments.quiet {
        print(&table(&findings))?;
    }
    Ok(exit_code(&findings, !missing.is_empty()))
}

/// The properties that engines can be asked: those of a single probability. Others are passed over with a word.
fn properties(questions: &QuestionArguments, loaded: &LoadedModel) -> Result<Vec<Property>, CliError> {
    let asked = questions.read(loaded)?;
    let (mut properties, mut problems) = (vec![], vec![]);
    for question in &asked {
        match (&question.entry.inquiry, question.problem()) {
            (Ok(Inquiry::Probability(property)), _) => {
                properties.push(direct(property.clone(), &loaded.model, questions.nature()));
            }
            (Ok(Inquiry::Compound(compound)), _) => problems.push(format!(
                "{compound}: found more than one probability of F, G, U or X, which engines are not asked"
            )),
            (Err(_), problem) => problems.extend(problem),
        }
    }
    if properties.is_empty() {
        return Err(CliError::Input(problems.join("\nerror: ")));
    }
    problems.iter().for_each(|problem| warn(&format!("error: {problem}\n")));
    Ok(properties)
}

fn say(arguments: &CrosscheckArguments, lines: &[String], head: &str) {
    if !arguments.quiet {
        lines.iter().for_each(|line| warn(&format!("{head}{line}\n")));
    }
}

/// The engines to ask, and those that are not there.
#[derive(Default)]
struct Engines {
    found: Vec<Box<dyn Engine>>,
    missing: Vec<EngineMissing>,
}

/// Looks for the engines; an error if there is none at all.
fn find_engines(arguments: &CrosscheckArguments) -> Result<Engines, CliError> {
    let Engines { mut found, mut missing } = Engines::default();
    if arguments.with != With::Storm {
        match Prism::find(arguments.prism.as_deref()) {
            Ok(prism) => found.push(Box::new(prism)),
            Err(error) => missing.push(error),
        }
    }
    if arguments.with != With::Prism {
        match Storm::find(arguments.python.as_deref()) {
            Ok(storm) => found.push(Box::new(storm)),
            Err(error) => missing.push(error),
        }
    }
    // A path that was given is not passed over.
    let given = |engine| match engine {
        "PRISM" => arguments.prism.is_some(),
        _ => arguments.python.is_some(),
    };
    if found.is_empty() || missing.iter().any(|missing| given(missing.engine)) {
        let texts: Vec<_> = missing.iter().map(ToString::to_string).collect();
        return Err(CliError::Input(texts.join("\nerror: ")));
    }
    Ok(Engines { found, missing })
}

/// The `.tra` file of a model that PRISM can read as it is.
///
/// Those of a run have no lower bounds of 0, whatever its native model has.
fn explicit_files(path: &Path, has_zeros: bool) -> Option<PathBuf> {
    let (tra, native) = if path.is_dir() {
        (path.join("model.tra"), path.join(NATIVE_MODEL).exists())
    } else {
        (path.to_path_buf(), false)
    };
    let complete = ["tra", "sta", "lab"].iter().all(|extension| tra.with_extension(extension).exists());
    (complete && tra.extension().is_some_and(|extension| extension == "tra") && (native || !has_zeros))
        .then_some(tra)
}

fn agree(findings: &[Finding]) -> bool {
    findings.iter().all(|finding| finding.agreement == Agreement::Agrees)
}

fn exit_code(findings: &[Finding], missing: bool) -> ExitCode {
    if findings.iter().any(|finding| finding.agreement == Agreement::Disagrees) {
        ExitCode::from(1)
    } else if missing || !agree(findings) {
        ExitCode::from(3)
    } else {
        ExitCode::SUCCESS
    }
}
