//! One setting of a sweep, in a directory of its own.

use super::program::Program;
use super::spec::{Sweep, text};
use crate::CliError;
use imdp::files::{self, Outputs};
use serde_json::{Map, Value, json};
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::Stdio;

/// What a job is, for whoever runs and collects it.
const JOB: &str = "job.json";
/// What it said on the way.
const LOG: &str = "log.txt";
/// The run that it wrote.
const RUN: &str = "run";

/// A job that has been written.
pub(in crate::commands) struct Job {
    pub(in crate::commands) directory: PathBuf,
    model: String,
    pub(in crate::commands) setting: Map<String, Value>,
}

/// What is wanted of a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::commands) enum Purpose {
    /// How large its model is.
    Size,
    /// Its bound, and no file.
    Bound,
    /// Its bound and a run without files for other programs.
    Run,
    /// Its bound and a run as `compile` writes it.
    WholeRun,
}

impl Purpose {
    /// The options of `compile`.
    fn options(self) -> &'static [&'static str] {
        match self {
            Self::Size => &["--dry-run", "--json"],
            Self::Bound => &["--dry-run", "--solve", "--json"],
            Self::Run => &["--solve", "--no-tra", "--json", "--force", "-o", RUN],
            Self::WholeRun => &["--solve", "--json", "--force", "-o", RUN],
        }
    }

    /// The file of what `compile --json` printed.
    fn result(self) -> &'static str {
        match self {
            Self::Size => "size.json",
            _ => "result.json",
        }
    }
}

/// How far a job got.
pub(in crate::commands) enum Outcome {
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
    pub(in crate::commands) fn write_all(sweep: &Sweep, below: &Path) -> Result<Vec<Self>, CliError> {
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
            "{}: found the jobs of other settings; expected none, or those of these\n  Choose another directory with -o.",
            below.display()
        ))
    }

    /// A job of one setting, in a directory of its own, which is made; whatever another one left there is taken away.
    ///
    /// # Errors
    /// [`CliError`] if that fails.
    pub(in crate::commands) fn at(
        directory: PathBuf,
        model: &Path,
        setting: Map<String, Value>,
    ) -> Result<Self, CliError> {
        let job = Self { directory, model: model.display().to_string(), setting };
        let same = Self::read(job.directory.clone())
            .is_ok_and(|found| found.model == job.model && found.setting == job.setting);
        if !same {
            let write = || {
                fs::create_dir_all(&job.directory)?;
                match fs::remove_file(job.directory.join(Purpose::WholeRun.result())) {
                    Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
                    _ => {}
                }
                job.write()
            };
            write().map_err(|error| CliError::writing(&job.directory, &error))?;
        }
        Ok(job)
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
            .filter(|path| is_number(path) && path.join(JOB).is_file())
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

    /// What `compile` is called with, in the directory of the job.
    fn arguments(&self, purpose: Purpose) -> Vec<String> {
        let sets =
            self.setting.iter().flat_map(|(pointer, value)| ["--set".to_owned(), text(pointer, value)]);
        let options = purpose.options().iter().map(|&option| option.to_owned());
        std::iter::once(self.model.clone()).chain(options).chain(sets).collect()
    }

    /// The same as a line for a shell, which keeps what is printed.
    pub(super) fn line(&self) -> String {
        let arguments = self.arguments(Purpose::Run);
        let quoted: Vec<String> = arguments.iter().map(|argument| quoted(argument)).collect();
        let result = Purpose::Run.result();
        format!(
            "dynabs 'compile' {} > {result}.part 2> {LOG}; code=$?; mv {result}.part {result}; exit $code\n",
            quoted.join(" ")
        )
    }

    /// Runs the job to its end; its outcome is in its directory.
    ///
    /// # Errors
    /// Whatever keeps the process from running.
    pub(in crate::commands) fn run(&self, program: &Program, purpose: Purpose) -> io::Result<()> {
        let part = self.directory.join(format!("{}.part", purpose.result()));
        program
            .compile()
            .args(self.arguments(purpose))
            .current_dir(&self.directory)
            .stdin(Stdio::null())
            .stdout(File::create(&part)?)
            .stderr(File::create(self.directory.join(LOG))?)
            .status()?;
        fs::rename(part, self.directory.join(purpose.result()))
    }

    /// How far it got.
    pub(in crate::commands) fn outcome(&self, purpose: Purpose) -> Outcome {
        let read = |name: &str| files::read_text(&self.directory.join(name)).ok();
        let Some(text) = read(purpose.result()) else { return Outcome::Open };
        if let Ok(result) = serde_json::from_str(&text) {
            return Outcome::Done(Box::new(result));
        }
        let log = read(LOG).unwrap_or_default();
        let error = log.lines().rev().find_map(|line| line.strip_prefix("error: "));
        Outcome::Failed(error.unwrap_or("it ended without a result").to_owned())
    }

    /// The name of its directory.
    pub(in crate::commands) fn name(&self) -> String {
        self.directory.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }
}

/// Whether a directory has the name of a job.
fn is_number(path: &Path) -> bool {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    name.bytes().all(|byte| byte.is_ascii_digit())
}

/// A word for a shell.
pub(super) fn quoted(text: &str) -> String {
    format!("'{}'", text.replace('\'', r"'\''"))
}
