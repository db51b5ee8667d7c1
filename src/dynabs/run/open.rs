//! A run opened again, with everything that it knows.

use super::appearance::{NATIVE_MODEL, NOISE, PROBLEM};
use super::error::OpenError;
use super::files::RunFiles;
use super::manifest::Manifest;
use super::solution::{solution_options, stored};
use crate::abstraction::Abstraction;
use crate::model_file::Document;
use crate::problem::{Problem, SampledNoise};
use imdp::files::steady;
use imdp::formats::native;
use imdp::formats::sha256_hex;
use imdp::progress::Progress;
use imdp::property::Property;
use imdp::solver::{Answer, AnswerError, Solution, SolverOptions};
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A directory written by `dynabs-compile`: problem, model and manifest, known to belong together.
///
/// ```
/// use dynabs::abstraction::compile;
/// use dynabs::run::{Manifest, Run, WriteOptions, write_run};
/// use dynabs::imdp::solver::SolverOptions;
/// use dynabs::model_file::Document;
/// use dynabs::problem::Problem;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../models/room_temperature.json");
/// let source = std::fs::read_to_string(path)?;
/// let document = Document::parse(path.as_ref(), &source)?;
/// let problem = document.problem()?;
/// let abstraction = compile(&problem, &())?;
/// let manifest = Manifest::new(&document, &source, &problem, &abstraction);
/// let scratch = tempfile::tempdir()?;
/// let directory = scratch.path().join("room");
/// write_run(&directory, &document, &problem, &abstraction, manifest, WriteOptions::default(), &())?;
///
/// let run = Run::open(&directory, &())?;
/// let answer = run.solve(&SolverOptions::default())?;
/// assert!(answer.lower > 0.99 && answer.solution.policy.is_some());
/// # Ok(())
/// # }
/// ```
#[derive(Clone, Debug)]
pub struct Run {
    /// The directory.
    pub directory: PathBuf,
    /// What the run was.
    pub manifest: Manifest,
    /// The model file, after `--set`.
    pub document: Document,
    /// The problem that it states, with its samples.
    pub problem: Problem,
    /// The model, its targets, the law, and which cell became which state.
    pub abstraction: Abstraction,
    /// The solution of the task, if it was solved when the run was written.
    solution: Option<Solution>,
}

impl Run {
    /// Opens a directory: nothing in it is believed before its hash is that of the manifest, and nothing outside of it
    /// is read.
    ///
    /// # Errors
    /// [`OpenError`] if something is missing, changed, or made by an incompatible version.
    pub fn open(directory: &Path, progress: &dyn Progress) -> Result<Self, OpenError> {
        let overtaken = |error| OpenError::Io { path: directory.display().to_string(), error };
        steady(&[directory.to_owned()], overtaken, || Self::open_once(directory, progress))
    }

    fn open_once(directory: &Path, progress: &dyn Progress) -> Result<Self, OpenError> {
        let shown = directory.display().to_string();
        let refuse = |found: &str| OpenError::NoRun { path: shown.clone(), found: found.to_owned() };
        if !directory.is_dir() {
            return Err(refuse(if directory.exists() { "a file" } else { "nothing" }));
        }
        let files = RunFiles::find(directory)?.ok_or_else(|| refuse("no manifest.json"))?;
        let manifest = files.manifest()?;
        if manifest.pruning.is_some() {
            return Err(OpenError::Pruned { path: shown });
        }
        let document = problem_document(directory, &files.read(PROBLEM)?)?;
        let problem = document.problem()?;
        if let Some((_, text)) = problem.noise().samples().and_then(SampledNoise::file) {
            // What was read, not what is there by now.
            files.compare(NOISE, &sha256_hex(text.as_bytes()))?;
        }
        let bytes = files.read(NATIVE_MODEL)?;
        let model = native::read_from(bytes.as_slice(), bytes.len() as u64).map_err(|error| {
            OpenError::Model { path: directory.join(NATIVE_MODEL).display().to_string(), error }
        })?;
        let guarantee = manifest.guarantee.clone();
        let abstraction = Abstraction::reopen(&problem, model, guarantee, progress)
            .map_err(|error| OpenError::Abstraction { path: shown, error })?;
        let (model, property) = (&abstraction.model, abstraction.property.to_string());
        let is_choice = |state, choice| model.choices().row_of_choice(state, choice).is_some();
        let solution = stored(&files, (NATIVE_MODEL, &property), model.num_states(), &is_choice)?;
        Ok(Self { directory: directory.to_path_buf(), manifest, document, problem, abstraction, solution })
    }

    /// The task as a property of the model.
    pub fn property(&self) -> &Property {
        &self.abstraction.property
    }

    /// The solution of the task with its policy, and with the values of earlier steps that [`solution_options`] asks for.
    ///
    /// It is the one that the run holds, or else it is computed: the same bounds and policy in both cases.
    ///
    /// # Errors
    /// [`AnswerError`] if the options make no sense.
    pub fn solve(&self, options: &SolverOptions<'_>) -> Result<Answer, AnswerError> {
        let (model, property) = (&self.abstraction.model, self.property());
        match &self.solution {
            Some(solution) => Answer::of_solution(model, property, solution.clone()),
            None => Answer::new(model, property, &solution_options(&self.problem, options)),
        }
    }
}

/// The problem of a run, which names no file but the one beside it.
///
/// # Errors
/// [`OpenError::ForeignFile`] if it does.
pub(super) fn problem_document(directory: &Path, bytes: &[u8]) -> Result<Document, OpenError> {
    let path = directory.join(PROBLEM);
    let document = Document::parse(&path, &String::from_utf8_lossy(bytes))?;
    match foreign_file(&document.value) {
        None => Ok(document),
        Some(file) => {
            Err(OpenError::ForeignFile { path: path.display().to_string(), found: file.to_owned() })
        }
    }
}

/// The first file that a model file names and that is not the samples of a run.
fn foreign_file(value: &Value) -> Option<&str> {
    match value {
        Value::Object(fields) => fields.iter().find_map(|(key, value)| match value {
            Value::String(file) if key == "file" => Some(file.as_str()).filter(|file| *file != NOISE),
            value => foreign_file(value),
        }),
        Value::Array(items) => items.iter().find_map(foreign_file),
        _ => None,
    }
}
