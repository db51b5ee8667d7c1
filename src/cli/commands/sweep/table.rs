//! What came of all jobs, in one table.

use super::job::{Job, Outcome};
use crate::CliError;
use imdp::files::Outputs;
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The table as a file.
const TABLE: &str = "table.csv";

/// One line for every job.
pub(super) struct Table {
    /// The JSON pointers that some job sets.
    pointers: Vec<String>,
    lines: Vec<Line>,
}

struct Line {
    job: String,
    /// Per pointer, the value set, if one is.
    values: Vec<Option<Value>>,
    outcome: Outcome,
}

/// Where the lower bound is in the result of a job.
const LOWER: &str = "/results/0/lower";
/// Where the size of its model is.
const TRANSITIONS: &str = "/transitions";

/// What is read from the result of a job: a name, and where it is.
const FIGURES: [(&str, &str); 7] = [
    ("lower", LOWER),
    ("upper", "/results/0/upper"),
    ("satisfied", "/results/0/satisfied"),
    ("states", "/states"),
    ("choices", "/choices"),
    ("transitions", TRANSITIONS),
    ("seconds", "/results/0/seconds"),
];

impl Line {
    fn state(&self) -> String {
        match &self.outcome {
            Outcome::Done(_) => "done".to_owned(),
            Outcome::Open => "open".to_owned(),
            Outcome::Failed(error) => format!("failed: {error}"),
        }
    }

    fn figure(&self, place: &str) -> Option<&Value> {
        match &self.outcome {
            Outcome::Done(result) => result.pointer(place).filter(|value| !value.is_null()),
            _ => None,
        }
    }

    /// All columns as text.
    fn cells(&self) -> Vec<String> {
        let text = |value: Option<&Value>| value.map_or(String::new(), Value::to_string);
        let settings = self.values.iter().map(|value| text(value.as_ref()));
        let figures = FIGURES.iter().map(|(_, place)| text(self.figure(place)));
        std::iter::once(self.job.clone()).chain(settings).chain(figures).chain([self.state()]).collect()
    }
}

impl Table {
    /// Looks at what all jobs left.
    pub(super) fn collect(jobs: &[Job]) -> Self {
        let mut pointers: Vec<String> = vec![];
        for pointer in jobs.iter().flat_map(|job| job.setting.keys()) {
            if !pointers.contains(pointer) {
                pointers.push(pointer.clone());
            }
        }
        let line = |job: &Job| Line {
            job: job.directory.file_name().unwrap_or_default().to_string_lossy().into_owned(),
            values: pointers.iter().map(|pointer| job.setting.get(pointer).cloned()).collect(),
            outcome: job.outcome(),
        };
        Self { lines: jobs.iter().map(line).collect(), pointers }
    }

    /// Whether every job has a result.
    pub(super) fn is_complete(&self) -> bool {
        self.lines.iter().all(|line| matches!(line.outcome, Outcome::Done(_)))
    }

    fn header(&self) -> Vec<String> {
        let figures = FIGURES.iter().map(|(name, _)| (*name).to_owned());
        let first = std::iter::once("job".to_owned()).chain(self.pointers.iter().cloned());
        first.chain(figures).chain(["state".to_owned()]).collect()
    }

    /// As a table in Markdown.
    pub(super) fn to_markdown(&self) -> String {
        let line = |cells: &[String]| {
            let cells: Vec<String> = cells.iter().map(|cell| cell.replace('|', "\\|")).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let header = self.header();
        let mut text = line(&header);
        // Writing to a string cannot fail.
        let _ = writeln!(text, "|{}", "---|".repeat(header.len()));
        self.lines.iter().for_each(|own| text += &line(&own.cells()));
        text
    }

    /// The setting with the fewest transitions of those that promise at least so much, in words, and what was not compared.
    pub(super) fn cheapest(&self, wanted: f64) -> String {
        let promises =
            |line: &&Line| line.figure(LOWER).and_then(Value::as_f64).is_some_and(|lower| lower >= wanted);
        let size = |line: &Line| line.figure(TRANSITIONS).and_then(Value::as_u64);
        let promising = || self.lines.iter().filter(promises);
        let sized = promising().filter_map(|line| Some((size(line)?, line)));
        let mut text = match sized.min_by_key(|(size, _)| *size) {
            Some((_, line)) => {
                let set = self.pointers.iter().zip(&line.values);
                let set = set.filter_map(|(pointer, value)| Some(format!("{pointer}={}", value.as_ref()?)));
                let set: Vec<String> = set.collect();
                format!(
                    "{} has the fewest transitions of all with at least {wanted}: {}\n",
                    line.job,
                    set.join(" ")
                )
            }
            None => format!("none of these settings has at least {wanted} and a number of transitions\n"),
        };
        let without_size = promising().filter(|line| size(line).is_none()).count();
        let without_result = self.lines.iter().filter(|line| line.figure(LOWER).is_none()).count();
        for (number, what) in
            [(without_size, "at least that bound, but no size"), (without_result, "no lower bound")]
        {
            if number > 0 {
                text += &format!("not compared: {number} of {} jobs with {what}\n", self.lines.len());
            }
        }
        text
    }

    /// As a list of objects.
    pub(super) fn to_json(&self) -> Value {
        let object = |line: &Line| {
            let mut object = json!({"job": line.job, "state": line.state()});
            let set = self.pointers.iter().zip(&line.values);
            object["settings"] =
                set.filter_map(|(pointer, value)| Some((pointer.clone(), value.clone()?))).collect();
            for (name, place) in FIGURES {
                object[name] = line.figure(place).cloned().unwrap_or(Value::Null);
            }
            object
        };
        self.lines.iter().map(object).collect()
    }

    /// Writes it as comma-separated values.
    ///
    /// # Errors
    /// [`CliError`] if that fails.
    pub(super) fn write(&self, below: &Path) -> Result<PathBuf, CliError> {
        let path = below.join(TABLE);
        let line = |out: &mut dyn Write, cells: &[String]| -> io::Result<()> {
            let quoted: Vec<String> = cells.iter().map(|cell| field(cell)).collect();
            writeln!(out, "{}", quoted.join(","))
        };
        let write = || -> io::Result<()> {
            let mut files = Outputs::default();
            files.write(&path, |out| {
                line(out, &self.header())?;
                self.lines.iter().try_for_each(|own| line(out, &own.cells()))
            })?;
            files.commit()
        };
        write().map_err(|error| CliError::writing(&path, &error))?;
        Ok(path)
    }
}

/// A field of comma-separated values (RFC 4180).
fn field(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}
