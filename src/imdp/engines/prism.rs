//! PRISM's explicit engine.

use super::find::find;
use super::process::{Ended, RunLimits, run};
use super::values::{Range, parse_values};
use super::{
    Engine, EngineAnswer, EngineFailure, EngineMissing, EngineQuestion, Handed, Reply, Strategy, Subject,
};
use crate::files::StagedDirectory;
use crate::formats::prism::{ExplicitFiles, RewardFile, TraWriter, check_names, write_lab, write_sta};
use crate::formats::{ChangedName, Format, Names, identifiers};
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
            (Some(given), _) => (given, ""),
            (None, Some(variable)) => (variable.as_path(), "$PRISM, "),
            (None, None) => (Path::new("prism"), "PATH: "),
        };
        let missing = || EngineMissing {
            engine: "PRISM",
            found: format!("{origin}{} is no program", name.display()),
            expected: "PRISM 4.8 or newer: one that is given, $PRISM or prism in PATH",
            remedy: "Get it at https://www.prismmodelchecker.org/download.php (it needs Java); the program is its bin/prism.",
        };
        find(name).map(|command| Self { command }).ok_or_else(missing)
    }

    fn answer(
        &self,
        subject: &Subject<'_>,
        (directory, files): (&Path, &str),
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
        command.current_dir(directory).args(["-importmodel", files, "-ex"]);
        command.args(["-javamaxmem", &format!("{heap}m"), "-epsilon", &EPSILON.to_string()]);
        command.args(["-maxiters", ITERATIONS, "-pf", &renamed(&question.text(), subject.model)]);
        command.args(["-exportvector", "values.txt"]);
        let decides = question.query().is_some_and(|query| !matches!(query.kind, QueryKind::Next { .. }));
        if decides && subject.model.kind() == ModelKind::Imdp {
            command.args(["-exportstrat", "strategy.txt:type=indices,states=false"]);
        }
        match run(&mut command, limits, true, || 0) {
            Err(failure) => (None, Err(failure)),
            Ok(ended) => {
                let answer = read_answer(subject, question, [&values, &strategy], &ended);
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
        let with_rewards = questions.iter().any(|question| question.query().is_none());
        let staged = stage(subject, with_rewards);
        let (directory, files) = match &staged {
            Ok((directory, files)) => (directory.path(), files.as_str()),
            Err(failure) => {
                let reply = |_| Reply { version: None, outcome: Err(failure.again()) };
                return questions.iter().map(reply).collect();
            }
        };
        // PRISM overwrites the values of one property by those of the next: one run each.
        let ask = |question| {
            let (version, outcome) = self.answer(subject, (directory, files), question, limits);
            Reply { version, outcome }
        };
        questions.iter().map(ask).collect()
    }
}

/// A directory with the model's files under names that need no quoting, and what `-importmodel` calls them.
fn stage(subject: &Subject<'_>, with_rewards: bool) -> Result<(StagedDirectory, String), StagingFailure> {
    let explicit = |tra: &Path| match with_rewards {
        true => ExplicitFiles::beside(tra).all(),
        false => ["tra", "sta", "lab"].map(|extension| tra.with_extension(extension)).to_vec(),
    };
    let files = |path: &Path, error| StagingFailure::Files(path.to_path_buf(), error);
    let directory = super::scratch().map_err(|error| files(&std::env::temp_dir(), error))?;
    let link_all = |given: &[PathBuf]| {
        let mut suffixes = vec![];
        let stem = given.first().and_then(|first| first.file_stem()).unwrap_or_default().to_string_lossy();
        for file in given {
            let name = file.file_name().unwrap_or_default().to_string_lossy();
            let suffix = name.strip_prefix(&*stem).unwrap_or(&name).to_owned();
            let link = directory.path().join(format!("model{suffix}"));
            super::link(file, &link).map_err(|error| files(file, error))?;
            suffixes.push(suffix);
        }
        Ok(suffixes)
    };
    let suffixes = match subject.handed {
        Handed::Explicit(tra) => link_all(&explicit(tra))?,
        Handed::AsIs(path, format @ (Format::Prism | Format::Umb)) => link_all(&format.files(path))?,
        Handed::AsIs(_, format) => return Err(StagingFailure::Format(format)),
        // The writer raises lower bounds of 0 by itself.
        Handed::Copy => {
            let written = write_model(subject.model, directory.path(), with_rewards);
            written.map_err(|error| files(directory.path(), error))?
        }
    };
    // Numbered files are found by the extension that they share.
    let mut extensions: Vec<&str> = vec![];
    for extension in suffixes.iter().filter_map(|suffix| suffix.rsplit('.').next()) {
        if !extensions.contains(&extension) {
            extensions.push(extension);
        }
    }
    let argument = format!("model.{}", extensions.join(","));
    Ok((directory, argument))
}

/// Why a model cannot be handed to PRISM.
enum StagingFailure {
    Files(PathBuf, io::Error),
    Format(Format),
}

impl StagingFailure {
    /// As what every question fails.
    fn again(&self) -> EngineFailure {
        match self {
            Self::Files(path, error) => EngineFailure::Files {
                path: path.clone(),
                error: io::Error::new(error.kind(), error.to_string()),
            },
            Self::Format(format) => EngineFailure::Unsuitable {
                reason: format!("found a file in the format {format}; expected .tra or .umb"),
            },
        }
    }
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

/// Writes the model's files; returns what their names end with.
fn write_model(model: &IntervalMdp, directory: &Path, with_rewards: bool) -> io::Result<Vec<String>> {
    let changed = changed_names(model);
    let model = changed.as_ref().map_or(model, |(model, _)| model);
    let tra = TraWriter::new(model);
    super::require_space(directory, tra.bytes())?;
    let mut suffixes = vec![];
    let mut write = |suffix: &str, fill: &dyn Fn(&mut BufWriter<File>) -> io::Result<()>| {
        let mut out = BufWriter::new(File::create(directory.join(format!("model{suffix}")))?);
        fill(&mut out)?;
        suffixes.push(suffix.to_owned());
        out.flush()
    };
    write(".tra", &|out| tra.write(out, &()))?;
    write(".sta", &|out| write_sta(model, out))?;
    write(".lab", &|out| write_lab(model, out))?;
    let rewards = if with_rewards { RewardFile::all(model) } else { vec![] };
    rewards.iter().try_for_each(|file| write(&file.suffix, &|out| file.write(out)))?;
    Ok(suffixes)
}

fn read_answer(
    subject: &Subject<'_>,
    question: &EngineQuestion,
    [values, strategy]: [&Path; 2],
    ended: &Ended,
) -> Result<EngineAnswer, EngineFailure> {
    let range = if question.query().is_some() { Range::Probability } else { Range::Expression };
    let Some(values) = read(values)? else { return Err(EngineFailure::NoAnswer { said: ended.said() }) };
    Ok(EngineAnswer {
        values: parse_values(&values, subject.model.num_states(), range)?,
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
