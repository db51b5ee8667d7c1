//! `dynabs-compile`: from a model file to PRISM files.

use super::compile_inputs;
use super::explain::{HINT, is_low, is_soon_explained};
use super::init::write_starter;
use super::search::{Request, search};
use crate::choices::format_names;
use crate::limits::LimitArguments;
use crate::model_text::{configured, read_model};
use crate::phases::{FILES, Phase};
use crate::progress::SOLVING;
use crate::pruning::pruned;
use crate::resources::{Resources, times};
use crate::results::{PropertyResult, exit_code, table};
use crate::schemas::SchemaName;
use crate::summary::{memory, memory_json, property, summary};
use crate::together::require_one;
use crate::unasked::Unasked;
use crate::{Bars, CliError, EncodingName, print, warn};
use clap::{Args, Parser};
use dynabs::abstraction::{Abstraction, Footprint, compile};
use dynabs::controller::Controller;
use dynabs::explain::explain;
use dynabs::model_file::StatedProblem;
use dynabs::problem::Problem;
use dynabs::run::{Manifest, PruningReport, Staging, WriteOptions, solution_options, write_run};
use imdp::formats::Format;
use imdp::ranks;
use imdp::solver::Answer;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Compile a noisy linear control system into an interval MDP with guaranteed probabilities, for PRISM.
#[derive(Clone, Debug, Parser)]
#[command(name = "dynabs-compile", version)]
pub struct CompileTool {
    #[command(flatten)]
    arguments: CompileArguments,

    #[command(flatten)]
    resources: Resources,
}

/// What to compile, and what to make of it.
#[derive(Clone, Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub struct CompileArguments {
    /// The model file (JSON).
    #[arg(required_unless_present_any = ["init", "schema", "search"])]
    model: Option<PathBuf>,

    /// Write the model to this directory, which is created; with --search all that is tried and found.
    #[arg(short, long, value_name = "DIR", required_unless_present_any = ["dry_run", "init", "schema"])]
    output: Option<PathBuf>,

    /// Replace a value of the model file; VALUE is JSON, or else a string. Repeatable.
    #[arg(long = "set", value_name = "/json/pointer=VALUE")]
    set: Vec<String>,

    /// Draw Gaussian noise with this seed instead of the model's.
    #[arg(long, value_name = "N")]
    seed: Option<u64>,

    /// Write the model in these formats as well; model.dynabs is always written. Without it, PRISM's files if they are
    /// smaller than 100 MB.
    #[arg(long, value_name = "FORMAT", value_parser = format_names(Format::ALL.into_iter()), value_delimiter = ',')]
    format: Vec<Format>,

    /// How choices are written in these formats: as they are (model.*), with one state per row (rows.*), or, for actions
    /// "inputs", without the states of the lattice (model.*, looser).
    #[arg(long, value_name = "ENCODING", value_enum, default_value_t)]
    encoding: EncodingName,

    /// Leave out the explicit files model.tra, model.sta and model.lab: the same as --format dynabs. For actions "inputs",
    /// which need no file to be solved, leave out the model altogether.
    #[arg(long, conflicts_with = "format")]
    no_tra: bool,

    /// Solve the task natively as well.
    #[arg(long)]
    solve: bool,

    /// Solve the task and keep only the actions that an optimal policy takes: a small model with the same value of
    /// this one property. Implies --solve.
    #[arg(long)]
    prune: bool,

    /// Do everything but write files.
    #[arg(long)]
    dry_run: bool,

    /// Replace the output of an earlier run.
    #[arg(long)]
    force: bool,

    /// Print one JSON object, the manifest with times, instead of the summary.
    #[arg(long)]
    json: bool,

    /// Print nothing but errors (and the object of --json).
    #[arg(short, long)]
    quiet: bool,

    /// Print how the confidence is spent, the gain, all digits, and how long each phase took, too.
    #[arg(short, long, conflicts_with_all = ["quiet", "json"])]
    verbose: bool,

    /// Write a starter model to FILE.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["model", "output", "schema"])]
    init: Option<PathBuf>,

    /// Print the JSON Schema of the model file, or of another file or output.
    #[arg(long, value_name = "FILE", value_enum, num_args = 0..=1, default_missing_value = "problem",
        conflicts_with_all = ["model", "output"])]
    schema: Option<SchemaName>,

    /// Look for the cheapest setting of the model with a wanted bound, among those in this file (JSON). What has been tried is not
    /// tried again.
    #[arg(long, value_name = "SPEC", requires = "output",
        conflicts_with_all = ["init", "schema", "set", "seed", "format", "encoding", "no_tra", "solve", "prune", "dry_run", "force"])]
    search: Option<PathBuf>,
}

const AFTER_HELP: &str = "\
Exit codes: 0 done, 2 bad input or usage, 3 interrupted, 4 I/O, memory or internal error;
with --solve, --prune or --search also 1 the threshold is missed, 3 undecided (limit, interrupt, bounds straddle the threshold).

Examples:
  dynabs-compile --init my-model.json
  dynabs-compile models/double_integrator.json -o out
  dynabs-compile models/double_integrator.json --dry-run --set /input/lower=[-40] --set /input/upper=[40]
  dynabs-compile models/double_integrator.json -o out --format umb,drn
  dynabs-compile models/double_integrator.json -o out --encoding rows
  dynabs-compile --search examples/search/room.json -o found
  prism -importmodel out/model.tra,sta,lab -ex out/model.props";

/// Runs the tool.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub fn run(tool: &CompileTool) -> Result<ExitCode, CliError> {
    tool.resources.apply()?;
    compile_or_init(&tool.arguments, None)
}

/// Compiles a model, looks for the best of several, or writes one to start from; `subcommand` is the name of this among the commands
/// of the program, if it has others.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub(super) fn compile_or_init(
    arguments: &CompileArguments,
    subcommand: Option<&'static str>,
) -> Result<ExitCode, CliError> {
    if let Some(of) = arguments.schema {
        require_one("--schema")?;
        print(&of.text()?)?;
    } else if let (Some(spec), Some(output)) = (&arguments.search, &arguments.output) {
        require_one("--search")?;
        let (json, quiet) = (arguments.json, arguments.quiet);
        return search(&Request { model: arguments.model.as_deref(), spec, output, subcommand, json, quiet });
    } else if let Some(file) = &arguments.init {
        require_one("--init")?;
        write_starter(file, arguments.quiet)?;
    } else if let Some(model) = &arguments.model {
        return compile_model(arguments, model);
    }
    Ok(ExitCode::SUCCESS)
}

fn compile_model(arguments: &CompileArguments, path: &Path) -> Result<ExitCode, CliError> {
    let start = Instant::now();
    let bars = Arc::new(Bars::new(arguments.quiet));
    if let Some(output) = arguments.output.as_deref().filter(|_| !arguments.dry_run) {
        // Before any work: a place that is taken will still be taken afterwards.
        Staging::check(output, arguments.force)?;
    }
    let source = read_model(path)?;
    let (document, mut notes) = configured(path, &source, &arguments.set, arguments.seed)?;
    let hint = document.looks_continuous().map(|hint| hint.to_string());
    let with_hint = |error: CliError| match (error, &hint) {
        (CliError::Input(text), Some(hint)) => CliError::Input(format!("{text}\n  {hint}.")),
        (error, _) => error,
    };
    let stated = document.stated().map_err(|error| with_hint(error.into()))?;
    notes.extend(hint.clone());
    let problem = match stated {
        StatedProblem::Targets(problem) => *problem,
        StatedProblem::Inputs(problem) => {
            ranks::require_same(&(arguments, &problem));
            let output = arguments.output.as_deref().filter(|_| !arguments.dry_run);
            let wanted = compile_inputs::Wanted {
                output: output.map(|output| (output, write_options(arguments))),
                unasked: arguments.wants_unasked(),
                encoding: arguments.encoding.into(),
                set: &arguments.set,
                solve: arguments.solve || arguments.prune,
                prune: arguments.prune,
                json: arguments.json,
                quiet: arguments.quiet,
                verbose: arguments.verbose,
                dry_run: arguments.dry_run,
            };
            let sources = (&document, source.as_str());
            return compile_inputs::compile_inputs(sources, &problem, &wanted, notes, start, &bars);
        }
    };
    if arguments.encoding == EncodingName::Flat {
        return Err(CliError::Input(
            "--encoding flat: found a problem whose actions are \"targets\"; expected actions \"inputs\"\n  Here --encoding \
             plain is flat already: every choice has one interval for each cell."
                .to_owned(),
        ));
    }
    ranks::require_same(&(arguments, &problem));
    let mut phases = vec![("model file", start.elapsed())];
    bars.expect(arguments.phases());

    let mut abstraction = compile(&problem, &*bars)
        .map_err(|error| with_hint(CliError::of_abstraction(&error, &document.name)))?;
    phases.extend(&abstraction.phases);
    // Until here there is nothing to clean up, and nothing to print.
    bars.catch_interrupts();
    if !arguments.prune {
        abstraction = abstraction.with_costs(&problem)?;
    } else if !problem.costs().is_empty() {
        warn(compile_inputs::COSTS_LEFT_OUT);
    }
    let mut results = Vec::new();
    let mut pruning = None;
    let mut solution = None;
    let mut explanation = None;
    let mut controller_bytes = None;
    if arguments.prune {
        let solving = Instant::now();
        let (result, report) = prune(&mut abstraction, &bars)?;
        results.push(result);
        notes.push(format!("{}; {}", report.kept, report.scope));
        pruning = Some(report);
        phases.push(("pruning", solving.elapsed()));
    }
    if arguments.solve && !arguments.prune {
        let solving = Instant::now();
        let (answer, result) = solve(&problem, &abstraction, &bars)?;
        if arguments.json {
            controller_bytes = Controller::new(&problem, &abstraction, &answer)?.table_bytes().ok();
        }
        if is_low(&answer) && !is_soon_explained(&abstraction) {
            notes.push(HINT.to_owned());
        } else if is_low(&answer) && !arguments.quiet && !arguments.json {
            let controller = Controller::new(&problem, &abstraction, &answer)?;
            explanation = Some(explain(&problem, &abstraction, &answer, &controller, &*bars));
        }
        results.push(result);
        solution = Some(answer.solution);
        phases.push(("solving", solving.elapsed()));
    }
    let mut left_out = None;
    let mut manifest = Manifest::new(&document, &source, &problem, &abstraction);
    manifest.set.clone_from(&arguments.set);
    manifest.warnings.append(&mut notes);
    manifest.pruning = pruning;

    if let Some(output) = arguments.output.as_deref().filter(|_| !arguments.dry_run) {
        if !ranks::dismiss() {
            return Ok(ExitCode::SUCCESS);
        }
        let writing = Instant::now();
        let mut options = WriteOptions { solution: solution.as_ref(), ..write_options(arguments) };
        if arguments.wants_unasked() {
            let unasked = Unasked::of(&abstraction.model)?;
            (options.formats, left_out) = (unasked.formats, unasked.left_out);
        }
        manifest = write_run(output, &document, &problem, &abstraction, manifest, options, &*bars)?;
        phases.push(("files", writing.elapsed()));
    }
    for result in &mut results {
        let claim = abstraction.guarantee.claim(&abstraction.property, &abstraction.model, result.bounds());
        result.guarantee = Some(claim.map_err(|error| CliError::Failure(error.to_string()))?);
    }
    let text = Texts {
        footprint: &abstraction.footprint,
        left_out: left_out.unwrap_or_default(),
        explanation: explanation.map_or(String::new(), |explanation| explanation.to_string()),
        controller_bytes,
    };
    report(arguments, &manifest, &text, &phases, &results)?;
    Ok(exit_code(&results))
}

/// Solves the task, with what controllers and reports need later.
fn solve(
    problem: &Problem,
    abstraction: &Abstraction,
    bars: &Bars,
) -> Result<(Answer, PropertyResult), CliError> {
    let start = Instant::now();
    let (model, property) = (&abstraction.model, &abstraction.property);
    let answer = LimitArguments::default()
        .with_options(bars, |options| Answer::new(model, property, &solution_options(problem, options)));
    let answer = answer.map_err(|error| CliError::Input(format!("{property}: {error}")))?;
    let result = PropertyResult::new(property, &answer, model, start.elapsed());
    Ok((answer, result))
}

impl CompileArguments {
    /// The phases that people may have to wait for, and what part of the time they take as a rule.
    fn phases(&self) -> Vec<Phase> {
        let solved = [(SOLVING, 2.0)].into_iter().filter(|_| self.solve || self.prune);
        let written = [(FILES, 2.0)].into_iter().filter(|_| !self.dry_run);
        [("enabled actions", 1.0), ("rows", 3.0)].into_iter().chain(solved).chain(written).collect()
    }

    /// Whether formats were not chosen, so that it hangs on the size of the model which it is written in.
    fn wants_unasked(&self) -> bool {
        self.format.is_empty() && !self.no_tra && self.encoding != EncodingName::Rows
    }
}

fn write_options<'a>(arguments: &CompileArguments) -> WriteOptions<'a> {
    WriteOptions {
        // Row states are few, whatever the model; for others, that is decided when their number is known.
        formats: match (arguments.no_tra, arguments.format.as_slice(), arguments.encoding) {
            (false, [], EncodingName::Rows) => vec![Format::Prism],
            _ => arguments.format.clone(),
        },
        encoding: arguments.encoding.into(),
        force: arguments.force,
        solution: None,
    }
}

/// Replaces the model by what an optimal policy needs of it.
fn prune(abstraction: &mut Abstraction, bars: &Bars) -> Result<(PropertyResult, PruningReport), CliError> {
    pruned(&mut abstraction.model, &abstraction.property, bars)
}

/// What a summary says beside the manifest.
struct Texts<'a> {
    footprint: &'a Footprint,
    left_out: String,
    explanation: String,
    controller_bytes: Option<u64>,
}

fn report(
    arguments: &CompileArguments,
    manifest: &Manifest,
    Texts { footprint, left_out, explanation, controller_bytes }: &Texts<'_>,
    phases: &[(&str, Duration)],
    results: &[PropertyResult],
) -> Result<(), CliError> {
    if !arguments.quiet {
        let mut text = String::new();
        for warning in &manifest.warnings {
            text += &format!("warning: {warning}\n");
        }
        if arguments.verbose {
            text += &times(phases);
        }
        warn(&text);
    }
    if arguments.json {
        let seconds: serde_json::Map<String, Value> =
            phases.iter().map(|(name, time)| ((*name).to_owned(), time.as_secs_f64().into())).collect();
        let mut object = serde_json::to_value(manifest)
            .map_err(|error| CliError::Failure(format!("the manifest has no JSON form: {error}")))?;
        if let Value::Object(object) = &mut object {
            object.insert("seconds".to_owned(), Value::Object(seconds));
            if arguments.dry_run {
                object.insert("memory".to_owned(), memory_json(footprint));
            }
            if let Some(bytes) = controller_bytes {
                object.insert("controller_bytes".to_owned(), (*bytes).into());
            }
            if !results.is_empty() {
                object.insert("results".to_owned(), json!(results));
            }
        }
        print(&format!("{object:#}\n"))
    } else if arguments.quiet {
        Ok(())
    } else {
        let directory = arguments.output.as_ref().filter(|_| !arguments.dry_run);
        let directory = directory.map(|path| path.display().to_string());
        let mut text = summary(manifest, directory.as_deref(), arguments.verbose) + left_out;
        if arguments.dry_run {
            text += &memory(footprint);
        }
        if results.is_empty() {
            text += &property(&manifest.property);
        }
        print(&(text + explanation + &table(results, arguments.verbose)))
    }
}
