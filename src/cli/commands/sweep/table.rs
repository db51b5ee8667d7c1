//! What came of all jobs, in one table.

use super::figures::{Figure, figure};
use super::job::{Job, Outcome, Purpose};
use crate::CliError;
use imdp::files::Outputs;
use serde_json::{Value, json};
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

/// What is read from the result of a job.
const FIGURES: [Figure; 7] = [
    Figure::Lower,
    Figure::Upper,
    Figure::Satisfied,
    Figure::States,
    Figure::Choices,
    Figure::Transitions,
    Figure::Seconds,
];

impl Line {
    fn state(&self) -> String {
        match &self.outcome {
            Outcome::Done(_) => "done".to_owned(),
            Outcome::Open => "open".to_owned(),
            Outcome::Failed(error) => format!("failed: {error}"),
        }
    }

    fn figure(&self, of: Figure) -> Option<&Value> {
        match &self.outcome {
            Outcome::Done(result) => figure(result, of),
            _ => None,
        }
    }

    /// All columns as text.
    fn cells(&self) -> Vec<String> {
        let text = |value: Option<&Value>| value.map_or(String::new(), Value::to_string);
        let settings = self.values.iter().map(|value| text(value.as_ref()));
        let figures = FIGURES.iter().map(|&of| text(self.figure(of)));
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
            job: job.name(),
            values: pointers.iter().map(|pointer| job.setting.get(pointer).cloned()).collect(),
            outcome: job.outcome(Purpose::Run),
        };
        Self { lines: jobs.iter().map(line).collect(), pointers }
    }

    /// Whether every job has a result.
    pub(super) fn is_complete(&self) -> bool {
        self.lines.iter().all(|line| matches!(line.outcome, Outcome::Done(_)))
    }

    fn header(&self) -> Vec<String> {
        let figures = FIGURES.iter().map(|of| of.name().to_owned());
        let first = std::iter::once("job".to_owned()).chain(self.pointers.iter().cloned());
        first.chain(figures).chain(["state".to_owned()]).collect()
    }

    /// As a table in Markdown.
    pub(super) fn to_markdown(&self) -> String {
        let lines: Vec<_> = self.lines.iter().map(Line::cells).collect();
        markdown(&self.header(), &lines)
    }

    /// The setting with the fewest transitions of those that promise at least so much, in words, and what was not compared.
    pub(super) fn cheapest(&self, wanted: f64) -> String {
        let promises = |line: &&Line| {
            line.figure(Figure::Lower).and_then(Value::as_f64).is_some_and(|lower| lower >= wanted)
        };
        let size = |line: &Line| {
            let size = line.figure(Figure::Transitions).or_else(|| line.figure(Figure::Choices));
            size.and_then(Value::as_u64)
        };
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
            None => format!("none of these settings with a known size has at least {wanted}\n"),
        };
        let without_size = promising().filter(|line| size(line).is_none()).count();
        let without_result = self.lines.iter().filter(|line| line.figure(Figure::Lower).is_none()).count();
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
            for of in FIGURES {
                object[of.name()] = line.figure(of).cloned().unwrap_or(Value::Null);
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
        let lines: Vec<_> = self.lines.iter().map(Line::cells).collect();
        let text = comma_separated(&self.header(), &lines);
        let write = || -> io::Result<()> {
            let mut files = Outputs::default();
            files.write(&path, |out| out.write_all(text.as_bytes()))?;
            files.commit()
        };
        write().map_err(|error| CliError::writing(&path, &error))?;
        Ok(path)
    }
}

/// A table in Markdown.
pub(in crate::commands) fn markdown(header: &[String], lines: &[Vec<String>]) -> String {
    let line = |cells: &[String]| {
        let cells: Vec<String> = cells.iter().map(|cell| cell.replace('|', "\\|")).collect();
        format!("| {} |\n", cells.join(" | "))
    };
    let rule = format!("|{}\n", "---|".repeat(header.len()));
    lines.iter().fold(line(header) + &rule, |text, own| text + &line(own))
}

/// Comma-separated values (RFC 4180).
pub(in crate::commands) fn comma_separated(header: &[String], lines: &[Vec<String>]) -> String {
    let line = |cells: &[String]| {
        let quoted: Vec<String> = cells.iter().map(|cell| field(cell)).collect();
        quoted.join(",") + "\n"
    };
    lines.iter().fold(line(header), |text, own| text + &line(own))
}

fn field(text: &str) -> String {
    match text.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}
