//! Storm, by its Python bindings.

use super::find::find;
use super::process::{Ended, RunLimits, run};
use super::storm_question::StormQuestion;
use super::values::decode_values;
use super::{
    Engine, EngineAnswer, EngineFailure, EngineMissing, EngineQuestion, Handed, Reply, Strategy, Subject,
};
use crate::files::StagedDirectory;
use crate::formats::Format;
use crate::formats::umb::{Compression, UmbWriter};
use crate::model::{ActionNames, IntervalMdp, Labels, ModelKind, Parts, StateSet, StateVariables};
use serde::Deserialize;
use serde_json::json;
use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// The program that asks Storm.
const SCRIPT: &str = include_str!("../templates/storm.py");
/// Storm stops when no value changes by more than this in one iteration.
const PRECISION: f64 = 1e-13;
/// How long Python may take to tell whether it has stormpy.
const PATIENCE: Duration = Duration::from_secs(60);
const REMEDY: &str = "Install it: python3 -m venv .venv && .venv/bin/pip install stormpy; the Python is then .venv/bin/python.";
const EXPECTED: &str =
    "a Python that can import stormpy 2: one that is given, $DYNABS_PYTHON, that of $VIRTUAL_ENV or python3";

/// Storm, as a Python that can import stormpy.
#[derive(Clone, Debug)]
pub struct Storm {
    python: PathBuf,
    version: String,
}

impl Storm {
    /// The Python at `given`, else `$DYNABS_PYTHON`, else that of `$VIRTUAL_ENV` or `python3` with stormpy.
    ///
    /// # Errors
    /// [`EngineMissing`] if none of these can import stormpy 2.
    pub fn find(given: Option<&Path>) -> Result<Self, EngineMissing> {
        let variable =
            |name: &str| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
        let chosen = given.map(Path::to_path_buf).or_else(|| variable("DYNABS_PYTHON"));
        let candidates = chosen.map_or_else(
            || {
                let environment = variable("VIRTUAL_ENV").map(|path| path.join("bin").join("python"));
                environment.into_iter().chain([PathBuf::from("python3")]).collect()
            },
            |chosen| vec![chosen],
        );
        let mut found = vec![];
        for name in &candidates {
            match Self::try_python(name) {
                Ok(storm) => return Ok(storm),
                Err(why) => found.push(format!("{} {why}", name.display())),
            }
        }
        Err(EngineMissing { engine: "Storm", found: found.join(", "), expected: EXPECTED, remedy: REMEDY })
    }

    /// Asks a Python for the version of its stormpy.
    fn try_python(name: &Path) -> Result<Self, String> {
        let python = find(name).ok_or("is no program")?;
        let limits = RunLimits { timeout: PATIENCE, memory_mib: u64::MAX, progress: &() };
        let mut command = Command::new(&python);
        command.args(["-c", "import stormpy; print('stormpy', stormpy.__version__)"]);
        let ended = run(&mut command, &limits, true, || 0).map_err(|failure| match failure {
            EngineFailure::Exit { .. } => "cannot import stormpy".to_owned(),
            failure => format!("cannot be asked for stormpy: {failure}"),
        })?;
        let version = ended.stdout.trim().strip_prefix("stormpy ").unwrap_or_default().to_owned();
        match version.split('.').next().map(str::parse::<u32>) {
            // Before version 2, step-bounded values of interval models are those of one step more or less.
            Some(Ok(2..)) => Ok(Self { python, version }),
            _ => Err(format!("has stormpy {version}, which is too old")),
        }
    }

    /// Asks until a question has no answer; the outcomes of the first questions, at least one.
    fn ask_in_one_run(
        &self,
        subject: &Subject<'_>,
        questions: &[StormQuestion],
        limits: &RunLimits<'_>,
    ) -> Vec<Result<EngineAnswer, EngineFailure>> {
        let directory = match stage(subject, questions) {
            Ok(directory) => directory,
            Err(failure) => return vec![Err(failure)],
        };
        let at = |name: String| directory.path().join(name);
        let mut command = Command::new(&self.python);
        command.current_dir(directory.path()).args(["-B", "storm.py", "questions.json"]);
        let is_answered = |i: &usize| at(format!("{i}.json")).exists();
        let ran = run(&mut command, limits, false, || (0..questions.len()).filter(is_answered).count());
        let peak_mib = ran.as_ref().ok().and_then(|ended| ended.peak_mib);
        let mut outcomes = Vec::with_capacity(questions.len());
        for (i, question) in questions.iter().enumerate() {
            if !is_answered(&i) {
                let no_answer = |ended: Ended| EngineFailure::NoAnswer { said: ended.said() };
                outcomes.push(Err(ran.map_or_else(|failure| failure, no_answer)));
                break;
            }
            let files = [at(format!("{i}.json")), at(format!("{i}.values")), at(format!("{i}.strategy"))];
            outcomes.push(read_answer(subject, question, &files, peak_mib));
        }
        outcomes
    }
}

impl Engine for Storm {
    fn name(&self) -> &'static str {
        "Storm"
    }

    fn stopping(&self) -> String {
        format!("stops when no value changes by more than {PRECISION:e} in one iteration")
    }

    fn settled(&self, _: f64) -> f64 {
        PRECISION
    }

    fn ask(&self, subject: &Subject<'_>, questions: &[EngineQuestion], limits: &RunLimits<'_>) -> Vec<Reply> {
        let (mut suitable, mut refused) = (vec![], vec![]);
        for (number, question) in questions.iter().enumerate() {
            match StormQuestion::new(number, question, subject.handed) {
                Ok(question) => suitable.push(question),
                Err(reason) => refused.push((number, Err(EngineFailure::Unsuitable { reason }))),
            }
        }
        let mut outcomes = Vec::with_capacity(questions.len());
        // A question that ends a run takes no other with it.
        while outcomes.len() < suitable.len() {
            outcomes.extend(self.ask_in_one_run(subject, &suitable[outcomes.len()..], limits));
        }
        let mut outcomes: Vec<_> =
            suitable.iter().map(|question| question.number).zip(outcomes).chain(refused).collect();
        outcomes.sort_by_key(|(number, _)| *number);
        let reply = |(_, outcome)| Reply { version: Some(self.version.clone()), outcome };
        outcomes.into_iter().map(reply).collect()
    }
}

/// A directory with the script, the model and the questions.
fn stage(subject: &Subject<'_>, questions: &[StormQuestion]) -> Result<StagedDirectory, EngineFailure> {
    let failed = |path: &Path, error| EngineFailure::Files { path: path.to_path_buf(), error };
    let directory = super::scratch().map_err(|error| failed(&std::env::temp_dir(), error))?;
    let at = |name: &str| directory.path().join(name);
    let file = match subject.handed {
        Handed::AsIs(path, format @ (Format::Umb | Format::Drn)) => {
            let name = format!("model.{}", format.extension());
            super::link(path, &at(&name)).map_err(|error| failed(path, error))?;
            name
        }
        Handed::AsIs(_, format) => {
            let reason = format!("found a file in the format {format}; expected .drn or .umb");
            return Err(EngineFailure::Unsuitable { reason });
        }
        Handed::Copy | Handed::Explicit(_) => {
            write_model(subject.model, questions, &at("model.umb"))?;
            "model.umb".to_owned()
        }
    };
    let has_policy = subject.model.kind() == ModelKind::Imdp;
    let request = json!({
        "model": file,
        "precision": format!("{PRECISION:e}"),
        "questions": questions.iter().map(|question| json!({
            "formula": question.formula,
            "nature": if question.nature_maximises { "max" } else { "min" },
            "strategy": question.is_unbounded && has_policy,
        })).collect::<Vec<_>>(),
    });
    for (name, text) in [("storm.py", SCRIPT), ("questions.json", &request.to_string())] {
        fs::write(at(name), text).map_err(|error| failed(&at(name), error))?;
    }
    Ok(directory)
}

/// Writes the model with the labels of the questions.
fn write_model(model: &IntervalMdp, questions: &[StormQuestion], umb: &Path) -> Result<(), EngineFailure> {
    let unsuitable = |reason| EngineFailure::Unsuitable { reason };
    let labels = questions.iter().flat_map(|question| question.labels.iter().cloned());
    let labelled = with_labels(model, labels).map_err(unsuitable)?;
    // It raises lower bounds of 0 by itself.
    let writer = UmbWriter::new(&labelled).map_err(|error| unsuitable(error.to_string()))?;
    let write = || {
        super::require_space(umb.parent().unwrap_or(umb), writer.bytes())?;
        let mut out = BufWriter::with_capacity(1 << 18, File::create(umb)?);
        writer.write(&mut out, Compression::None, &())?;
        out.flush()
    };
    write().map_err(|error| EngineFailure::Files { path: umb.to_path_buf(), error })
}

/// The model with these labels and nothing that only people need.
fn with_labels(
    model: &IntervalMdp,
    sets: impl Iterator<Item = (String, StateSet)>,
) -> Result<IntervalMdp, String> {
    let mut labels = Labels::default();
    sets.for_each(|(name, states)| labels.insert(name, states));
    let parts = Parts {
        kind: ModelKind::Imdp,
        rows: model.rows().clone(),
        choices: model.choices().clone(),
        actions: ActionNames::None,
        initial: model.initial().clone(),
        labels,
        variables: StateVariables::default(),
    };
    IntervalMdp::new(parts).map_err(|error| error.to_string())
}

/// What the script says about one question.
#[derive(Deserialize)]
struct Report {
    seconds: f64,
    error: Option<String>,
}

fn read_answer(
    subject: &Subject<'_>,
    question: &StormQuestion,
    [report, values, strategy]: &[PathBuf; 3],
    peak_mib: Option<u64>,
) -> Result<EngineAnswer, EngineFailure> {
    let read = |path: &Path| {
        fs::read(path).map_err(|error| EngineFailure::Files { path: path.to_path_buf(), error })
    };
    let report: Report = serde_json::from_slice(&read(report)?)
        .map_err(|error| EngineFailure::NoAnswer { said: error.to_string() })?;
    if let Some(said) = report.error {
        return Err(EngineFailure::Refused { said });
    }
    let mut values = decode_values(&read(values)?, subject.model.num_states())?;
    if question.complement {
        values.iter_mut().for_each(|value| *value = 1.0 - *value);
    }
    let strategy = match strategy.exists() {
        true => Some(Strategy::parse(&String::from_utf8_lossy(&read(strategy)?), subject.model)?),
        false => None,
    };
    let time = Duration::try_from_secs_f64(report.seconds).unwrap_or_default();
    Ok(EngineAnswer { values, strategy, time, peak_mib })
}
