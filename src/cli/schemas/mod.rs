//! The published JSON Schemas: of the model file, and of everything that is printed or written as JSON.
//!
//! Objects are closed, so that a field that is not described here makes tests fail. What several schemas share stands in
//! `parts`; each is printed with the parts that it uses, and can be used by itself.

use crate::CliError;
use clap::ValueEnum;
use dynabs::model_file::json_schema;
use serde_json::{Map, Value};

/// What has a schema.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum SchemaName {
    /// The model file, which `dynabs compile` reads.
    #[default]
    #[value(alias = "model")]
    Problem,
    /// The file for `dynabs compile --search`.
    Search,
    /// manifest.json in the directory that `dynabs compile` writes.
    Manifest,
    /// What `dynabs compile --json` prints.
    Compilation,
    /// What `dynabs solve --json` prints.
    Results,
    /// What `dynabs export -o FILE.json` writes.
    Controller,
    /// What `dynabs simulate --json` prints.
    Simulation,
    /// What `dynabs explain --json` prints.
    Explanation,
    /// What `dynabs validate --json` prints.
    Validation,
    /// What `dynabs verify --json` prints.
    Verification,
    /// What `dynabs diff --json` prints.
    Differences,
    /// What `dynabs diff --write-reference` writes.
    Reference,
    /// What `dynabs crosscheck --json` prints.
    Crosscheck,
    /// What `dynabs sweep --json` prints.
    Sweep,
    /// What `dynabs compile --search --json` prints.
    Found,
}

/// Definitions by name, several in a file.
const PARTS: [&str; 4] = [
    include_str!("parts/guarantee.json"),
    include_str!("parts/run.json"),
    include_str!("parts/results.json"),
    include_str!("parts/controller.json"),
];

/// Where definitions stand in a schema.
const DEFINITIONS: &str = "$defs";

impl SchemaName {
    /// The schema without what it shares with others; none for files that users write, whose schemas stand by themselves.
    fn source(self) -> Option<&'static str> {
        Some(match self {
            Self::Problem | Self::Search => return None,
            Self::Manifest => include_str!("manifest.json"),
            Self::Compilation => include_str!("compilation.json"),
            Self::Results => include_str!("results.json"),
            Self::Controller => include_str!("controller.json"),
            Self::Simulation => include_str!("simulation.json"),
            Self::Explanation => include_str!("explanation.json"),
            Self::Validation => include_str!("validation.json"),
            Self::Verification => include_str!("verification.json"),
            Self::Differences => include_str!("differences.json"),
            Self::Reference => include_str!("reference.json"),
            Self::Crosscheck => include_str!("crosscheck.json"),
            Self::Sweep => include_str!("sweep.json"),
            Self::Found => include_str!("found.json"),
        })
    }

    /// The whole schema, with a final newline.
    ///
    /// # Errors
    /// [`CliError::Failure`] if a file of this program is no JSON.
    pub(crate) fn text(self) -> Result<String, CliError> {
        let Some(source) = self.source() else {
            return Ok(if self == Self::Search {
                include_str!("search.json").to_owned()
            } else {
                json_schema()
            });
        };
        let mut schema = parsed(source)?;
        let mut all = Map::new();
        for part in PARTS {
            all.extend(parsed(part)?);
        }
        let mut used = Map::new();
        let mut open = names_in(&schema);
        while let Some(name) = open.pop() {
            if let Some(part) = all.remove(&name) {
                open.extend(references(&part));
                used.insert(name, part);
            }
        }
        if !used.is_empty() {
            used.sort_keys();
            schema.insert(DEFINITIONS.to_owned(), used.into());
        }
        Ok(format!("{:#}\n", Value::Object(schema)))
    }
}

fn parsed(text: &str) -> Result<Map<String, Value>, CliError> {
    serde_json::from_str(text)
        .map_err(|error| CliError::Failure(format!("a schema of this program: {error}")))
}

/// The names of the definitions that a schema, as a map, refers to.
fn names_in(map: &Map<String, Value>) -> Vec<String> {
    let own = map.get("$ref").and_then(Value::as_str);
    let own = own.and_then(|text| text.strip_prefix("#/$defs/")).map(str::to_owned);
    own.into_iter().chain(map.values().flat_map(references)).collect()
}

/// The names of the definitions that a schema refers to.
fn references(schema: &Value) -> Vec<String> {
    match schema {
        Value::Object(map) => names_in(map),
        Value::Array(items) => items.iter().flat_map(references).collect(),
        _ => vec![],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every reference is to a part, and every part is used by some schema.
    #[test]
    fn parts_are_there_and_used() {
        let mut unused: Vec<String> =
            PARTS.iter().flat_map(|part| parsed(part).unwrap()).map(|(name, _)| name).collect();
        for name in SchemaName::value_variants().iter().filter(|name| name.source().is_some()) {
            let schema: Value = serde_json::from_str(&name.text().unwrap()).unwrap();
            for reference in references(&schema) {
                assert!(!schema[DEFINITIONS][&reference].is_null(), "{name:?}: {reference}");
                unused.retain(|part| *part != reference);
            }
        }
        assert_eq!(unused, Vec::<String>::new());
    }
}
