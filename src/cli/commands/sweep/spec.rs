//! What a sweep varies.

use crate::CliError;
use dynabs::Diagnostic;
use dynabs::model_file::{Document, SetArgument, StatedProblem};
use dynabs::problem::StepNoise;
use imdp::files;
use serde::Deserialize;
use serde_json::{Map, Value, json};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// So many jobs at most: their number is in the names of their directories.
const MOST_JOBS: usize = 9999;

/// The part of a model file that says how many settings are compiled with the same samples.
const SETTINGS_OF_SAMPLES: &str = "/probabilities/sweep";

/// Where it stands.
const PROBABILITIES: &str = "/probabilities";

/// A file that describes a sweep.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Spec {
    /// The model file, seen from this one.
    model: PathBuf,
    /// An object with a list of values for each JSON pointer, of which every combination is a setting; or a list of settings, each
    /// an object with a value for each pointer.
    settings: Value,
    /// Whether the promises of all settings hold together.
    #[serde(default = "together")]
    together: bool,
}

fn together() -> bool {
    true
}

/// Settings of a model: those of a sweep, or those that a search may try.
pub(in crate::commands) struct Sweep {
    /// The model file: an absolute path.
    pub(in crate::commands) model: PathBuf,
    /// Per setting, the values of JSON pointers in it.
    pub(in crate::commands) settings: Vec<Map<String, Value>>,
    /// Whether every setting but those without samples has its part of what all may fail with.
    pub(super) together: bool,
    /// Per setting, what is known of it before it is compiled.
    pub(in crate::commands) extents: Vec<Extent>,
}

/// How large a problem is.
#[derive(Clone, Copy, Debug)]
pub(in crate::commands) struct Extent {
    /// The cells of the partition.
    pub(in crate::commands) cells: u64,
    /// The samples of the noise: of grouped steps if only these are known, else of single ones. None if it is known.
    pub(in crate::commands) samples: Option<u64>,
    /// Whether actions are inputs.
    pub(in crate::commands) takes_inputs: bool,
}

impl Extent {
    fn new(problem: &StatedProblem) -> Self {
        let (grid, noise, group_steps) = match problem {
            StatedProblem::Targets(problem) => {
                (problem.grid(), problem.noise().samples(), problem.group_steps() as u64)
            }
            StatedProblem::Inputs(problem) => {
                (problem.grid(), problem.noise().samples().map(|samples| &samples.noise), 1)
            }
        };
        let number = noise.map(|noise| match noise.of_one_step {
            StepNoise::Unknown => noise.samples.len() as u64,
            _ => noise.samples.len() as u64 * group_steps,
        });
        let takes_inputs = matches!(problem, StatedProblem::Inputs(_));
        Self { cells: grid.num_cells().into(), samples: number, takes_inputs }
    }
}

impl Sweep {
    /// Reads a spec and tries all of its settings on the model.
    ///
    /// # Errors
    /// [`CliError::Input`] if it is none, or if a setting makes no problem.
    pub(super) fn read(path: &Path) -> Result<Self, CliError> {
        let name = path.display().to_string();
        let text = files::read_text(path).map_err(|error| CliError::reading(path, &error))?;
        let spec: Spec = serde_json::from_str(&text).map_err(|error| {
            let expected = "an object with \"model\" and \"settings\", and \"together\" if wanted";
            Diagnostic::at("", error.to_string(), expected).in_file(&name)
        })?;
        let model = path.parent().unwrap_or(Path::new("")).join(spec.model);
        let settings = settings(spec.settings).map_err(|error| error.in_file(&name))?;
        Self::of_model(&model, settings, spec.together)
    }

    /// Tries settings on a model; if all promises are to hold together, each gets its part of what all may fail with.
    ///
    /// # Errors
    /// [`CliError::Input`] if a setting makes no problem.
    pub(in crate::commands) fn of_model(
        model: &Path,
        settings: Vec<Map<String, Value>>,
        together: bool,
    ) -> Result<Self, CliError> {
        let model = model.canonicalize().map_err(|error| CliError::reading(model, &error))?;
        let mut sweep = Self { model, settings, together, extents: vec![] };
        sweep.try_settings()?;
        Ok(sweep)
    }

    /// The model file with a setting.
    ///
    /// # Errors
    /// [`CliError::Input`] if that is not possible.
    pub(in crate::commands) fn document(&self, setting: &Map<String, Value>) -> Result<Document, CliError> {
        let mut document = self.original()?;
        apply(&mut document, setting)?;
        Ok(document)
    }

    /// The name of the model.
    ///
    /// # Errors
    /// [`CliError::Input`] if its file cannot be read any more.
    pub(in crate::commands) fn name(&self) -> Result<String, CliError> {
        let original = self.original()?;
        Ok(original.value.pointer("/name").and_then(Value::as_str).unwrap_or_default().to_owned())
    }

    fn original(&self) -> Result<Document, CliError> {
        let text = files::read_text(&self.model).map_err(|error| CliError::reading(&self.model, &error))?;
        Ok(Document::parse(&self.model, &text)?)
    }

    /// Makes sure that every setting is a problem, and gives each its part of what all may fail with.
    fn try_settings(&mut self) -> Result<(), CliError> {
        let original = self.original()?;
        let others = settings_of(&original);
        let number = self.settings_of_samples(&original)?;
        for (i, setting) in self.settings.iter_mut().enumerate() {
            let mut document = original.clone();
            document.name = format!("{} with setting {}", original.name, i + 1);
            apply(&mut document, setting)?;
            let extent = Extent::new(&document.stated()?);
            self.extents.push(extent);
            // What the model says of other settings counts beside these; what a setting says of them all does not.
            let stated = settings_of(&document);
            if self.together && number > 1 && stated == others && extent.samples.is_some() {
                let share = Value::from(stated.unwrap_or(1).saturating_mul(number as u64));
                let (pointer, share) = match document.value.pointer(PROBABILITIES) {
                    Some(Value::Object(_)) => (SETTINGS_OF_SAMPLES, share),
                    _ => (PROBABILITIES, json!({"sweep": share})),
                };
                document.set(&argument(pointer, &share)?)?;
                // Where nothing depends on samples there is nothing to share.
                if document.stated().is_ok() {
                    setting.insert(pointer.to_owned(), share);
                }
            }
        }
        Ok(())
    }
}

/// The number of settings that a document says are compiled with its samples.
fn settings_of(document: &Document) -> Option<u64> {
    document.value.pointer(SETTINGS_OF_SAMPLES).and_then(Value::as_u64)
}

fn apply(document: &mut Document, setting: &Map<String, Value>) -> Result<(), CliError> {
    for (pointer, value) in setting {
        document.set(&argument(pointer, value)?)?;
    }
    Ok(())
}

/// What no event depends on where a plan is followed: settings that differ in nothing else share nothing.
const FREE: [&str; 2] = ["/stabilizer/track", "/stabilizer/abstract_input"];

impl Sweep {
    /// How many settings have events of their own: those that differ in more than a plan and what is left beside it.
    fn settings_of_samples(&self, original: &Document) -> Result<usize, CliError> {
        let mut different: BTreeSet<String> = BTreeSet::new();
        for setting in &self.settings {
            let mut document = original.clone();
            apply(&mut document, setting)?;
            let follows_plan = document.value.pointer(FREE[0]).is_some_and(|plan| !plan.is_null());
            let kept: Map<String, Value> = setting
                .iter()
                .filter(|(pointer, _)| !(follows_plan && is_free(pointer)))
                .map(|(p, v)| (p.clone(), v.clone()))
                .collect();
            different.insert(format!("{follows_plan} {}", Value::Object(kept)));
        }
        Ok(different.len())
    }
}

/// Whether a JSON pointer is one of [`FREE`], or one of a part of these.
fn is_free(pointer: &str) -> bool {
    let below =
        |free| pointer.strip_prefix(free).is_some_and(|rest: &str| rest.is_empty() || rest.starts_with('/'));
    FREE.into_iter().any(below)
}

/// `/pointer=value`, as `--set` takes it.
pub(super) fn text(pointer: &str, value: &Value) -> String {
    format!("{pointer}={value}")
}

fn argument(pointer: &str, value: &Value) -> Result<SetArgument, CliError> {
    text(pointer, value).parse().map_err(|error| CliError::Input(format!("/settings: {error}")))
}

/// All combinations of lists of values, or a list as it is.
///
/// # Errors
/// A [`Diagnostic`] if it is neither, or if there are none or too many.
pub(in crate::commands) fn settings(settings: Value) -> Result<Vec<Map<String, Value>>, Diagnostic> {
    let expected = "an object with a list of values for every JSON pointer, or a list of objects with one value for each";
    let all = match settings {
        Value::Object(lists) => {
            let mut all = vec![Map::new()];
            for (pointer, values) in lists {
                let Value::Array(values) = values else {
                    return Err(Diagnostic::at(
                        format!("/settings{pointer}"),
                        values.to_string(),
                        "a list of values",
                    ));
                };
                if all.len().saturating_mul(values.len()) > MOST_JOBS {
                    return Err(too_many());
                }
                let with = |setting: &Map<String, Value>, value: &Value| {
                    let mut setting = setting.clone();
                    setting.insert(pointer.clone(), value.clone());
                    setting
                };
                all =
                    all.iter().flat_map(|setting| values.iter().map(|value| with(setting, value))).collect();
            }
            all
        }
        Value::Array(list) => {
            let object = |value| match value {
                Value::Object(setting) => Ok(setting),
                other => Err(Diagnostic::at("/settings", other.to_string(), expected)),
            };
            list.into_iter().map(object).collect::<Result<_, _>>()?
        }
        other => return Err(Diagnostic::at("/settings", other.to_string(), expected)),
    };
    match all.len() {
        0 => Err(Diagnostic::at("/settings", "no setting", "at least one")),
        1..=MOST_JOBS => Ok(all),
        _ => Err(too_many()),
    }
}

fn too_many() -> Diagnostic {
    Diagnostic::at("/settings", format!("more than {MOST_JOBS} settings"), format!("at most {MOST_JOBS}"))
        .remedy("Write several sweeps.")
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn objects_are_combined_and_lists_are_not() {
        let all = settings(json!({"/a": [1, 2], "/b": ["x", "y", "z"]})).unwrap();
        assert_eq!(all.len(), 6);
        assert_eq!(Value::Object(all[1].clone()), json!({"/a": 1, "/b": "y"}));
        let listed = settings(json!([{"/a": 1}, {"/b": 2}])).unwrap();
        assert_eq!(Value::Object(listed[1].clone()), json!({"/b": 2}));
        for wrong in [json!([]), json!({"/a": []}), json!({"/a": 1}), json!([1]), json!(3)] {
            assert!(settings(wrong.clone()).is_err(), "{wrong}");
        }
        let many: Vec<u32> = (0..101).collect();
        assert!(settings(json!({"/a": many, "/b": many})).is_err());
    }

    #[test]
    fn pointers_are_free_as_a_whole() {
        assert!(
            ["/stabilizer/track", "/stabilizer/track/0/to", "/stabilizer/abstract_input/upper"]
                .into_iter()
                .all(is_free)
        );
        assert!(
            !["/stabilizer", "/stabilizer/tracks", "/stabilizer/track~1", "/x/stabilizer/track"]
                .into_iter()
                .any(is_free)
        );
    }
}
