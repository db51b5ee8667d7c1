//! A model file as a JSON document, before anything is known of its meaning.

use super::by_example::by_example;
use super::fields::ModelFile;
use crate::Diagnostic;
use crate::noise::DecimalMark;
use imdp::property::closest_name;
use serde::de::{self, Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};
use serde_json::Value;
use serde_path_to_error::{Path as ErrorPath, Segment};
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// A JSON document and where it came from.
#[derive(Clone, Debug)]
pub struct Document {
    /// The file's name as the user gave it.
    pub name: String,
    /// The directory that relative paths inside the document refer to.
    pub directory: PathBuf,
    /// The content.
    pub value: Value,
}

/// An assignment `/json/pointer=VALUE`; the value is JSON, or else a string.
#[derive(Clone, Debug, PartialEq)]
pub struct SetArgument {
    pointer: String,
    value: Value,
}

impl FromStr for SetArgument {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (pointer, value) = text.split_once('=').ok_or_else(|| {
            format!("found \"{text}\"; expected /json/pointer=VALUE, for example /task/horizon=8")
        })?;
        if !pointer.starts_with('/') {
            return Err(format!(
                "found the pointer \"{pointer}\"; expected one that starts with '/', for example /task/horizon"
            ));
        }
        // What is not JSON is meant as a string: `--set /name=demo`.
        let value = parse_json(value).unwrap_or_else(|_| Value::String(value.to_owned()));
        Ok(Self { pointer: pointer.to_owned(), value })
    }
}

impl Document {
    /// Parses the text of a model file.
    ///
    /// # Errors
    /// A [`Diagnostic`] with line and column if it is not JSON or an object has a key twice.
    pub fn parse(path: &Path, text: &str) -> Result<Self, Diagnostic> {
        let name = path.display().to_string();
        let value = parse_json(text).map_err(|error| {
            let place = format!("{} (line {}, column {})", error.path, error.line, error.column);
            let mistake =
                Diagnostic::at(place.trim_start(), error.message, "a model file in JSON").in_file(&name);
            match is_comment(text, error.line, error.column) {
                true => mistake.remedy("JSON has no comments; \"description\" may say what there is to say."),
                false => mistake,
            }
        })?;
        let directory = path.parent().map(Path::to_path_buf).unwrap_or_default();
        Ok(Self { name, directory, value })
    }

    /// Replaces the value that a pointer names; a missing last key is created.
    ///
    /// # Errors
    /// A [`Diagnostic`] if the parent does not exist or cannot hold such a key.
    pub fn set(&mut self, argument: &SetArgument) -> Result<(), Diagnostic> {
        let pointer = &argument.pointer;
        let error = |found: String, expected: &str| Diagnostic::at(pointer, found, expected);
        let (parent, key) = pointer.rsplit_once('/').unwrap_or_default();
        let key = key.replace("~1", "/").replace("~0", "~");
        match self.value.pointer_mut(parent) {
            Some(Value::Object(map)) => {
                map.insert(key, argument.value.clone());
                Ok(())
            }
            Some(Value::Array(items)) => {
                let length = items.len();
                let slot = key.parse::<usize>().ok().and_then(|index| items.get_mut(index));
                *slot.ok_or_else(|| {
                    error(format!("index \"{key}\""), &format!("an index below {length}, the array's length"))
                })? = argument.value.clone();
                Ok(())
            }
            Some(_) => Err(error(format!("a plain value at {parent}"), "an object or an array there")),
            None => {
                Err(error(format!("nothing at {parent}"), "an existing object or array to set the key in"))
            }
        }
    }

    /// What the model is about, if the file says so.
    pub fn description(&self) -> Option<&str> {
        self.value.pointer("/description").and_then(Value::as_str)
    }

    /// What separates whole numbers from decimals in its samples, and so presumably in others of this noise.
    pub fn decimal_mark(&self) -> DecimalMark {
        match self.value.pointer("/noise/samples/decimal").and_then(Value::as_str) {
            Some(",") => DecimalMark::Comma,
            _ => DecimalMark::Point,
        }
    }

    /// Reads the document as a model file: field names and types.
    ///
    /// # Errors
    /// A [`Diagnostic`] with the JSON pointer of the first unknown field or wrong type.
    pub(super) fn model(&self) -> Result<ModelFile, Diagnostic> {
        serde_path_to_error::deserialize(&self.value).map_err(|error| {
            let place = pointer(error.path());
            let message = error.into_inner().to_string();
            let (found, expected) = found_and_expected(&message);
            let nearest = nearest(&message);
            let expected = by_example(&place, expected);
            let mistake = Diagnostic::at(place, found, expected).in_file(&self.name);
            match nearest {
                Some(field) => mistake.remedy(format!("Did you mean \"{field}\"?")),
                None => mistake,
            }
        })
    }
}

/// The field that was meant, if serde says "unknown field `x`, expected one of …" (or variant) and one of them is near.
fn nearest(message: &str) -> Option<String> {
    let is_name = message.starts_with("unknown field") || message.starts_with("unknown variant");
    let mut names = message.split('`').skip(1).step_by(2).map(str::to_owned);
    let found = names.next().filter(|_| is_name)?;
    closest_name(&found, &names.collect::<Vec<_>>()).map(str::to_owned)
}

/// Splits serde's "unknown field `x`, expected one of …" and "invalid type: …, expected …".
fn found_and_expected(message: &str) -> (String, String) {
    if let Some(field) = message.strip_prefix("missing field ") {
        return (format!("no field {field}"), format!("the field {field}"));
    }
    let (found, expected) = message.split_once(", expected ").unwrap_or((message, "a valid value"));
    let found = ["invalid type: ", "invalid value: ", "invalid length "]
        .iter()
        .find_map(|prefix| found.strip_prefix(prefix))
        .unwrap_or(found);
    (found.to_owned(), expected.to_owned())
}

/// The JSON pointer of a place in a document.
fn pointer(path: &ErrorPath) -> String {
    let segment = |segment: &Segment| match segment {
        Segment::Seq { index } => format!("/{index}"),
        Segment::Map { key } => format!("/{}", key.replace('~', "~0").replace('/', "~1")),
        Segment::Enum { variant } => format!("/{variant}"),
        Segment::Unknown => String::new(),
    };
    path.iter().map(segment).collect()
}

struct JsonError {
    path: String,
    line: usize,
    column: usize,
    message: String,
}

fn parse_json(text: &str) -> Result<Value, JsonError> {
    let mut reader = serde_json::Deserializer::from_str(text);
    let result = serde_path_to_error::deserialize(&mut reader).map(|Strict(value)| value);
    let value = result.map_err(|error| {
        let path = pointer(error.path());
        let inner = error.into_inner();
        JsonError { path, line: inner.line(), column: inner.column(), message: without_position(&inner) }
    })?;
    reader.end().map_err(|error| JsonError {
        path: String::new(),
        line: error.line(),
        column: error.column(),
        message: without_position(&error),
    })?;
    Ok(value)
}

/// Whether a comment of another language begins at a place, the lines and columns of which count from 1.
fn is_comment(text: &str, line: usize, column: usize) -> bool {
    let bytes = text.lines().nth(line.saturating_sub(1)).unwrap_or_default().as_bytes();
    let rest = bytes.get(column.saturating_sub(1)..).unwrap_or_default();
    [&b"//"[..], b"/*", b"#"].iter().any(|start| rest.starts_with(start))
}

fn without_position(error: &serde_json::Error) -> String {
    let text = error.to_string();
    text.split(" at line ").next().unwrap_or(&text).to_owned()
}

/// A JSON value in which no object has a key twice: `serde_json` would keep the last one silently.
struct Strict(Value);

impl<'de> Deserialize<'de> for Strict {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(StrictVisitor).map(Strict)
    }
}

struct StrictVisitor;

impl<'de> Visitor<'de> for StrictVisitor {
    type Value = Value;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_bool<E>(self, value: bool) -> Result<Value, E> {
        Ok(Value::Bool(value))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_u64<E>(self, value: u64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_f64<E>(self, value: f64) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_str<E>(self, value: &str) -> Result<Value, E> {
        Ok(value.into())
    }

    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Null)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Value, A::Error> {
        let mut values = Vec::new();
        while let Some(Strict(value)) = items.next_element()? {
            values.push(value);
        }
        Ok(Value::Array(values))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Value, A::Error> {
        let mut map = serde_json::Map::new();
        while let Some(key) = entries.next_key::<String>()? {
            let Strict(value) = entries.next_value()?;
            if map.contains_key(&key) {
                return Err(de::Error::custom(format!("the key \"{key}\" twice")));
            }
            map.insert(key, value);
        }
        Ok(Value::Object(map))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn document(text: &str) -> Document {
        Document::parse(Path::new("dir/m.json"), text).unwrap()
    }

    #[test]
    fn decimal_marks_are_those_of_the_samples() {
        let mark = |text: &str| Document::parse(Path::new("m.json"), text).unwrap().decimal_mark();
        assert_eq!(mark(r#"{"noise": {"samples": {"file": "a.csv", "decimal": ","}}}"#), DecimalMark::Comma);
        assert_eq!(mark(r#"{"noise": {"samples": {"file": "a.csv"}}}"#), DecimalMark::Point);
    }

    #[test]
    fn set_replaces_and_creates() {
        let mut document = document(r#"{"task": {"horizon": 8}, "list": [1, 2]}"#);
        for (argument, pointer, expected) in [
            ("/task/horizon=\"infinite\"", "/task/horizon", Value::from("infinite")),
            ("/task/threshold=0.5", "/task/threshold", Value::from(0.5)),
            ("/list/1=[3,4]", "/list/1/0", Value::from(3)),
            ("/name=a=b", "/name", Value::from("a=b")),
        ] {
            document.set(&argument.parse().unwrap()).unwrap();
            assert_eq!(document.value.pointer(pointer), Some(&expected), "{argument}");
        }
        for argument in ["/missing/key=1", "/list/7=1", "/task/horizon/deep=1"] {
            let error = document.set(&argument.parse().unwrap()).unwrap_err().to_string();
            assert!(error.starts_with("/") && error.contains("expected"), "{error}");
        }
        assert!("task=1".parse::<SetArgument>().is_err() && "/task".parse::<SetArgument>().is_err());
    }

    #[test]
    fn syntax_errors_have_a_place() {
        let error = Document::parse(Path::new("m.json"), "{\"a\": [1,\n 1e999]}").unwrap_err().to_string();
        assert!(error.starts_with("m.json: /a/1 (line 2, column"), "{error}");
        let error =
            Document::parse(Path::new("m.json"), r#"{"a": {"b": 1, "b": 2}}"#).unwrap_err().to_string();
        assert!(error.contains("\"b\" twice"), "{error}");
        assert!(Document::parse(Path::new("m.json"), "{} {}").is_err());
    }
}
