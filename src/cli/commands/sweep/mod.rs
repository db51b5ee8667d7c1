//! `dynabs sweep`: one model with many settings, here or on the machines of a cluster.

pub(super) mod figures;
pub(super) mod job;
mod local;
pub(super) mod program;
mod slurm;
pub(super) mod spec;
pub(super) mod table;

use crate::{CliError, print, print_json, warn};
use clap::Args;
use job::{Job, Outcome, Purpose};
use spec::Sweep;
use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;
use table::Table;

/// What to vary, and where.
#[derive(Clone, Debug, Args)]
#[command(after_help = AFTER_HELP)]
pub struct SweepArguments {
    /// A JSON file with the model and its settings; with --collect nothing, the jobs are there.
    #[arg(required_unless_present = "collect")]
    spec: Option<PathBuf>,

    /// The directory of all jobs. Those that ended before are not run again.
    #[arg(short, long, value_name = "DIR")]
    output: PathBuf,

    /// Run so many jobs at a time; one per processor without.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,

    /// Write a script for an array of Slurm jobs instead of running them.
    #[arg(long, conflicts_with_all = ["jobs", "collect", "json", "wanted"])]
    slurm: bool,

    /// Only collect what jobs have left.
    #[arg(long, conflicts_with_all = ["spec", "jobs"])]
    collect: bool,

    /// Say, below the table, which setting with at least this lower bound has the fewest transitions; not with --json or --slurm.
    #[arg(long, value_name = "P", conflicts_with = "json", value_parser = probability)]
    wanted: Option<f64>,

    /// Print one JSON list instead of a table.
    #[arg(long)]
    json: bool,

    /// Print nothing but the table and errors.
    #[arg(short, long)]
    quiet: bool,
}

const AFTER_HELP: &str = "\
The spec has the model file and, for JSON pointers into it, lists of values, of which every combination is one job:
  {\"model\": \"my.json\", \"settings\": {\"/input/upper\": [[60], [40]], \"/noise/count\": [1600, 6400]}}
or a list of settings: \"settings\": [{\"/task/horizon\": 8}, {\"/task/horizon\": 16}]. All promises hold together, each with its
part of the confidence (settings that differ only in a plan that is followed and its U' need none); with \"together\": false each holds by itself, and none for the best of them.

Examples:
  dynabs sweep spec.json -o out/sweep
  dynabs sweep spec.json -o out/sweep --wanted 0.99
  dynabs sweep spec.json -o out/sweep --slurm && sbatch --time=1:00:00 out/sweep/sweep.sbatch
  dynabs sweep --collect -o out/sweep";

fn probability(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|p| (0.0..=1.0).contains(p));
    number.ok_or_else(|| "expected a number from 0 to 1".to_owned())
}

/// Runs the subcommand.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub fn run(arguments: &SweepArguments) -> Result<ExitCode, CliError> {
    let below = &arguments.output;
    let jobs = match &arguments.spec {
        None => Job::read_all(below)?,
        Some(path) => {
            let sweep = Sweep::read(path)?;
            fs::create_dir_all(below).map_err(|error| CliError::writing(below, &error))?;
            let jobs = Job::write_all(&sweep, below)?;
            if !sweep.together && jobs.len() > 1 && !arguments.quiet {
                warn("warning: every promise holds by itself, none of them for the best setting\n");
            }
            jobs
        }
    };
    if arguments.slurm {
        let script = slurm::write(&jobs, below)?;
        let text = format!("Wrote {} jobs. Hand them in:\n  sbatch {}\n", jobs.len(), script.display());
        print(&text)?;
        return Ok(ExitCode::SUCCESS);
    }
    if !arguments.collect {
        local::run(&jobs, arguments.jobs.map(usize::from), |job| {
            if !arguments.quiet {
                let how = if let Outcome::Done(_) = job.outcome(Purpose::Run) { "done" } else { "failed" };
                warn(&format!("{}: {how}\n", job.directory.display()));
            }
        })?;
    }
    let table = Table::collect(&jobs);
    table.write(below)?;
    if arguments.json {
        print_json(&table.to_json())?;
    } else {
        print(&table.to_markdown())?;
        if let Some(wanted) = arguments.wanted {
            print(&table.cheapest(wanted))?;
        }
    }
    Ok(if table.is_complete() { ExitCode::SUCCESS } else { ExitCode::from(3) })
}
