//! One setting of a sweep, in a directory of its own.

use super::spec::{Sweep, text};
use crate::CliError;
use imdp::files::{self, Outputs};
use serde_json::{Map, Value, json};
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// What a job is, for whoever runs and collects it.
const JOB: &str = "job.json";
/// What `dynabs compile --json` printed.
const RESULT: &str = "result.json";
/// What it said on the way.
const LOG: &str = "log.txt";
/// The run that it wrote.
const RUN: &str = "run";

/// A job that has been written.
pub(super) struct Job {
    pub(super) directory: PathBuf,
    model: String,
    pub(super) setting: Map<String, Value>,
}

/// How far a job got.
pub(super) enum Outcome {
    /// It has a result.
    Done(Box<Value>),
    /// It ended without one.
    Failed(String),
    /// It has not been run, or not to its end.
    Open,
}

impl Job {
    /// Writes a directory for every setting, below one that is there; the same jobs may be there already.
    ///
    /// # Errors
    /// [`CliError`] if that fails, or if other jobs are there.
    pub(super) fn write_all(sweep: &Sweep, below: &Path) -> Result<Vec<Self>, CliError> {
        let model = sweep.model.display().to_string();
        if let Ok(jobs) = Self::read_all(below) {
            let same = jobs.len() == sweep.settings.len()
                && jobs
                    .iter()
                    .zip(&sweep.settings)
                    .all(|(job, setting)| job.model == model && job.setting == *setting);
            return if same { Ok(jobs) } else { Err(Self::taken(below)) };
        }
        let write = |(i, setting): (usize, &Map<String, Value>)| {
            let directory = below.join(format!("{:04}", i + 1));
            fs::create_dir_all(&directory).map_err(|error| CliError::writing(&directory, &error))?;
            let job = Self { directory, model: model.clone(), setting: setting.clone() };
            job.write().map_err(|error| CliError::writing(&job.directory, &error))?;
            Ok(job)
        };
        sweep.settings.iter().enumerate().map(write).collect()
    }

    fn taken(below: &Path) -> CliError {
        CliError::Input(format!(
            "{}: found the jobs of another sweep; expected none, or those of this one\n  Choose another directory with -o.",
            below.display()
        ))
    }

    fn write(&self) -> io::Result<()> {
        let object = json!({"model": self.model, "settings": self.setting});
        let mut files = Outputs::default();
        files.write(&self.directory.join(JOB), |out| writeln!(out, "{object:#}"))?;
        files.commit()
    }

    /// The jobs below a directory, in the order of their numbers.
    ///
    /// # Errors
    /// [`CliError`] if it cannot be read, or if there are none.
    pub(super) fn read_all(below: &Path) -> Result<Vec<Self>, CliError> {
        let entries = fs::read_dir(below).map_err(|error| CliError::reading(below, &error))?;
        let mut directories: Vec<PathBuf> = entries
            .filter_map(|entry| Some(entry.ok()?.path()))
            .filter(|path| path.join(JOB).is_file())
            .collect();
        directories.sort();
        if directories.is_empty() {
            return Err(CliError::Input(format!(
                "{}: found no jobs; expected a directory written by dynabs sweep",
                below.display()
            )));
        }
        directories.into_iter().map(Self::read).collect()
    }

    fn read(directory: PathBuf) -> Result<Self, CliError> {
        let path = directory.join(JOB);
        let text = files::read_text(&path).map_err(|error| CliError::reading(&path, &error))?;
        let parts = serde_json::from_str::<Value>(&text).ok().and_then(|mut job| {
            let model = job["model"].as_str()?.to_owned();
            match job["settings"].take() {
                Value::Object(setting) => Some((model, setting)),
                _ => None,
            }
        });
        let (model, setting) = parts.ok_or_else(|| {
            CliError::Input(format!(
                "{}: found something else than a job; expected what dynabs sweep wrote",
                path.display()
            ))
        })?;
        Ok(Self { directory, model, setting })
    }

    /// What the tool is called with, in the directory of the job.
    pub(super) fn arguments(&self, threads: Option<usize>) -> Vec<String> {
        let fixed = ["compile", &self.model, "--solve", "--no-tra", "--json", "--force", "-o", RUN];
        let mut arguments: Vec<String> = fixed.map(str::to_owned).to_vec();
        for (pointer, value) in &self.setting {
            arguments.extend(["--set".to_owned(), text(pointer, value)]);
        }
        arguments
            .extend(threads.into_iter().flat_map(|threads| ["--threads".to_owned(), threads.to_string()]));
        arguments
    }

    /// The same as a line for a shell, which keeps what is printed.
    pub(super) fn line(&self) -> String {
        let quoted: Vec<String> = self.arguments(None).iter().map(|argument| quoted(argument)).collect();
        format!(
            "dynabs {} > {RESULT}.part 2> {LOG}; code=$?; mv {RESULT}.part {RESULT}; exit $code\n",
            quoted.join(" ")
        )
    }

    /// Runs the job to its end, with so many threads; its outcome is in its directory.
    ///
    /// # Errors
    /// Whatever keeps the process from running.
    pub(super) fn run(&self, program: &Path, threads: usize) -> io::Result<()> {
        let part = self.directory.join(format!("{RESULT}.part"));
        let mut command = Command::new(program);
        command
            .args(self.arguments(Some(threads)))
            .current_dir(&self.directory)
            .stdin(Stdio::null())
            .stdout(File::create(&part)?)
            .stderr(File::create(self.directory.join(LOG))?);
        command.status()?;
        fs::rename(part, self.directory.join(RESULT))
    }

    /// How far it got.
    pub(super) fn outcome(&self) -> Outcome {
        let read = |name: &str| files::read_text(&self.directory.join(name)).ok();
        let Some(text) = read(RESULT) else { return Outcome::Open };
        if let Ok(result) = serde_json::from_str(&text) {
            return Outcome::Done(Box::new(result));
        }
        let log = read(LOG).unwrap_or_default();
        let error = log.lines().rev().find_map(|line| line.strip_prefix("error: "));
        Outcome::Failed(error.unwrap_or("it ended without a result").to_owned())
    }
}

/// A word for a shell.
pub(super) fn quoted(text: &str) -> String {
    format!("'{}'", text.replace('\'', r"'\''"))
}
