//! Writing all files of a run.

use super::manifest::Manifest;
use super::staging::{RunDirectoryError, Staging};
use crate::abstraction::Abstraction;
use crate::formats::native;
use crate::formats::prism::{MAX_COUNT, TraWriter, write_lab, write_sta};
use crate::progress::Progress;
use crate::spec::{Document, Problem};
use std::io::Write;
use std::path::Path;

/// What to write and what may be replaced.
#[derive(Clone, Copy, Debug, Default)]
pub struct WriteOptions {
    /// Leave out `model.tra`, `model.sta` and `model.lab`.
    pub no_tra: bool,
    /// Replace an earlier run.
    pub force: bool,
}

/// The name of the native model in a run's directory.
pub const NATIVE_MODEL: &str = "model.dynabs";

/// The name of the problem in a run's directory.
pub(super) const PROBLEM: &str = "problem.json";

/// The name of the noise samples in a run's directory.
const NOISE: &str = "noise.csv";

/// Writes the directory `target`: PRISM's files, the native model, the property, the problem, the samples, the manifest.
///
/// Returns the manifest with the list of files. Either all files appear or none.
///
/// # Errors
/// [`RunDirectoryError`] if the place is taken, the disk too small, the model beyond PRISM, or writing fails.
pub fn write_run(
    target: &Path,
    document: &Document,
    problem: &Problem,
    abstraction: &Abstraction,
    mut manifest: Manifest,
    options: WriteOptions,
    progress: &dyn Progress,
) -> Result<Manifest, RunDirectoryError> {
    let model = &abstraction.model;
    let size = model.size();
    if !options.no_tra && size.states.max(size.choices).max(size.transitions) > MAX_COUNT {
        return Err(RunDirectoryError::TooLargeForPrism {
            states: size.states,
            choices: size.choices,
            transitions: size.transitions,
        });
    }
    let mut staging = Staging::begin(target, options.force)?;
    if !options.no_tra {
        let tra = TraWriter::new(model);
        staging.require_space(tra.bytes())?;
        progress.start("model.tra", tra.bytes());
        staging.write("model.tra", |out| tra.write(out, progress))?;
        progress.finish();
        staging.write("model.sta", |out| write_sta(model, out))?;
        staging.write("model.lab", |out| write_lab(model, out))?;
    }
    staging.write(NATIVE_MODEL, |out| native::write(model, out))?;
    staging.write("model.props", |out| writeln!(out, "{}", abstraction.property))?;
    staging.write(PROBLEM, |out| out.write_all(self_contained(document, problem).as_bytes()))?;
    staging.write(NOISE, |out| match &problem.noise.file {
        Some((_, text)) => out.write_all(text.as_bytes()),
        None => out.write_all(problem.noise.samples.to_csv().as_bytes()),
    })?;
    manifest.outputs = staging.files().to_vec();
    staging.commit(&manifest)?;
    Ok(manifest)
}

/// The model file after `--set`, referring to the samples beside it.
fn self_contained(document: &Document, problem: &Problem) -> String {
    let mut value = document.value.clone();
    if problem.noise.file.is_some()
        && let Some(file) = value.pointer_mut("/noise/samples/file")
    {
        *file = NOISE.into();
    }
    // A JSON value always has a text.
    format!("{value:#}\n")
}
