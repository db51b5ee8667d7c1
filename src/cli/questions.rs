//! What is asked about a model: properties on the command line, in files, or beside the model.

use crate::CliError;
use crate::model_source::LoadedModel;
use clap::{Args, ValueEnum};
use imdp::files;
use imdp::property::{Definitions, Entry, Nature, ParseErrorKind, parse_document, parse_inquiry};
use std::path::{Path, PathBuf};

/// Which properties, and how they are read.
#[derive(Clone, Debug, Default, Args)]
pub(crate) struct QuestionArguments {
    /// Files of properties (.props, .pctl, .prctl). Default: the .props file of the model.
    #[arg(value_name = "PROPERTIES")]
    files: Vec<PathBuf>,

    /// A property in PRISM's syntax, a file of properties, or the name or number of one in the files; repeatable.
    #[arg(short, long = "property", value_name = "PROPERTY")]
    properties: Vec<String>,

    /// Values of constants in the properties, as in K=3,p=0.5; repeatable.
    #[arg(long = "const", value_name = "NAME=VALUE,…")]
    constants: Vec<String>,

    /// What nature does in properties of interval MDPs that name the policy's direction only, such as Pmax.
    #[arg(long, value_enum, value_name = "WHAT")]
    nature: Option<NatureChoice>,
}

/// What nature does, as `--nature` names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum NatureChoice {
    /// It works against the policy: Pmax is Pmaxmin, as for Storm.
    Robust,
    /// It works with the policy: Pmax is Pmaxmax, as for PRISM.
    Cooperative,
}

/// A property and where it was found.
#[derive(Clone, Debug)]
pub(crate) struct Asked {
    pub(crate) entry: Entry,
    source: String,
}

impl Asked {
    /// Why it asks nothing that can be answered.
    pub(crate) fn problem(&self) -> Option<String> {
        let error = self.entry.inquiry.as_ref().err()?;
        let option = match error.kind() {
            ParseErrorKind::Undefined { name } => format!("\n  Or give it one with --const {name}=VALUE."),
            _ => String::new(),
        };
        Some(format!("{}: {error}{option}", self.source))
    }
}

impl QuestionArguments {
    /// Whether nothing is asked but what belongs to the model.
    pub(crate) fn is_empty(&self) -> bool {
        self.files.is_empty() && self.properties.is_empty()
    }

    /// What nature does where a property does not say it.
    pub(crate) fn nature(&self) -> Option<Nature> {
        self.nature.map(|nature| match nature {
            NatureChoice::Robust => Nature::Robust,
            NatureChoice::Cooperative => Nature::Cooperative,
        })
    }

    /// The properties that are asked for.
    ///
    /// # Errors
    /// [`CliError::Input`] if a file is missing or empty, or nothing is asked at all.
    pub(crate) fn read(&self, loaded: &LoadedModel) -> Result<Vec<Asked>, CliError> {
        let mut definitions = Definitions::default();
        for constants in &self.constants {
            definitions.give(constants).map_err(|error| CliError::Input(format!("--const: {error}")))?;
        }
        let mut in_files = vec![];
        for file in &self.files {
            in_files.extend(read_file(file, &mut definitions)?);
        }
        if self.properties.is_empty() {
            return if self.files.is_empty() { beside(loaded, &mut definitions) } else { Ok(in_files) };
        }
        let is_file = |text: &str| {
            let extension = Path::new(text).extension().and_then(|extension| extension.to_str());
            matches!(extension, Some("props" | "pctl" | "prctl"))
        };
        let is_choice = |text: &str| {
            let word = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-' | '.');
            !is_file(text) && !text.is_empty() && text.chars().all(word)
        };
        if self.files.is_empty() && self.properties.iter().any(|text| is_choice(text)) {
            in_files = beside(loaded, &mut definitions)?;
        }
        let mut asked = vec![];
        for text in &self.properties {
            if is_file(text) {
                asked.extend(read_file(Path::new(text), &mut definitions)?);
            } else if is_choice(text) {
                asked.push(choose(text, &in_files)?);
            } else {
                let inquiry = parse_inquiry(text, &definitions);
                let name = None;
                let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
                asked.push(Asked { entry: Entry { name, text, inquiry }, source: "-p".to_owned() });
            }
        }
        Ok(asked)
    }
}

/// The property with this name, or else this number, counted from 1.
fn choose(text: &str, all: &[Asked]) -> Result<Asked, CliError> {
    let named = all.iter().find(|asked| asked.entry.name.as_deref() == Some(text));
    let number = || text.parse::<usize>().ok().and_then(|number| all.get(number.checked_sub(1)?));
    named.or_else(number).cloned().ok_or_else(|| {
        let names: Vec<_> = all.iter().filter_map(|asked| asked.entry.name.as_deref()).collect();
        let names = if names.is_empty() { String::new() } else { format!(", named: {}", names.join(", ")) };
        let count = all.len();
        CliError::Input(format!(
            "-p: found `{text}`; expected a property such as Pmaxmin=? [ F \"goal\" ], a file of properties, or the name or \
             number of one of the {count} properties in the files{names}"
        ))
    })
}

/// The properties that belong to the model.
fn beside(loaded: &LoadedModel, definitions: &mut Definitions) -> Result<Vec<Asked>, CliError> {
    let path = &loaded.properties;
    if path.exists() {
        return read_file(path, definitions);
    }
    let entries = parse_document(&loaded.asks, definitions);
    if !entries.is_empty() {
        let source = "the model's specification";
        return Ok(entries.into_iter().map(|entry| Asked { entry, source: source.to_owned() }).collect());
    }
    Err(CliError::Input(format!(
        "{}: found no such file; expected properties there or with -p, for example -p 'Pmaxmin=? [ F \"goal\" ]'",
        path.display()
    )))
}

fn read_file(path: &Path, definitions: &mut Definitions) -> Result<Vec<Asked>, CliError> {
    let shown = path.display().to_string();
    let text = files::read_text(path).map_err(|error| match files::is_fault_of_input(&error) {
        true => CliError::Input(format!("{shown}: {error}; expected a file of properties")),
        false => CliError::reading(path, &error),
    })?;
    definitions.look_in(path.parent().unwrap_or(Path::new("")));
    let entries = parse_document(&text, definitions);
    definitions.look_in(Path::new(""));
    if entries.is_empty() {
        return Err(CliError::Input(format!("{shown}: found no property; expected at least one")));
    }
    Ok(entries.into_iter().map(|entry| Asked { entry, source: shown.clone() }).collect())
}
