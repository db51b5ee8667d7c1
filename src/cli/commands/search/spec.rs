//! What a search looks for, and among which settings.

use super::cost::Cost;
use crate::CliError;
use crate::commands::sweep::spec::settings;
use dynabs::Diagnostic;
use imdp::files;
use serde::Deserialize;
use serde_json::{Map, Value};
use std::path::{Path, PathBuf};

/// A search: the cheapest of many settings of one model with a wanted bound.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Spec {
    /// Where the JSON Schema of this file is; ignored.
    #[serde(rename = "$schema", default)]
    #[expect(dead_code, reason = "for editors")]
    schema: Option<String>,
    /// What is looked for, and why there; ignored.
    #[serde(default)]
    #[expect(dead_code, reason = "for readers")]
    description: Option<String>,
    /// The model file, relative to this one; absent if it is given on the command line.
    #[serde(default)]
    model: Option<PathBuf>,
    /// An object with a list of values for each JSON pointer into the model file, of which every combination is a setting; or a list
    /// of settings, each an object with a value for each pointer.
    settings: Value,
    /// The lower bound that is wanted. Without it every setting is tried and none chosen.
    #[serde(default)]
    pub(super) wanted: Option<f64>,
    /// What the choice is to have least of.
    #[serde(default)]
    pub(super) cost: Cost,
    /// How samples are used for both, looking and promising.
    #[serde(default)]
    pub(super) samples: Samples,
}

/// How samples are used to look for a setting and to promise something of the one that is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Samples {
    /// Every setting has all samples, and its part of the confidence: all promises hold together (the default).
    #[default]
    Divided,
    /// Settings are looked at with the first half of the samples, and the one that is chosen has the other half and all of the confidence.
    Split,
}

impl Spec {
    /// Reads a spec.
    ///
    /// # Errors
    /// [`CliError::Input`] if it is none.
    pub(super) fn read(path: &Path) -> Result<Self, CliError> {
        let text = files::read_text(path).map_err(|error| CliError::reading(path, &error))?;
        let name = path.display().to_string();
        let spec: Self = serde_json::from_str(&text).map_err(|error| {
            let expected =
                "an object with \"settings\" and, if wanted, \"model\", \"wanted\", \"cost\" and \"samples\"";
            Diagnostic::at("", error.to_string(), expected).in_file(&name)
        })?;
        if let Some(wanted) = spec.wanted.filter(|wanted| !(*wanted > 0.0 && *wanted <= 1.0)) {
            let expected = "a probability above 0 and at most 1";
            return Err(Diagnostic::at("/wanted", wanted.to_string(), expected).in_file(&name).into());
        }
        Ok(spec)
    }

    /// The model file: of the command line, or of the spec.
    ///
    /// # Errors
    /// [`CliError::Input`] if there is none, or if there are two.
    pub(super) fn model(&self, given: Option<&Path>, spec: &Path) -> Result<PathBuf, CliError> {
        let mistake = |found, remedy: &str| {
            let mistake = Diagnostic::at("/model", found, "one model file, here or on the command line");
            Err(mistake.remedy(remedy).in_file(&spec.display().to_string()).into())
        };
        match (given, &self.model) {
            (Some(model), None) => Ok(model.to_path_buf()),
            (None, Some(model)) => Ok(spec.parent().unwrap_or(Path::new("")).join(model)),
            (None, None) => mistake("no model", "Name the model in front of --search, or in \"model\"."),
            (Some(_), Some(_)) => mistake("a second one", "Leave one of them out."),
        }
    }

    /// All settings.
    ///
    /// # Errors
    /// A [`Diagnostic`] if there are none or too many, or if they have another form.
    pub(super) fn settings(&self) -> Result<Vec<Map<String, Value>>, Diagnostic> {
        settings(self.settings.clone())
    }
}
