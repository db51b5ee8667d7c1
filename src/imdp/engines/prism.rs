//! PRISM's explicit engine.

use super::find::find;
use super::process::{Ended, RunLimits, run};
use super::values::parse_values;
use super::{Engine, EngineAnswer, EngineFailure, EngineMissing, EngineQuestion, Reply, Strategy, Subject};
use crate::files::StagedDirectory;
use crate::formats::prism::{TraWriter, check_names, write_lab, write_sta};
use crate::formats::{ChangedName, Names, identifiers};
use crate::model::{IntervalMdp, ModelKind};
use crate::property::QueryKind;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::Command;

/// PRISM stops when no value changes by more than this fraction of itself in one sweep.
pub(super) const EPSILON: f64 = 1e-12;
/// Rather the time limit than a number of iterations.
const ITERATIONS: &str = "2000000000";
/// What a Java machine needs besides its heap, in MiB.
const OUTSIDE_HEAP_MIB: u64 = 512;

/// PRISM, as a program.
#[derive(Clone, Debug)]
pub struct Prism {
    command: PathBuf,
}

impl Prism {
    /// PRISM at `given`, else at `$PRISM`, else `prism` in `PATH`.
    ///
    /// # Errors
    /// [`EngineMissing`] if there is no program.
    pub fn find(given: Option<&Path>) -> Result<Self, EngineMissing> {
        let environment = std::env::var_os("PRISM").filter(|value| !value.is_empty()).map(PathBuf::from);
        let (name, origin) = match (given, &environment) {
            (Some(given), _) => (given, "--prism "),
            (None, Some(variable)) => (variable.as_path(), "$PRISM, "),
            (None, None) => (Path::new("prism"), "PATH: "),
        };
        let missing = || EngineMissing {
            engine: "PRISM",
            found: format!("{origin}{} is no program", name.display()),
            expected: "PRISM 4.8 or newer, by --prism PATH, $PRISM or PATH",
            remedy: "Get it at https://www.prismmodelchecker.org/download.php (it needs Java); PATH is its bin/prism.",
        };
        find(name).map(|command| Self { command }).ok_or_else(missing)
    }

    fn answer(
        &self,
        subject: &Subject<'_>,
        directory: &Path,
        question: &EngineQuestion,
        limits: &RunLimits<'_>,
    ) -> (Option<String>, Result<EngineAnswer, EngineFailure>) {
        let (values, strategy) = (directory.join("values.txt"), directory.join("strategy.txt"));
        for file in [&values, &strategy] {
            match fs::remove_file(file) {
                Err(error) if error.kind() != io::ErrorKind::NotFound => {
                    return (None, Err(EngineFailure::Files { path: file.clone(), error }));
                }
                _ => {}
            }
        }
        let heap = limits.memory_mib.saturating_sub(OUTSIDE_HEAP_MIB).max(limits.memory_mib / 2).max(16);
        let mut command = Command::new(&self.command);
        command.current_dir(directory).args(["-importmodel", "model.tra,sta,lab", "-ex"]);
        command.args(["-javamaxmem", &format!("{heap}m"), "-epsilon", &EPSILON.to_string()]);
        command.args(["-maxiters", ITERATIONS, "-pf", &renamed(&question.value.to_string(), subject.model)]);
        command.args(["-exportvector", "values.txt"]);
        let decides = !matches!(question.query.kind, QueryKind::Next { .. });
        if decides && subject.model.kind() == ModelKind::Imdp {
            command.args(["-exportstrat", "strategy.txt:type=indices,states=false"]);
        }
        match run(&mut command, limits, true, || 0) {
            Err(failure) => (None, Err(failure)),
            Ok(ended) => {
                let answer = read_answer(subject, &values, &strategy, &ended);
                (version(&ended.stdout), answer)
            }
        }
    }
}

impl Engine for Prism {
    fn name(&self) -> &'static str {
        "PRISM"
    }

    fn stopping(&self) -> String {
        format!("stops when no value changes by more than {EPSILON:e} of itself in one sweep")
    }

    fn settled(&self, value: f64) -> f64 {
        EPSILON * value
    }

    fn ask(&self, subject: &Subject<'_>, questions: &[EngineQuestion], limits: &RunLimits<'_>) -> Vec<Reply> {
        let directory = match stage(subject) {
            Ok(directory) => directory,
            Err((path, error)) => {
                let failure = |_| {
                    let error = io::Error::new(error.kind(), error.to_string());
                    Reply { version: None, outcome: Err(EngineFailure::Files { path: path.clone(), error }) }
                };
                return questions.iter().map(failure).collect();
            }
        };
        // PRISM overwrites the values of one property by those of the next: one run each.
        let ask = |question| {
            let (version, outcome) = self.answer(subject, directory.path(), question, limits);
            Reply { version, outcome }
        };
        questions.iter().map(ask).collect()
    }
}

/// A directory with the model's files under names that need no quoting.
fn stage(subject: &Subject<'_>) -> Result<StagedDirectory, (PathBuf, io::Error)> {
    let directory = super::scratch().map_err(|error| (std::env::temp_dir(), error))?;
    let at = |extension: &str| directory.path().join("model").with_extension(extension);
    match subject.files {
        Some(files) => {
            for extension in ["tra", "sta", "lab"] {
                let file = files.with_extension(extension);
                link(&file, &at(extension)).map_err(|error| (file, error))?;
            }
        }
        // The writer raises lower bounds of 0 by itself.
        None => write_model(subject.model, &at).map_err(|error| (directory.path().to_path_buf(), error))?,
    }
    Ok(directory)
}

fn link(file: &Path, name: &Path) -> io::Result<()> {
    let file = std::path::absolute(file)?;
    #[cfg(unix)]
    return std::os::unix::fs::symlink(file, name);
    #[cfg(not(unix))]
    return fs::copy(file, name).map(drop);
}

/// What is written instead of names that PRISM does not read.
fn changed_names(model: &IntervalMdp) -> Option<(IntervalMdp, Vec<ChangedName>)> {
    check_names(model).err()?;
    identifiers(model.clone(), Names::Rename).ok()
}

/// A property with the labels that PRISM's files have.
fn renamed(property: &str, model: &IntervalMdp) -> String {
    let names = changed_names(model).map(|(_, names)| names).unwrap_or_default();
    names.iter().filter(|name| name.kind == "label").fold(property.to_owned(), |text, name| {
        let written = name.written.as_deref().unwrap_or(&name.name);
        text.replace(&format!("\"{}\"", name.name), &format!("\"{written}\""))
    })
}

fn write_model(model: &IntervalMdp, at: &impl Fn(&str) -> PathBuf) -> io::Result<()> {
    let changed = changed_names(model);
    let model = changed.as_ref().map_or(model, |(model, _)| model);
    let tra = TraWriter::new(model);
    super::require_space(&at("tra"), tra.bytes())?;
    let write = |extension: &str, fill: &dyn Fn(&mut BufWriter<File>) -> io::Result<()>| {
        let mut out = BufWriter::new(File::create(at(extension))?);
        fill(&mut out)?;
        out.flush()
    };
    write("tra", &|out| tra.write(out, &()))?;
    write("sta", &|out| write_sta(model, out))?;
    write("lab", &|out| write_lab(model, out))
}

fn read_answer(
    subject: &Subject<'_>,
    values: &Path,
    strategy: &Path,
    ended: &Ended,
) -> Result<EngineAnswer, EngineFailure> {
    let Some(values) = read(values)? else { return Err(EngineFailure::NoAnswer { said: ended.said() }) };
    Ok(EngineAnswer {
        values: parse_values(&values, subject.model.num_states())?,
        strategy: read(strategy)?.map(|text| Strategy::parse(&text, subject.model)).transpose()?,
        time: ended.time,
        peak_mib: ended.peak_mib,
    })
}

fn read(path: &Path) -> Result<Option<String>, EngineFailure> {
    match fs::read(path) {
        Ok(bytes) => Ok(Some(String::from_utf8_lossy(&bytes).into_owned())),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(EngineFailure::Files { path: path.to_path_buf(), error }),
    }
}

fn version(log: &str) -> Option<String> {
    log.lines().find_map(|line| line.strip_prefix("Version: ")).map(|version| version.trim().to_owned())
}
