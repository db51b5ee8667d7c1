//! `dynabs-check report`: a run as one page.

use crate::extensions::require_extension;
use crate::input_run_source::SolvedInputs;
use crate::run_source::{Controlled, Refined};
use crate::{Bars, CliError, print, warn};
use clap::Args;
use dynabs::controller::Controller;
use dynabs::report::{
    CrossCheckError, InputMaterial, Material, MaterialOptions, Picture, ReportError, ViewChoice, ViewError,
    input_page, input_pictures, page, pictures, read_cross_checks,
};
use dynabs::run::Manifest;
use imdp::files::Outputs;
use imdp::progress::Progress;
use imdp::solver::SolverOptions;
use std::fs;
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Instant;

/// What to report, and where.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct ReportArguments {
    /// A directory written by dynabs-compile; a crosscheck.json in it (what crosscheck --json prints) is shown as well.
    directory: PathBuf,

    /// The page to write.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,

    /// Write every plot to this directory as well, as SVG.
    #[arg(long, value_name = "DIR")]
    svg: Option<PathBuf>,

    /// The number of simulated runs.
    #[arg(long, value_name = "N", default_value_t = 10_000, value_parser = clap::value_parser!(u64).range(..=1_000_000_000))]
    runs: u64,

    /// How many of them are drawn.
    #[arg(long, value_name = "N", default_value_t = 30, value_parser = clap::value_parser!(u64).range(..=1000))]
    keep: u64,

    /// The seed of the simulation.
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,

    /// What is across in the first view, and in the files of --svg: a coordinate by name or number, or time. Without it, and
    /// for the other axis, what the regions of the task depend on.
    #[arg(long, value_name = "COORDINATE")]
    across: Option<String>,

    /// What is up.
    #[arg(long, value_name = "COORDINATE")]
    up: Option<String>,

    /// Where the plane lies in other coordinates, such as x3=0.5,x4=-1; otherwise it goes through the start.
    #[arg(long, value_name = "NAME=VALUE", value_delimiter = ',', allow_hyphen_values = true)]
    at: Vec<String>,

    /// Leave out how long things took: the same bytes every time.
    #[arg(long)]
    no_times: bool,

    /// Print nothing but errors.
    #[arg(short, long)]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  dynabs report out/mine -o mine.html
  dynabs report out/mine -o mine.html --across x1 --up x2 --at x3=0.5";

impl From<CrossCheckError> for CliError {
    fn from(error: CrossCheckError) -> Self {
        match error {
            CrossCheckError::Io { ref error, ref path } => Self::reading(path, error),
            _ => Self::Input(error.to_string()),
        }
    }
}

impl From<ViewError> for CliError {
    fn from(error: ViewError) -> Self {
        // The parts of a choice are options here.
        Self::Input(format!("--{error}"))
    }
}

/// The plane that was chosen.
fn view(arguments: &ReportArguments) -> Result<ViewChoice, CliError> {
    let at = |text: &String| {
        let parts = text.split_once('=').and_then(|(name, value)| Some((name, value.trim().parse().ok()?)));
        parts.map(|(name, value)| (name.trim().to_owned(), value)).ok_or_else(|| {
            CliError::Input(format!(
                "--at: found {text:?}; expected a coordinate and a number, such as x3=0.5"
            ))
        })
    };
    Ok(ViewChoice {
        across: arguments.across.clone(),
        up: arguments.up.clone(),
        at: arguments.at.iter().map(at).collect::<Result<_, _>>()?,
    })
}

/// Runs the subcommand.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub fn run(arguments: &ReportArguments) -> Result<ExitCode, CliError> {
    let bars = Arc::new(Bars::new(arguments.quiet));
    let start = Instant::now();
    let view = view(arguments)?;
    require_extension("--output", &arguments.output, &["html", "htm"])?;
    let run = Controlled::open(&arguments.directory, &bars)?;
    run.require_text("the page", "Use fewer /partition/cells.")?;
    let (page, pictures) = match run {
        Controlled::Inputs(solved, controller) => {
            of_inputs((arguments, &view), &solved, &controller, start, &bars)?
        }
        Controlled::Targets(refined) => {
            let Refined { run, answer, controller } = &*refined;
            let options = options(arguments, &run.manifest, start)?;
            let material = Material::new(run, answer, controller, options, &*bars).seen(&view)?;
            (page(&material), pictures(&material))
        }
    };
    if bars.is_interrupted() {
        return Err(CliError::Interrupted);
    }
    let page = page.map_err(|error| CliError::Failure(error.to_string()))?;
    let mut texts = vec![(arguments.output.clone(), page)];
    if let Some(directory) = &arguments.svg {
        fs::create_dir_all(directory).map_err(|error| CliError::writing(directory, &error))?;
        let path = |name: &str| directory.join(format!("{name}.svg"));
        texts.extend(pictures.into_iter().map(|picture| (path(&picture.name), picture.svg)));
    }
    let mut files = Outputs::default();
    for (path, text) in &texts {
        let written = files.write(path, |out| out.write_all(text.as_bytes()));
        written.map_err(|error| CliError::writing(path, &error))?;
    }
    files.commit().map_err(|error| CliError::writing(&arguments.output, &error))?;
    if !arguments.quiet {
        let lines = texts.iter().map(|(path, _)| format!("wrote {}\n", path.display()));
        print(&lines.collect::<String>())?;
    }
    Ok(ExitCode::SUCCESS)
}

/// A page and its plots.
type Reported = (Result<String, ReportError>, Vec<Picture>);

/// A run whose actions are inputs.
fn of_inputs(
    (arguments, view): (&ReportArguments, &ViewChoice),
    SolvedInputs { run, solution }: &SolvedInputs,
    controller: &Controller,
    start: Instant,
    bars: &Bars,
) -> Result<Reported, CliError> {
    let solver = SolverOptions { progress: bars, ..SolverOptions::default() };
    let solution = run.by_step(solution, &solver);
    let options = options(arguments, &run.manifest, start)?;
    let material = InputMaterial::new(run, &solution, controller, options, bars).seen(view)?;
    Ok((input_page(&material), input_pictures(&material)))
}

/// What to simulate and to show besides.
fn options(
    arguments: &ReportArguments,
    manifest: &Manifest,
    start: Instant,
) -> Result<MaterialOptions, CliError> {
    let times = if arguments.no_times { vec![] } else { vec![("opening and solving", start.elapsed())] };
    let cross_checks = match read_cross_checks(&arguments.directory, manifest) {
        Err(error @ CrossCheckError::OtherModel { .. }) => {
            warn(&format!("warning: {error}\n"));
            None
        }
        read => read?,
    };
    Ok(MaterialOptions {
        seed: arguments.seed,
        runs: arguments.runs,
        drawn: arguments.keep,
        times,
        cross_checks,
    })
}
