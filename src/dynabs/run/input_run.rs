//! Runs of problems whose actions are inputs: written, and opened again.

use super::RunFiles;
use super::appearance::{NATIVE_MODEL, NOISE, PROBLEM};
use super::error::OpenError;
use super::manifest::{Coordinates, GroupedHorizon, InputFile, Manifest};
use super::open::problem_document;
use super::solution::{ON_LATTICE, input_solution_options, stored};
use super::staging::{RunDirectoryError, Staging};
use super::write::{
    WriteOptions, begin_with_model, self_contained, with_automaton, write_samples, write_solution,
};
use crate::abstraction::inputs::{InputAbstraction, InputEncoding, InputModel};
use crate::guarantee::{Event, Guarantee};
use crate::landing::LandingSolution;
use crate::model_file::{Document, StatedProblem};
use crate::problem::{InputProblem, SampledNoise};
use imdp::formats::{native, sha256_hex};
use imdp::progress::Progress;
use imdp::property::{Probability, Resolution};
use imdp::solver::SolverOptions;
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
    /// The model file.
    pub document: Document,
    /// The problem.
    pub problem: InputProblem,
    /// Its abstraction.
    pub abstraction: InputAbstraction,
    /// The solution of the task, if it was solved when the run was written.
    solution: Option<LandingSolution>,
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
        if let Some((_, text)) = problem.noise().samples().and_then(|samples| samples.noise.file()) {
            // What was read, not what is there by now.
            files.compare(NOISE, &sha256_hex(text.as_bytes()))?;
        }
        let abstraction = InputAbstraction::new(&problem)
            .map_err(|error| OpenError::Inputs { path: shown(), error: Box::new(error) })?;
        let (question, inputs) = (abstraction.question(), problem.inputs().len());
        let is_input = |_, input| (input as usize) < inputs;
        let solution = stored(&files, (PROBLEM, ON_LATTICE), question.num_pairs(), &is_input)?;
        let solution = solution.and_then(|solution| question.restored(solution));
        Ok(Self {
            directory: directory.to_path_buf(),
            manifest,
            document,
            problem: *problem,
            abstraction,
            solution,
        })
    }

    /// The solution of the task: the one that the run holds, or else it is computed, with the same result.
    pub fn solution(&self, options: &SolverOptions<'_>) -> LandingSolution {
        self.solution.clone().unwrap_or_else(|| self.solve(&input_solution_options(&self.problem, options)))
    }

    /// Computes bounds on the value of every cell and the policy behind them; the same for the same directory and options.
    pub fn solve(&self, options: &SolverOptions<'_>) -> LandingSolution {
        self.abstraction.question().solve(options)
    }

    /// A solution with the values of all steps, where they are few; where they are many, or do not change, as it is.
    pub fn by_step(&self, solution: &LandingSolution, options: &SolverOptions<'_>) -> LandingSolution {
        let options = input_solution_options(&self.problem, options);
        match solution.history.is_empty() && options.history > 0 {
            true => self.solve(&options),
            false => solution.clone(),
        }
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
        let guarantee =
            Guarantee { event: Event::of_inputs(problem), evidence: abstraction.evidence.clone() };
        let micro_steps = abstraction.micro_steps();
        let samples = problem.noise().samples().map(|samples| &samples.noise);
        let file = |name: &str, text: &str| {
            let name = name.rsplit(['/', '\\']).next().unwrap_or(name).to_owned();
            InputFile { name, sha256: sha256_hex(text.as_bytes()) }
        };
        let of_samples = samples.and_then(SampledNoise::file).map(|(name, text)| file(name, text));
        let inputs = std::iter::once(file(&document.name, source)).chain(of_samples).collect();
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
            coordinates: Some(Coordinates {
                states: problem.mode().states().to_vec(),
                inputs: problem.mode().inputs().to_vec(),
            }),
            discretisation: problem.mode().discretisation().map(ToString::to_string),
            property: abstraction.property(Resolution::Pmaxmin).to_string(),
            threshold: problem.threshold().map(Probability::to_f64),
            initial_state: problem.initial_state().map(<[f64]>::to_vec),
            samples: samples.map_or(0, |samples| samples.samples.len() as u64),
            seed: samples.and_then(SampledNoise::seed),
            warnings: problem
                .warnings()
                .iter()
                .chain(&abstraction.warnings)
                .map(ToString::to_string)
                .collect(),
            inputs,
            ..Self::empty()
        }
    }
}

impl Manifest {
    /// The same, with what is true of the model that files have.
    pub fn with_model(mut self, problem: &InputProblem, exported: &InputModel) -> Self {
        let size = exported.model.size();
        self.states = size.states;
        self.choices = size.choices;
        self.transitions = size.transitions;
        self.rows = size.rows;
        self.row_entries = size.entries;
        self.initial_model_state =
            problem.initial_cell().and_then(|cell| match exported.of_cell[cell.index()][..] {
                [state] => Some(state),
                _ => None,
            });
        self.micro_steps = Some(exported.micro_steps);
        self.encoding = match exported.encoding {
            InputEncoding::Landing => None,
            InputEncoding::Flat => Some("flat".into()),
        };
        self.property = exported.properties[0].to_string();
        self.costs.clone_from(&exported.costs);
        if let Some(horizon) = &mut self.horizon {
            horizon.model_steps = horizon.original_steps.saturating_mul(exported.micro_steps);
        }
        self
    }
}

/// Writes the directory `target`: problem, properties, manifest, and the model, if there is one, natively and in the formats
/// asked for.
///
/// Returns the manifest with the list of files. Either all files appear or none.
///
/// # Errors
/// [`RunDirectoryError`] if the place is taken, the disk too small, the model beyond a format, or writing fails.
pub fn write_input_run(
    target: &Path,
    document: &Document,
    problem: &InputProblem,
    exported: Option<&InputModel>,
    mut manifest: Manifest,
    options: &WriteOptions,
    progress: &dyn Progress,
) -> Result<Manifest, RunDirectoryError> {
    let mut staging = match exported {
        None => Staging::begin(target, options.force)?,
        Some(InputModel { model, properties, costs, .. }) => {
            // What pruning leaves has the lower bound only.
            let asked = if manifest.pruning.is_some() { &properties[..1] } else { &properties[..] };
            let (mut staging, row_states) = begin_with_model(target, model, asked, options, progress)?;
            manifest.row_states = row_states;
            staging.write(NATIVE_MODEL, |out| native::write(model, out))?;
            staging.write("model.props", |out| {
                asked.iter().try_for_each(|property| writeln!(out, "{property}"))?;
                costs.iter().try_for_each(|question| writeln!(out, "{question}"))
            })?;
            staging
        }
    };
    let samples = problem.noise().samples().map(|samples| &samples.noise);
    let is_file = samples.and_then(SampledNoise::file).is_some();
    let value = self_contained(with_automaton(document.value.clone(), problem.objective()), is_file);
    staging.write(PROBLEM, |out| out.write_all(value.as_bytes()))?;
    write_solution(&mut staging, (PROBLEM, ON_LATTICE), options.solution)?;
    if let Some(samples) = samples {
        staging.write(NOISE, |out| write_samples(samples, out))?;
    }
    manifest.outputs = staging.files().to_vec();
    staging.commit(&manifest)?;
    Ok(manifest)
}
