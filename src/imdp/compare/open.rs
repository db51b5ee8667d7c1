//! Finding out what a path holds.

use super::{CompareError, PolicyFile, Record, RecordedResult, Reference, ResultsFile, Sizes};
use crate::files;
use crate::formats::{Format, Held, LineError, StateValues, bmdp};
use crate::property::{Definitions, Entry, Inquiry, Property, parse_document};
use serde_json::Value;
use std::io;
use std::path::Path;

/// The files of a directory that are looked for.
const FILES: &str = "model.dynabs, model.tra, results.json, values.txt or policy.txt";

/// Opens a run directory, the stem or `.tra` of explicit files, a native model, results or a reference.
///
/// # Errors
/// [`CompareError`] if nothing is there, or something malformed.
pub fn open(path: &Path) -> Result<Record, CompareError> {
    let name = path.display().to_string();
    let mut record = match Held::at(path) {
        Held::Directory => open_directory(path)?,
        // A .txt file may be anything; those of bmdp-tool begin with a number.
        Held::Model(format, path) if format != Format::Bmdp || bmdp::begins(&path) => open_model(&path)?,
        Held::Json => open_json(path)?,
        Held::Nothing => return Err(CompareError::Missing { path: name }),
        Held::Model(..) | Held::Other => {
            let endings = Format::endings(Format::all());
            let expected = format!("a directory, or a file that ends in {endings}, or in .json");
            return Err(CompareError::Unusable { path: name, found: "another file".into(), expected });
        }
    };
    if record.title.is_empty() {
        record.title.clone_from(&name);
    }
    record.name = name;
    Ok(record)
}

fn open_directory(directory: &Path) -> Result<Record, CompareError> {
    collect(directory)?.ok_or_else(|| CompareError::Unusable {
        path: directory.display().to_string(),
        found: "none of the files of a run".into(),
        expected: FILES.to_owned(),
    })
}

/// What the model, the results, the values and the policy of a directory say; `None` if it has none of them.
///
/// # Errors
/// [`CompareError`] if one of them is malformed.
pub fn collect(directory: &Path) -> Result<Option<Record>, CompareError> {
    let at = |name: &str| Some(directory.join(name)).filter(|path| path.exists());
    let model = at("model.dynabs").or_else(|| at("model.tra"));
    let mut record = model.as_deref().map(open_model).transpose()?.unwrap_or_default();
    let mut found = model.is_some();
    if let Some(path) = at("results.json") {
        let results = open_json(&path)?;
        record.results = results.results;
        record.sizes = record.sizes.or(results.sizes);
        found = true;
    }
    if let Some(path) = at("values.txt") {
        record.values = Some(StateValues::read(&read(&path)?).map_err(|error| in_line(&path, error))?);
        found = true;
    }
    if let Some(path) = at("policy.txt") {
        record.policy = Some(PolicyFile::parse(&read(&path)?).map_err(|error| in_line(&path, error))?);
        found = true;
    }
    Ok(found.then_some(record))
}

/// A model and the properties beside it.
fn open_model(path: &Path) -> Result<Record, CompareError> {
    let format = Format::of_path(path).unwrap_or(Format::Prism);
    let imported = format.import(path, &())?;
    let warning = |warning| format!("{}: {warning}", path.display());
    let mut notes: Vec<String> = imported.warnings.iter().map(warning).collect();
    let model = imported.model;
    let beside = path.with_extension("props");
    let mut properties = if beside.exists() { read_properties(&beside)? } else { vec![] };
    // Several models may share a file of properties, and not all of them have everything that it speaks of.
    properties.retain(|property| {
        let query = property.resolve(model.kind()).and_then(|objective| objective.query(&model));
        if let Err(error) = &query {
            notes.push(format!("{}: {property}: {error}; it is not asked here", path.display()));
        }
        query.is_ok()
    });
    Ok(Record { notes, ..Record::of_model("", model, properties) })
}

fn read_properties(path: &Path) -> Result<Vec<Property>, CompareError> {
    let refuse = |error| CompareError::Properties { path: path.display().to_string(), error };
    let entries = parse_document(&read(path)?, &mut Definitions::default());
    let single = |entry: Entry| match entry.inquiry {
        Ok(Inquiry::Probability(property)) => Some(Ok(property)),
        // What is not about one probability is not compared.
        Ok(Inquiry::Compound(_)) => None,
        Err(error) => Some(Err(refuse(error))),
    };
    entries.into_iter().filter_map(single).collect()
}

fn open_json(path: &Path) -> Result<Record, CompareError> {
    const EXPECTED: &str = "results in JSON or a reference file";
    let text = read(path)?;
    let value: Value = parse(path, &text, EXPECTED)?;
    if !Reference::is_one(&value) {
        let file: ResultsFile<RecordedResult> = parse(path, &text, EXPECTED)?;
        let sizes = match (file.states, file.choices, file.transitions) {
            (Some(states), Some(choices), Some(transitions)) => {
                Some(Sizes { states, choices, transitions, rows: None, entries: None })
            }
            _ => None,
        };
        // Formulas have no value, and infinite ones have no number: they are not compared.
        let is_finite = |result: &RecordedResult| {
            [result.lower, result.upper].iter().all(|bound| bound.is_some_and(f64::is_finite))
        };
        let results = file.results.into_iter().filter(is_finite).collect();
        return Ok(Record { sizes, results, ..Record::default() });
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
            values: Some(reference.values).filter(|values| !values.is_empty()).map(StateValues::Numbers),
            ..Self::default()
        }
    }
}

fn in_line(path: &Path, LineError { line, found, expected }: LineError) -> CompareError {
    let path = format!("{}:{line}", path.display());
    CompareError::Unusable { path, found: format!("\"{found}\""), expected: expected.to_owned() }
}

fn parse<T: serde::de::DeserializeOwned>(
    path: &Path,
    text: &str,
    expected: &'static str,
) -> Result<T, CompareError> {
    serde_json::from_str(text).map_err(|error| unusable(path, error.to_string(), expected))
}

fn unusable(path: &Path, found: String, expected: &'static str) -> CompareError {
    CompareError::Unusable { path: path.display().to_string(), found, expected: expected.to_owned() }
}

fn read(path: &Path) -> Result<String, CompareError> {
    files::read_text(path).map_err(|error| match error.kind() {
        io::ErrorKind::InvalidData => unusable(path, "bytes that are not text".into(), "a text file"),
        _ => CompareError::Io { path: path.display().to_string(), error },
    })
}
