//! A model file as the user gives it: the text, with what options change.

use super::CliError;
use dynabs::model_file::{Document, SetArgument};
use imdp::files;
use serde_json::Value;
use std::io;
use std::path::Path;

/// The text of a model file.
///
/// # Errors
/// [`CliError`] if there is none.
pub(super) fn read_model(path: &Path) -> Result<String, CliError> {
    files::read_text(path).map_err(|error| {
        let shown = path.display();
        match error.kind() {
            io::ErrorKind::NotFound => CliError::Input(format!(
                "{shown}: found no such file; expected a model file\n  dynabs-compile --init {shown} writes one to start from."
            )),
            io::ErrorKind::InvalidData | io::ErrorKind::IsADirectory => {
                CliError::Input(format!("{shown}: found something that is not text; expected a model file in JSON"))
            }
            _ => CliError::reading(path, &error),
        }
    })
}

/// Parses the file and applies `--set` and `--seed`; returns the document and what to note about it.
///
/// # Errors
/// [`CliError`] if it is no JSON, or has no place for what is set.
pub(super) fn configured(
    path: &Path,
    source: &str,
    set: &[String],
    seed: Option<u64>,
) -> Result<(Document, Vec<String>), CliError> {
    let mut document = Document::parse(path, source)?;
    for text in set {
        let argument: SetArgument =
            text.parse().map_err(|error| CliError::Input(format!("--set: {error}")))?;
        let name = format!("{} with --set", document.name);
        document.set(&argument).map_err(|error| error.in_file(&name))?;
    }
    let mut notes = Vec::new();
    if let Some(seed) = seed {
        match document.value.pointer_mut("/noise") {
            Some(Value::Object(noise)) if noise.contains_key("gaussian") => {
                noise.insert("seed".to_owned(), seed.into());
            }
            _ => notes.push("--seed has no effect: the noise samples come from a file".to_owned()),
        }
    }
    Ok((document, notes))
}
