//! Runs of problems whose actions are inputs: written, and opened again.

use super::RunFiles;
use super::appearance::{NATIVE_MODEL, PROBLEM};
use super::error::OpenError;
use super::manifest::{GroupedHorizon, InputFile, Manifest};
use super::open::problem_document;
use super::staging::{RunDirectoryError, Staging};
use super::write::WriteOptions;
use crate::abstraction::inputs::InputAbstraction;
use crate::guarantee::{Event, Evidence, Guarantee};
use crate::landing::{LandingModel, LandingSolution};
use crate::model_file::{Document, StatedProblem};
use crate::problem::{InputProblem, Objective};
use imdp::formats::umb::Compression;
use imdp::formats::{Format, ModelWriter, native, sha256_hex};
use imdp::progress::Progress;
use imdp::property::{Probability, Resolution};
use imdp::solver::SolverOptions;
use serde_json::Value;
use std::io::Write;
use std::path::{Path, PathBuf};

/// A directory written by `dynabs-compile` for a problem whose actions are inputs.
///
/// The abstraction is made again: that takes no longer than to read one.
#[derive(Clone, Debug)]
pub struct InputRun {
    /// The directory.
    pub directory: PathBuf,
    /// What the run was.
    pub manifest: Manifest,
    /// The problem.
    pub problem: InputProblem,
    /// Its abstraction.
    pub abstraction: InputAbstraction,
}

impl InputRun {
    /// Whether a directory has such a run; nothing is checked yet.
    pub fn is_in(directory: &Path) -> bool {
        let manifest = RunFiles::find(directory).ok().flatten().and_then(|files| files.manifest().ok());
        manifest.is_some_and(|manifest| manifest.micro_steps.is_some())
    }

    /// Opens a directory: nothing in it is believed before its hash is that of the manifest.
    ///
    /// # Errors
    /// [`OpenError`] if something is missing, changed, or made by an incompatible version.
    pub fn open(directory: &Path) -> Result<Self, OpenError> {
        let shown = || directory.display().to_string();
        let files = RunFiles::find(directory)?;
        let files =
            files.ok_or_else(|| OpenError::NoRun { path: shown(), found: "no manifest.json".into() })?;
        let manifest = files.manifest()?;
        let document = problem_document(directory, &files.read(PROBLEM)?)?;
        let StatedProblem::Inputs(problem) = document.stated()? else {
            return Err(OpenError::NoRun {
                path: shown(),
                found: "a problem whose actions are targets".into(),
            });
        };
        let abstraction = InputAbstraction::new(&problem)
            .map_err(|error| OpenError::Inputs { path: shown(), error: Box::new(error) })?;
        Ok(Self { directory: directory.to_path_buf(), manifest, problem: *problem, abstraction })
    }

    /// Bounds on the value of every cell and the policy behind them; the same for the same directory and options.
    pub fn solve(&self, options: &SolverOptions<'_>) -> LandingSolution {
        self.abstraction.question().solve(options)
    }
}

impl Manifest {
    /// Describes the compilation of a problem whose actions are inputs: states are cells.
    pub fn of_inputs(
        document: &Document,
        source: &str,
        problem: &InputProblem,
        abstraction: &InputAbstraction,
    ) -> Self {
        let guarantee = Guarantee {
            event: Event::of_inputs(problem),
            evidence: Evidence::Known { unlisted: abstraction.unlisted() },
        };
        let name = document.name.rsplit(['/', '\\']).next().unwrap_or(&document.name).to_owned();
        let micro_steps = abstraction.micro_steps();
        Self {
            name: problem.name().to_owned(),
            states: problem.grid().num_cells().into(),
            choices: abstraction.num_choices() as u64,
            mode: guarantee.mode().into(),
            guarantee,
            horizon: problem
                .horizon()
                .map(|steps| GroupedHorizon { model_steps: steps * micro_steps, original_steps: steps }),
            group_steps: 1,
            micro_steps: Some(micro_steps),
            property: abstraction.property(Resolution::Pmaxmin).to_string(),
            threshold: problem.threshold().map(Probability::to_f64),
            initial_state: problem.initial_state().map(<[f64]>::to_vec),
            warnings: problem.warnings().iter().map(ToString::to_string).collect(),
            inputs: vec![InputFile { name, sha256: sha256_hex(source.as_bytes()) }],
            ..Self::empty()
        }
    }
}

/// Writes the directory `target`: problem, properties, manifest, and the model in the formats asked for.
///
/// Returns the manifest with the list of files. Either all files appear or none.
///
/// # Errors
/// [`RunDirectoryError`] if the place is taken, the disk too small, the model beyond a format, or writing fails.
pub fn write_input_run(
    target: &Path,
    document: &Document,
    problem: &InputProblem,
    abstraction: &InputAbstraction,
    mut manifest: Manifest,
    options: &WriteOptions,
    progress: &dyn Progress,
) -> Result<Manifest, RunDirectoryError> {
    let mut staging = Staging::begin(target, options.force)?;
    if !options.formats.is_empty() {
        let LandingModel { model, of_cell, .. } =
            abstraction.question().model(&abstraction.initial(problem.initial_cell()))?;
        let size = model.size();
        manifest.states = size.states;
        manifest.choices = size.choices;
        manifest.transitions = size.transitions;
        manifest.rows = size.rows;
        manifest.row_entries = size.entries;
        manifest.initial_model_state =
            problem.initial_cell().and_then(|cell| match of_cell[cell.index()][..] {
                [state] => Some(state),
                _ => None,
            });
        for format in Format::ALL.into_iter().filter(|format| options.formats.contains(format)) {
            if format == Format::Native {
                staging.write(NATIVE_MODEL, |out| native::write(&model, out))?;
                continue;
            }
            let writer = ModelWriter::new(&model, format, Compression::Gzip)?;
            staging.require_space(writer.bytes())?;
            for extension in writer.extensions() {
                staging.write(&format!("model.{extension}"), |out| writer.write(extension, out, progress))?;
            }
        }
        staging.write("model.props", |out| {
            [Resolution::Pmaxmin, Resolution::Pmaxmax]
                .into_iter()
                .try_for_each(|resolution| writeln!(out, "{}", abstraction.property(resolution)))
        })?;
    }
    let value = with_automaton(document.value.clone(), problem.objective());
    staging.write(PROBLEM, |out| writeln!(out, "{value:#}"))?;
    manifest.outputs = staging.files().to_vec();
    staging.commit(&manifest)?;
    Ok(manifest)
}

/// A model file that has the text of its automaton in itself.
pub(super) fn with_automaton(mut value: Value, objective: &Objective) -> Value {
    if let Objective::Automaton(task) = objective
        && let (Some(text), Some(field)) = (task.source(), value.pointer_mut("/task/automaton"))
    {
        *field = serde_json::json!({"hoa": text});
    }
    value
}
