//! Finding out what a path holds.

use super::{CrosscheckError, PolicyFile, Record, RecordedResult, Reference, Sizes, Values};
use crate::abstraction::compile;
use crate::formats::Format;
use crate::imdp::IntervalMdp;
use crate::property::{Property, parse_properties};
use crate::run_directory::Manifest;
use crate::spec::{Document, Problem};
use serde::Deserialize;
use serde_json::Value;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// The files of a directory that are looked for.
const FILES: &str = "model.dynabs, model.tra, manifest.json, results.json, values.txt or policy.txt";

/// Opens a run directory, the stem or `.tra` of explicit files, a native model, results or a reference.
///
/// # Errors
/// [`CrosscheckError`] if nothing is there, or something malformed.
pub fn open(path: &Path) -> Result<Record, CrosscheckError> {
    let name = path.display().to_string();
    let explicit = PathBuf::from(format!("{name}.tra"));
    let mut record = if path.is_dir() {
        open_directory(path)?
    } else if !path.exists() && explicit.exists() {
        open_model(&explicit)?
    } else if !path.exists() {
        return Err(CrosscheckError::Missing { path: name });
    } else {
        match path.extension().and_then(|extension| extension.to_str()) {
            _ if Format::of_path(path).is_some() => open_model(path)?,
            Some("json") => open_json(path)?,
            _ => {
                let expected = "a directory, or a file that ends in .tra, .drn, .umb, .dynabs or .json";
                return Err(CrosscheckError::Unusable { path: name, found: "another file".into(), expected });
            }
        }
    };
    if record.title.is_empty() {
        record.title.clone_from(&name);
    }
    record.name = name;
    Ok(record)
}

fn open_directory(directory: &Path) -> Result<Record, CrosscheckError> {
    let at = |name: &str| Some(directory.join(name)).filter(|path| path.exists());
    let model = at("model.dynabs").or_else(|| at("model.tra"));
    let mut record = model.as_deref().map(open_model).transpose()?.unwrap_or_default();
    let mut found = model.is_some();
    if let Some(path) = at("manifest.json") {
        read_manifest(&path, &mut record)?;
        found = true;
        if record.model.is_none()
            && let Some(problem) = at("problem.json")
        {
            compile_again(&problem, &mut record)?;
        }
    }
    if let Some(path) = at("results.json") {
        let results = open_json(&path)?;
        record.results = results.results;
        record.sizes = record.sizes.or(results.sizes);
        found = true;
    }
    if let Some(path) = at("values.txt") {
        record.values = Some(parse_values(&path, &read(&path)?)?);
        found = true;
    }
    if let Some(path) = at("policy.txt") {
        let policy = PolicyFile::parse(&read(&path)?);
        record.policy = Some(policy.map_err(|(line, found)| CrosscheckError::Unusable {
            path: format!("{}:{line}", path.display()),
            found: format!("\"{found}\""),
            expected: "`state=action` or `state,step=action`, each state and step once",
        })?);
        found = true;
    }
    if found {
        return Ok(record);
    }
    let path = directory.display().to_string();
    Err(CrosscheckError::Unusable { path, found: "none of the files of a run".into(), expected: FILES })
}

/// A model and the properties beside it.
fn open_model(path: &Path) -> Result<Record, CrosscheckError> {
    let format = Format::of_path(path).unwrap_or(Format::Prism);
    let imported = format.import(path, &mut |_| {})?;
    let warnings = imported.warnings.iter().map(|warning| format!("{}: {warning}", path.display())).collect();
    let model = imported.model;
    let beside = path.with_extension("props");
    let properties = if beside.exists() { read_properties(&beside)? } else { vec![] };
    Ok(Record { notes: warnings, ..Record::of_model("", model, properties) })
}

fn read_properties(path: &Path) -> Result<Vec<Property>, CrosscheckError> {
    let refuse = |error| CrosscheckError::Properties { path: path.display().to_string(), error };
    parse_properties(&read(path)?).map_err(refuse)
}

fn read_manifest(path: &Path, record: &mut Record) -> Result<(), CrosscheckError> {
    let manifest: Manifest = parse(path, &read(path)?, "a manifest written by dynabs-compile")?;
    record.title = format!("{} ({} mode)", manifest.name, manifest.mode);
    if record.sizes.is_none() {
        let Manifest { states, choices, transitions, .. } = manifest;
        record.sizes = Some(Sizes { states, choices, transitions, rows: None, entries: None });
    }
    Ok(())
}

/// Gets the model of a directory without one from the problem that it was made of.
fn compile_again(path: &Path, record: &mut Record) -> Result<(), CrosscheckError> {
    let problem = Problem::from_document(&Document::parse(path, &read(path)?)?)?;
    let refuse = |error| CrosscheckError::Abstraction { path: path.display().to_string(), error };
    let abstraction = compile(&problem, &()).map_err(refuse)?;
    let model: IntervalMdp = abstraction.model;
    record.sizes = Some(Sizes::new(&model));
    record.model = Some(model);
    record.properties = vec![abstraction.property];
    record.notes.push(format!("{}: there is no model beside it, it was compiled again", path.display()));
    Ok(())
}

/// What `dynabs-check solve --json` prints, as far as it is compared.
#[derive(Deserialize)]
struct ResultsFile {
    states: Option<u64>,
    choices: Option<u64>,
    transitions: Option<u64>,
    results: Vec<RecordedResult>,
}

fn open_json(path: &Path) -> Result<Record, CrosscheckError> {
    const EXPECTED: &str = "results of `dynabs-check solve --json` or a reference file";
    let text = read(path)?;
    let value: Value = parse(path, &text, EXPECTED)?;
    if !Reference::is_one(&value) {
        let file: ResultsFile = parse(path, &text, EXPECTED)?;
        let sizes = match (file.states, file.choices, file.transitions) {
            (Some(states), Some(choices), Some(transitions)) => {
                Some(Sizes { states, choices, transitions, rows: None, entries: None })
            }
            _ => None,
        };
        return Ok(Record { sizes, results: file.results, ..Record::default() });
    }
    let reference: Reference = parse(path, &text, EXPECTED)?;
    reference.check().map_err(|found| unusable(path, found, "a complete reference file of version 1"))?;
    Ok(reference.into())
}

impl From<Reference> for Record {
    fn from(reference: Reference) -> Self {
        Self {
            name: reference.name.clone(),
            title: reference.name,
            sizes: Some(reference.sizes),
            digest: Some(reference.model),
            results: reference.results,
            values: Some(reference.values).filter(|values| !values.is_empty()).map(Values::Numbers),
            ..Self::default()
        }
    }
}

fn parse_values(path: &Path, text: &str) -> Result<Values, CrosscheckError> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let is_verdict = |line: &&str| ["true", "false", "undecided"].contains(line);
    if !lines.is_empty() && lines.iter().all(is_verdict) {
        return Ok(Values::Verdicts(lines.into_iter().map(str::to_owned).collect()));
    }
    let numbers = (1..).zip(&lines).map(|(number, line)| {
        line.parse().map_err(|_| CrosscheckError::Unusable {
            path: format!("{}:{number}", path.display()),
            found: format!("\"{line}\""),
            expected: "a number in every line, or true, false or undecided in every line",
        })
    });
    numbers.collect::<Result<_, _>>().map(Values::Numbers)
}

fn parse<T: serde::de::DeserializeOwned>(
    path: &Path,
    text: &str,
    expected: &'static str,
) -> Result<T, CrosscheckError> {
    serde_json::from_str(text).map_err(|error| unusable(path, error.to_string(), expected))
}

fn unusable(path: &Path, found: String, expected: &'static str) -> CrosscheckError {
    CrosscheckError::Unusable { path: path.display().to_string(), found, expected }
}

fn read(path: &Path) -> Result<String, CrosscheckError> {
    fs::read_to_string(path).map_err(|error| match error.kind() {
        io::ErrorKind::InvalidData => unusable(path, "bytes that are not text".into(), "a text file"),
        _ => CrosscheckError::Io { path: path.display().to_string(), error },
    })
}
