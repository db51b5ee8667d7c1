//! `dynabs-check validate`: the closed loop with samples that nothing else used.

use crate::other_samples::OtherSamplesArguments;
use crate::run_source::{Refined, refine};
use crate::simulation_start::start;
use crate::{Bars, CliError, print, print_json, thousands};
use clap::Args;
use dynabs::controller::{Noise, Simulation, samples_per_run};
use dynabs::guarantee::lower_bound_text;
use dynabs::noise::{DecimalMark, NoiseSamples, overlap, parse_csv};
use dynabs::problem::{Problem, SampleKind, StepNoise};
use dynabs::statistics::lower_bound;
use dynabs::task::Safety;
use imdp::files;
use imdp::numeric::{Rational, from_decimal, to_f64};
use num_traits::One;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

/// So many samples more than expected may be among those of the model before they do not count as fresh.
const COINCIDENCES: f64 = 0.01;

/// What to validate, with which samples.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct ValidateArguments {
    /// A directory written by dynabs-compile.
    directory: PathBuf,

    /// A CSV file of samples that neither the model nor any decision about it has seen.
    #[arg(long, value_name = "FILE")]
    samples: PathBuf,

    #[command(flatten)]
    other_samples: OtherSamplesArguments,

    /// Where runs start, as --from=-20,0; the default is the model's initial state.
    #[arg(long, value_name = "X1,X2,...", allow_hyphen_values = true)]
    from: Option<String>,

    /// The confidence of the statement.
    #[arg(long, value_name = "P", default_value_t = 0.99, value_parser = crate::simulation_start::probability)]
    confidence: f64,

    /// Print one JSON object.
    #[arg(long)]
    json: bool,

    /// Print no progress.
    #[arg(short, long)]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  dynabs validate out/mine --samples fresh.csv";

/// What fresh samples showed.
#[derive(Clone, Debug, Serialize)]
struct Validation {
    name: String,
    from: Vec<f64>,
    samples: u64,
    samples_per_run: u64,
    runs: u64,
    satisfied: u64,
    safety: Safety,
    /// What these runs prove, with `confidence`.
    bound: f64,
    confidence: f64,
    /// What the abstraction promises, with its own confidence; none in reference mode, which promises nothing.
    promised: f64,
    promise_confidence: Option<f64>,
}

/// Runs the subcommand.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub fn run(arguments: &ValidateArguments) -> Result<ExitCode, CliError> {
    let bars = Arc::new(Bars::new(arguments.quiet));
    let Refined { run, controller, .. } = refine(&arguments.directory, &bars)?;
    let problem = &run.problem;
    let start = start(arguments.from.as_deref(), problem.grid(), problem.initial_state())?;
    let (of, decimal) = (arguments.other_samples.of(), arguments.other_samples.decimal_mark(&run.document));
    let samples = fresh(&arguments.samples, decimal, problem, of)?;
    let per_run = samples_per_run(problem, of).ok_or_else(|| {
        CliError::Input(
            "validate: found a task without a horizon; expected one with, since a run may use any number of samples".into(),
        )
    })?;
    if (samples.len() as u64) < per_run {
        return Err(CliError::Input(format!(
            "{}: found {} samples; expected at least the {per_run} of one run",
            arguments.samples.display(),
            samples.len()
        )));
    }
    let safety = controller.guarantee().event.safety;
    if of == SampleKind::Grouped && safety == Safety::EveryStep && problem.group_steps() > 1 {
        return Err(CliError::Input(
            "--samples-of grouped: found a promise about every step; expected samples of one step, for others say nothing \
             of the steps in between"
                .into(),
        ));
    }
    let simulation = Simulation::new(problem, &controller, Noise::of_plant(problem.noise()), 0);
    let tally = simulation.replay(&start, &samples, of, per_run);
    let satisfied = match safety {
        Safety::EveryStep => tally.satisfied,
        Safety::GroupedInstants => tally.satisfied_at_instants,
    };
    let level = from_decimal(arguments.confidence).map_or(0.01, |p| to_f64(&(Rational::one() - p)));
    let validation = Validation {
        name: problem.name().to_owned(),
        samples: samples.len() as u64,
        samples_per_run: per_run,
        runs: tally.runs,
        satisfied,
        safety,
        bound: lower_bound(satisfied, tally.runs, level),
        confidence: arguments.confidence,
        promised: controller.bound_at(&start),
        promise_confidence: controller.guarantee().confidence(),
        from: start,
    };
    match arguments.json {
        true => print_json(&validation)?,
        false => print(&validation.text())?,
    }
    Ok(ExitCode::SUCCESS)
}

/// The samples of a file, if the model has not used them.
fn fresh(
    path: &Path,
    decimal: DecimalMark,
    problem: &Problem,
    of: SampleKind,
) -> Result<NoiseSamples, CliError> {
    let shown = path.display();
    let text = files::read_text(path).map_err(|error| CliError::reading(path, &error))?;
    let samples = parse_csv(&text, problem.grid().dimension(), decimal)
        .map_err(|error| CliError::Input(format!("{shown}: {error}")))?;
    let Some(own) = problem.noise().samples() else { return Ok(samples) };
    let used = match (&own.of_one_step, of) {
        (StepNoise::Samples(used), SampleKind::Step) => used,
        (StepNoise::Gaussian(_), SampleKind::Step) => return Ok(samples),
        _ => &own.samples,
    };
    let (common, expected) = overlap(&samples, used);
    if common as f64 > expected + COINCIDENCES * samples.len() as f64 {
        return Err(CliError::Input(format!(
            "{shown}: found {common} of {} samples among those that the model was made of; expected samples that it has not seen\n  \
             Measure new ones: what was used once proves nothing a second time.",
            samples.len()
        )));
    }
    Ok(samples)
}

impl Validation {
    fn text(&self) -> String {
        let when = match self.safety {
            Safety::EveryStep => "at every step",
            Safety::GroupedInstants => "at grouped instants",
        };
        let (proven, percent) = (lower_bound_text(self.bound), 100.0 * self.confidence);
        let mut text = format!(
            "{}: {} of {} runs succeed {when}, from {:?}, each with {} samples of its own\n  \
             fresh samples: at least {proven}, with confidence {percent} %\n",
            self.name,
            thousands(self.satisfied),
            thousands(self.runs),
            self.from,
            self.samples_per_run,
        );
        let promised = lower_bound_text(self.promised);
        match self.promise_confidence {
            Some(confidence) => {
                text += &format!(
                    "  abstraction:   at least {promised}, with confidence {} %\n",
                    100.0 * confidence
                );
            }
            None => text += "  abstraction:   reference mode, which promises nothing\n",
        }
        let is_better = self.promise_confidence.is_none() || self.bound > self.promised;
        text += match is_better {
            true => {
                "  better: the fresh samples. It holds for this start and this controller, if neither was chosen after a look at them\n"
            }
            false => "  better: the abstraction\n",
        };
        text
    }
}
