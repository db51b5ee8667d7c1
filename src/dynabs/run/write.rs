//! Writing all files of a run.

use super::appearance::{NATIVE_MODEL, NOISE, PROBLEM, SOLUTION};
use super::manifest::Manifest;
use super::row_states::RowStatesReport;
use super::solution::is_final;
use super::staging::{RunDirectoryError, Staging};
use crate::abstraction::Abstraction;
use crate::model_file::Document;
use crate::problem::{Objective, Problem, SampledNoise};
use imdp::formats::row_states::RowStates;
use imdp::formats::umb::Compression;
use imdp::formats::{Encoding, Format, ModelWriter, native};
use imdp::model::IntervalMdp;
use imdp::progress::Progress;
use imdp::property::Property;
use imdp::solution_file;
use imdp::solver::Solution;
use serde_json::Value;
use std::io::{self, Write};
use std::path::Path;

/// What to write and what may be replaced.
#[derive(Clone, Debug, Default)]
pub struct WriteOptions<'a> {
    /// The formats to write the model in, besides the native one.
    pub formats: Vec<Format>,
    /// How choices are written in these formats; files with row states are called `rows` and not `model`.
    pub encoding: Encoding,
    /// Replace an earlier run.
    pub force: bool,
    /// The solution of the task, if it is known: with its policy it is kept, so that nobody need solve again.
    pub solution: Option<&'a Solution>,
}

/// Writes the directory `target`: the model in the formats asked for, the native model, the property, the problem, the samples, the manifest.
///
/// Returns the manifest with the list of files. Either all files appear or none.
///
/// # Errors
/// [`RunDirectoryError`] if the place is taken, the disk too small, the model beyond a format, or writing fails.
pub fn write_run(
    target: &Path,
    document: &Document,
    problem: &Problem,
    abstraction: &Abstraction,
    mut manifest: Manifest,
    options: WriteOptions<'_>,
    progress: &dyn Progress,
) -> Result<Manifest, RunDirectoryError> {
    let model = &abstraction.model;
    let asked = std::slice::from_ref(&abstraction.property);
    let (mut staging, row_states) = begin_with_model(target, model, asked, &options, progress)?;
    manifest.row_states = row_states;
    staging.write(NATIVE_MODEL, |out| native::write(model, out))?;
    let property = abstraction.property.to_string();
    write_solution(&mut staging, (NATIVE_MODEL, &property), options.solution)?;
    staging.write("model.props", |out| {
        writeln!(out, "{}", abstraction.property)?;
        abstraction.costs.iter().try_for_each(|question| writeln!(out, "{question}"))
    })?;
    let samples = problem.noise().samples();
    let is_file = samples.and_then(SampledNoise::file).is_some();
    let value = self_contained(with_automaton(document.value.clone(), problem.objective()), is_file);
    staging.write(PROBLEM, |out| out.write_all(value.as_bytes()))?;
    if let Some(samples) = samples {
        staging.write(NOISE, |out| write_samples(samples, out))?;
    }
    manifest.outputs = staging.files().to_vec();
    staging.commit(&manifest)?;
    Ok(manifest)
}

/// Begins a directory with the model in the formats asked for, but for the native one, and what is asked of it if rows
/// become states; nothing is begun if the model has no such format.
pub(super) fn begin_with_model(
    target: &Path,
    model: &IntervalMdp,
    asked: &[Property],
    options: &WriteOptions<'_>,
    progress: &dyn Progress,
) -> Result<(Staging, Option<RowStatesReport>), RunDirectoryError> {
    let encoded = match options.encoding {
        Encoding::Rows => Some(RowStates::new(model)?),
        Encoding::Plain => None,
    };
    let (stem, explicit) = encoded.as_ref().map_or(("model", model), |encoded| ("rows", &encoded.model));
    let formats = Format::ALL.into_iter().filter(|format| options.formats.contains(format));
    // The native file is always written, with all its choices.
    let formats = formats.filter(|&format| format != Format::Native);
    let writers: Vec<_> = formats
        .map(|format| ModelWriter::new(explicit, format, Compression::Gzip))
        .collect::<Result<_, _>>()?;
    let mut staging = Staging::begin(target, options.force)?;
    for writer in &writers {
        staging.require_space(writer.bytes())?;
        for (i, extension) in writer.extensions().iter().enumerate() {
            let name = format!("{stem}.{extension}");
            progress.start(&name, if i == 0 { writer.bytes() } else { 0 });
            staging.write(&name, |out| writer.write(extension, out, progress))?;
            progress.finish();
        }
        for file in writer.reward_files() {
            staging.write(&format!("{stem}{}", file.suffix), |out| file.write(out))?;
        }
    }
    let Some(encoded) = encoded.as_ref().filter(|_| !writers.is_empty()) else {
        return Ok((staging, None));
    };
    let properties: Vec<String> =
        asked.iter().map(|property| encoded.translate(property)).collect::<Result<_, _>>()?;
    staging.write("rows.props", |out| properties.iter().try_for_each(|text| writeln!(out, "{text}")))?;
    let first = properties.into_iter().next().unwrap_or_default();
    Ok((staging, Some(RowStatesReport::new(encoded, first))))
}

/// Keeps a solution of what one of the files that are written says, if it is as good as another computation would be.
pub(super) fn write_solution(
    staging: &mut Staging,
    (file, property): (&str, &str),
    solution: Option<&Solution>,
) -> Result<(), RunDirectoryError> {
    let Some(solution) = solution.filter(|solution| is_final(solution)) else { return Ok(()) };
    let of = staging.files().iter().find(|written| written.name == file);
    let sha256 = of.map_or_else(String::new, |written| written.sha256.clone());
    staging.write(SOLUTION, |out| solution_file::write(property, &sha256, solution, out))
}

/// A model file that has the text of its automaton in itself.
pub(super) fn with_automaton(mut value: Value, objective: &Objective) -> Value {
    if let Objective::Automaton(task) = objective
        && let (Some(text), Some(field)) = (task.source(), value.pointer_mut("/task/automaton"))
    {
        *field = serde_json::json!({"hoa": text});
    }
    value
}

/// The samples as they were read, or drawn.
pub(super) fn write_samples(noise: &SampledNoise, out: &mut dyn Write) -> io::Result<()> {
    match noise.file() {
        Some((_, text)) => out.write_all(text.as_bytes()),
        None => out.write_all(noise.samples.to_csv().as_bytes()),
    }
}

/// The model file after `--set`, referring to the samples beside it if they come from a file.
pub(super) fn self_contained(mut value: Value, is_file: bool) -> String {
    if let (true, Some(file)) = (is_file, value.pointer_mut("/noise/samples/file")) {
        *file = NOISE.into();
    }
    // A JSON value always has a text.
    format!("{value:#}\n")
}
