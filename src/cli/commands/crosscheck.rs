//! `dynabs-check crosscheck`: the same question to other people's solvers.

use crate::crosscheck_table::table;
use crate::limits::LimitArguments;
use crate::model_source::{LoadedModel, load, model_help};
use crate::questions::QuestionArguments;
use crate::{Bars, CliError, print, print_json, warn};
use clap::{Args, ValueEnum};
use dynabs::run::NATIVE_MODEL;
use imdp::engines::{
    Agreement, CrossCheckFile, CrossCheckOptions, Engine, EngineMissing, Finding, Handed, Prism, RunLimits,
    Storm, Subject, cross_check, raised,
};
use imdp::evaluation::direct;
use imdp::formats::Format;
use imdp::formats::prism::check_names;
use imdp::model::{available_memory, given_memory};
use imdp::property::Inquiry;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

/// What to ask, whom, and for how long.
#[derive(Clone, Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub struct CrosscheckArguments {
    #[arg(help = model_help())]
    path: PathBuf,

    /// The engine to ask.
    #[arg(long, value_enum, default_value_t = With::All)]
    with: With,

    /// Hand engines this very file instead of a copy in their format: PRISM reads .tra and .umb, Storm .drn and .umb.
    #[arg(long)]
    as_is: bool,

    #[command(flatten)]
    questions: QuestionArguments,

    /// PRISM's program. Default: $PRISM, or prism in PATH.
    #[arg(long, value_name = "PATH")]
    prism: Option<PathBuf>,

    /// A Python that can import stormpy. Default: $DYNABS_PYTHON, that of $VIRTUAL_ENV, or python3.
    #[arg(long, value_name = "PATH")]
    python: Option<PathBuf>,

    /// End an engine that takes longer than this many seconds for one property.
    #[arg(long, value_name = "SECONDS", default_value_t = 600.0, value_parser = crate::limits::seconds)]
    timeout: f64,

    /// Unbounded properties: how close our own bounds must be.
    #[arg(long, value_name = "E", default_value_t = 1e-10, value_parser = crate::limits::positive)]
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

/// Runs the subcommand.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub fn run(arguments: &CrosscheckArguments) -> Result<ExitCode, CliError> {
    let Engines { found, missing } = find_engines(arguments)?;
    let bars = Arc::new(Bars::new(arguments.quiet));
    let (loaded, (inquiries, digests)) = load(&arguments.path, false, &bars, |loaded| {
        Ok((inquiries(&arguments.questions, loaded)?, loaded.digests()?))
    })?;
    let failure = |error| CliError::Failure(format!("{}: {error}", arguments.path.display()));
    let raised = raised(&loaded.model).map_err(failure)?;
    // Files that only we read are written again for the engines.
    let readable = check_names(&loaded.model).is_ok() && !loaded.has_own_layout;
    let files = explicit_files(&arguments.path, raised.is_some()).filter(|_| readable);
    let handed = match (handed_as_is(arguments)?, &files) {
        (Some(format), _) => Handed::AsIs(&arguments.path, format),
        (None, Some(tra)) => Handed::Explicit(tra),
        (None, None) => Handed::Copy,
    };
    let subject = Subject { model: &loaded.model, raised: raised.as_ref(), handed };
    say(arguments, &loaded.warnings, "warning: ");
    say(arguments, &missing.iter().map(ToString::to_string).collect::<Vec<_>>(), "missing: ");

    bars.catch_interrupts();
    let available = || available_memory().map_or(4 << 30, |(bytes, _)| bytes / 4 * 3);
    let memory_mib = (given_memory().unwrap_or_else(available) >> 20).max(LEAST_MEMORY_MIB);
    let limits =
        RunLimits { timeout: Duration::from_secs_f64(arguments.timeout), memory_mib, progress: &*bars };
    let engines: Vec<&dyn Engine> = found.iter().map(|engine| &**engine).collect();
    let findings = LimitArguments::of_epsilon(arguments.epsilon).with_options(&bars, |solver| {
        cross_check(&subject, &inquiries, &engines, &CrossCheckOptions { solver: *solver, limits })
    })?;
    let code = exit_code(&findings, !missing.is_empty());
    if arguments.json {
        print_json(&CrossCheckFile {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            path: arguments.path.display().to_string(),
            model: digests,
            agree: missing.is_empty() && agree(&findings),
            findings,
            missing: missing.iter().map(|missing| missing.engine.to_owned()).collect(),
        })?;
    } else if !arguments.quiet {
        print(&table(&findings))?;
    }
    Ok(code)
}

/// The format of the file that engines are handed as it is, if they are.
fn handed_as_is(arguments: &CrosscheckArguments) -> Result<Option<Format>, CliError> {
    let path = &arguments.path;
    match Format::of_path(path) {
        _ if !arguments.as_is => Ok(None),
        Some(format) if path.is_file() => Ok(Some(format)),
        _ => Err(CliError::Input(format!(
            "--as-is: found {}; expected a file that an engine reads: .tra, .drn or .umb",
            path.display()
        ))),
    }
}

/// What engines can be asked. What cannot be read is passed over with a word.
fn inquiries(questions: &QuestionArguments, loaded: &LoadedModel) -> Result<Vec<Inquiry>, CliError> {
    let asked = questions.read(loaded)?;
    let (mut inquiries, mut problems) = (vec![], vec![]);
    for question in &asked {
        match (&question.entry.inquiry, question.problem()) {
            (Ok(Inquiry::Probability(property)), _) => {
                let property = direct(property.clone(), &loaded.model, questions.nature());
                inquiries.push(Inquiry::Probability(property));
            }
            (Ok(Inquiry::Compound(compound)), _) => inquiries.push(Inquiry::Compound(compound.clone())),
            (Err(_), problem) => problems.extend(problem),
        }
    }
    if inquiries.is_empty() {
        return Err(CliError::Input(problems.join("\nerror: ")));
    }
    problems.iter().for_each(|problem| warn(&format!("error: {problem}\n")));
    Ok(inquiries)
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
        let option = |engine| if engine == "PRISM" { "--prism" } else { "--python" };
        let text =
            |missing: &EngineMissing| format!("{missing}\n  Name it by {} PATH.", option(missing.engine));
        let texts: Vec<_> = missing.iter().map(text).collect();
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
