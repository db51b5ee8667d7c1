//! Samples in two halves: one to look at, one that has not been looked at.

use crate::CliError;
use dynabs::Diagnostic;
use dynabs::model_file::{Document, StatedProblem};
use dynabs::noise::NoiseSamples;
use dynabs::problem::StepNoise;
use imdp::files::Outputs;
use serde_json::{Map, Value, json};
use std::io::Write;
use std::path::Path;

/// What a model file has to be set to for its samples to be those of one half.
pub(super) type Half = Map<String, Value>;

/// Both halves of the samples of a model; where they stand in files, each half becomes a file of its own.
///
/// Drawn samples are independent of each other whatever they are drawn with, so that the other half has another seed. Samples that
/// were measured are taken in their order.
///
/// # Errors
/// [`CliError::Input`] if there are no two samples, or if a setting has its own; [`CliError`] if files cannot be written.
pub(super) fn halves(
    document: &Document,
    settings: &[Map<String, Value>],
    below: &Path,
) -> Result<[Half; 2], CliError> {
    if let Some(pointer) = settings.iter().flat_map(Map::keys).find(|pointer| pointer.starts_with("/noise")) {
        let expected = "the same samples for every setting, because the search splits them";
        let mistake = Diagnostic::at(format!("/settings{pointer}"), "noise of its own", expected);
        return Err(mistake
            .remedy("Leave it out, or divide the confidence: \"samples\": \"divided\".")
            .into());
    }
    let stated = document.stated()?;
    let noise = match &stated {
        StatedProblem::Targets(problem) => problem.noise().samples(),
        StatedProblem::Inputs(problem) => problem.noise().samples().map(|samples| &samples.noise),
    };
    let noise = noise.ok_or_else(|| {
        Diagnostic::at(
            "/samples",
            "\"split\", where the noise is known",
            "\"divided\", for there are no samples to split",
        )
    })?;
    match &noise.of_one_step {
        StepNoise::Gaussian(_) => drawn(document),
        StepNoise::Samples(samples) => measured(samples, document, below),
        StepNoise::Unknown => measured(&noise.samples, document, below),
    }
}

/// Half of the draws each.
fn drawn(document: &Document) -> Result<[Half; 2], CliError> {
    let number = |pointer| document.value.pointer(pointer).and_then(Value::as_u64).unwrap_or(0);
    let (count, seed) = (number("/noise/count"), number("/noise/seed"));
    let (first, second) = parts(count)?;
    let half = |count: u64, seed: u64| {
        Map::from_iter([("/noise/count".to_owned(), count.into()), ("/noise/seed".to_owned(), seed.into())])
    };
    Ok([half(first, seed), half(second, seed ^ 1)])
}

/// Half of the rows each.
fn measured(samples: &NoiseSamples, document: &Document, below: &Path) -> Result<[Half; 2], CliError> {
    let (first, _) = parts(samples.len() as u64)?;
    let numbers = first as usize * samples.dimension();
    let (look, promise) = samples.values().split_at(numbers);
    let half = |name: &str, values: &[f64]| -> Result<Half, CliError> {
        let path = below.join(name);
        let line = |row: &[f64]| row.iter().map(f64::to_string).collect::<Vec<_>>().join(",") + "\n";
        let text: String = values.chunks(samples.dimension()).map(line).collect();
        let mut files = Outputs::default();
        files
            .write(&path, |out| out.write_all(text.as_bytes()))
            .and_then(|()| files.commit())
            .and_then(|()| path.canonicalize())
            .map_err(|error| CliError::writing(&path, &error))
            .map(|path| {
                let of = document.value.pointer("/noise/samples/of").cloned().unwrap_or(Value::Null);
                Map::from_iter([("/noise/samples".to_owned(), json!({"file": path, "of": of}))])
            })
    };
    Ok([half("look.csv", look)?, half("promise.csv", promise)?])
}

/// Two halves of a number; the second one has the odd one.
fn parts(count: u64) -> Result<(u64, u64), Diagnostic> {
    match count {
        0 | 1 => Err(Diagnostic::at("/samples", format!("\"split\" and {count} samples"), "at least two")),
        _ => Ok((count / 2, count - count / 2)),
    }
}
