//! `dynabs-check simulate`: the closed loop against its promise.

use crate::exports::replace;
use crate::extensions::require_extension;
use crate::run_source::Controlled;
use crate::simulation_noise::{ChosenNoise, NoiseArguments, SaidOfNoise, noise};
use crate::simulation_report::{Report, Simulated};
use crate::simulation_start::{probability, start};
use crate::trajectories::write_trajectories;
use crate::{Bars, CliError, print, print_json};
use clap::Args;
use dynabs::controller::{ParameterChoice, Simulation};
use imdp::progress::Progress;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Instant;

/// What to simulate.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct SimulateArguments {
    /// A directory written by dynabs-compile.
    directory: PathBuf,

    /// The number of runs.
    #[arg(long, value_name = "N", default_value_t = 100_000, value_parser = clap::value_parser!(u64).range(1..=1_000_000_000))]
    runs: u64,

    /// Where runs start, as --from=-20,0; the default is the model's initial state.
    #[arg(long, value_name = "X1,X2,...", allow_hyphen_values = true)]
    from: Option<String>,

    #[command(flatten)]
    noise: NoiseArguments,

    /// The seed: every run has a random stream of its own.
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,

    /// The confidence of the Clopper-Pearson interval.
    #[arg(long, value_name = "P", default_value_t = 0.99, value_parser = probability)]
    confidence: f64,

    /// Give runs of unbounded tasks up after this many (grouped) steps.
    #[arg(long, value_name = "N", default_value_t = 10_000)]
    most_steps: u64,

    /// How parameters are picked at every step, where actions are inputs.
    #[arg(long, value_name = "HOW", value_enum, default_value_t)]
    parameters: Parameters,

    /// Write trajectories to this CSV file.
    #[arg(long, value_name = "FILE")]
    trajectories: Option<PathBuf>,

    /// How many trajectories to write: those of the first runs.
    #[arg(long, value_name = "N", default_value_t = 100, requires = "trajectories")]
    keep: u64,

    /// Print one JSON object instead of the summary.
    #[arg(long)]
    json: bool,

    /// Print nothing but errors and warnings (and the object of --json).
    #[arg(short, long)]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  dynabs simulate out/mine --runs 10000
  dynabs simulate out/mine --from=-20,0 --trajectories paths.csv --keep 30";

/// How parameters are picked at every step.
#[derive(Clone, Copy, Debug, Default, clap::ValueEnum)]
enum Parameters {
    /// Uniformly from their intervals.
    #[default]
    Random,
    /// Either end of each interval, by chance.
    Corners,
    /// The ends that lead to the least bound.
    Adversarial,
}

impl From<Parameters> for ParameterChoice {
    fn from(parameters: Parameters) -> Self {
        match parameters {
            Parameters::Random => Self::Random,
            Parameters::Corners => Self::Corners,
            Parameters::Adversarial => Self::Adversarial,
        }
    }
}

/// Runs the subcommand: exit code 0 if nothing is wrong, 1 if the simulation contradicts the promise, 3 if it was
/// interrupted, 4 if an input left `U`.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub fn run(arguments: &SimulateArguments) -> Result<ExitCode, CliError> {
    if let Some(path) = &arguments.trajectories {
        require_extension("--trajectories", path, &["csv"])?;
    }
    let bars = Arc::new(Bars::new(arguments.quiet));
    let run = Controlled::open(&arguments.directory, &bars)?;
    let controller = run.controller();
    let start = start(arguments.from.as_deref(), run.grid(), run.initial_state())?;
    let (simulation, noise) = match &run {
        Controlled::Targets(refined) => {
            let ChosenNoise { noise, said } = noise(&arguments.noise, &refined.run)?;
            let problem = &refined.run.problem;
            (Simulation::new(problem, controller, noise, arguments.most_steps), said)
        }
        Controlled::Inputs(solved, _) => {
            let (problem, parameters) = (&solved.run.problem, arguments.parameters.into());
            if arguments.noise.is_given() {
                return Err(CliError::Input(
                    "--noise: found a run whose actions are inputs; expected no choice of noise, for its own is drawn".into(),
                ));
            }
            let name = match problem.noise().samples() {
                Some(_) => "the model's samples, drawn with replacement",
                None => "the model's distributions",
            };
            let said = SaidOfNoise { name: name.to_owned(), notes: vec![] };
            (Simulation::of_inputs(problem, controller, parameters, arguments.most_steps), said)
        }
    };
    let clock = Instant::now();
    let tally = simulation.tally(&start, arguments.seed, arguments.runs, &*bars);
    let seconds = clock.elapsed().as_secs_f64();
    if bars.is_interrupted() {
        return Err(CliError::Interrupted);
    }
    if let Some(path) = &arguments.trajectories {
        let kept = arguments.keep.min(arguments.runs);
        let runs = (&start[..], arguments.seed, kept);
        let sizes = (controller.state_dimension(), controller.step_inputs());
        replace(path, |out| write_trajectories(&simulation, runs, sizes, out))?;
    }
    let SimulateArguments { seed, confidence, .. } = *arguments;
    let simulated = Simulated { from: start, seed, confidence, tally, seconds };
    let report = Report::new(run.name(), controller, noise, simulated);
    if arguments.json {
        print_json(&report)?;
    } else if !arguments.quiet {
        print(&report.text())?;
    }
    report.warn();
    report.outcome()
}
