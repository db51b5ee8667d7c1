//! `dynabs-check convert`: from one format to another.

use crate::choices::format_names;
use crate::model_source::{LoadedModel, load, model_help};
use crate::{Bars, CliError, EncodingName, NamesChoice, print, thousands, warn};
use clap::Args;
use imdp::files::{self, Outputs};
use imdp::formats::prism::{ExplicitFiles, RAISED_LOWER_BOUND};
use imdp::formats::row_states::{EncodingError, RowStates};
use imdp::formats::umb::Compression;
use imdp::formats::{Format, ModelWriter, WriteError, identifiers, netcdf};
use imdp::model::IntervalMdp;
use imdp::progress::Progress;
use imdp::property::{Definitions, Entry, Inquiry, QueryKind, parse_document};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Arc;

/// What to convert into what.
#[derive(Clone, Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct ConvertArguments {
    #[arg(help = model_help())]
    input: PathBuf,

    /// The file to write; its extension tells the format. With .tra, a .sta and a .lab file are written beside it; where
    /// INPUT has properties, a .props file as well.
    output: PathBuf,

    /// The format, whatever the extension.
    #[arg(long, value_name = "FORMAT", value_parser = format_names(Format::written()))]
    to: Option<Format>,

    /// How choices are written: as they are, or with one state per row.
    #[arg(long, value_name = "ENCODING", default_value_t, value_enum)]
    encoding: EncodingName,

    /// What becomes of actions, labels and variables whose names PRISM's files cannot express.
    #[arg(long, value_name = "WHAT", default_value_t, value_enum)]
    names: NamesChoice,

    /// Write UMB without compression.
    #[arg(long)]
    uncompressed: bool,

    /// Read model.tra of a directory instead of its native file.
    #[arg(long)]
    explicit: bool,

    /// Replace files that exist.
    #[arg(long)]
    force: bool,

    /// Print nothing but errors.
    #[arg(short, long)]
    quiet: bool,
}

const EXAMPLES: &str = "\
Examples:
  dynabs convert out/mine/model.dynabs mine.drn
  dynabs convert model.tra model.umb";

impl From<WriteError> for CliError {
    fn from(error: WriteError) -> Self {
        Self::Input(error.to_string())
    }
}

impl From<EncodingError> for CliError {
    fn from(error: EncodingError) -> Self {
        Self::Input(error.to_string())
    }
}

/// Runs the subcommand.
///
/// # Errors
/// [`CliError`], which knows its exit code.
pub fn run(arguments: &ConvertArguments) -> Result<ExitCode, CliError> {
    let output = &arguments.output;
    let Some(format) = arguments.to.or_else(|| Format::of_path(output)) else {
        return Err(CliError::Input(format!(
            "{}: found a name of no known format; expected one that ends in {}, or --to",
            output.display(),
            Format::endings(Format::written())
        )));
    };
    let has_place = Outputs::is_file(output).map_err(|error| CliError::writing(output, &error))?;
    if has_place {
        refuse_existing(arguments, format)?;
    } else if format == Format::Prism {
        return Err(CliError::Input(format!(
            "{}: found a device or a pipe; expected a regular file: this format has several files",
            output.display()
        )));
    }
    let bars = Arc::new(Bars::new(arguments.quiet));
    let read_properties = |loaded: &LoadedModel| Properties::read(&loaded.properties);
    let (loaded, properties) = load(&arguments.input, arguments.explicit, &bars, read_properties)?;
    let mut warnings = loaded.warnings;
    let mut model = loaded.model;
    let specification = properties.specification(&model).filter(|_| format == Format::Netcdf);
    let mut text = properties.text.clone();
    if arguments.encoding == EncodingName::Rows {
        if !model.rewards().is_empty() {
            warnings.push(format!(
                "{}: with one state per row",
                not_written(model.rewards().iter().map(|structure| structure.name.as_str()))
            ));
        }
        let encoded = RowStates::new(&model)?;
        text = properties.translate(&encoded, &mut warnings)?;
        model = encoded.model;
    }
    if format == Format::Prism {
        let (renamed, changed) = identifiers(model, arguments.names.into())
            .map_err(|error| CliError::Failure(error.to_string()))?;
        model = renamed;
        warnings.extend(changed.iter().map(ToString::to_string));
        for name in changed.iter().filter(|name| name.kind == "label") {
            if let Some(written) = &name.written {
                text = text.replace(&format!("\"{}\"", name.name), &format!("\"{written}\""));
            }
        }
    }
    if Format::OTHERS.contains(&format) {
        let has_names = model.labels().iter().next().is_some() || !model.variables().is_empty();
        if has_names {
            warnings.push(format!("{format} has no place for labels and variables"));
        }
    }
    if format == Format::Prism && model.rows().any(|row| row.lower.contains(&0.0)) {
        warnings.push(format!("lower bounds of 0 are written as {RAISED_LOWER_BOUND:e}: PRISM refuses 0"));
    }
    bars.catch_interrupts();
    let mut files = Outputs::default();
    let compression = if arguments.uncompressed { Compression::None } else { Compression::Gzip };
    let writer = ModelWriter::new(&model, format, compression)?;
    for (i, extension) in writer.extensions().iter().enumerate() {
        // The first file has the name that was asked for, whatever its extension.
        let path = if i == 0 { output.clone() } else { output.with_extension(extension) };
        bars.start("writing", if i == 0 { writer.bytes() } else { 0 });
        let written = files.write(&path, |out| writer.write(extension, out, &*bars));
        written.map_err(|error| CliError::writing(&path, &error))?;
        bars.finish();
    }
    let mut earned = vec![];
    for file in writer.reward_files() {
        let mut name = output.with_extension("").into_os_string();
        name.push(&file.suffix);
        let path = PathBuf::from(name);
        let written = files.write(&path, |out| file.write(out));
        written.map_err(|error| CliError::writing(&path, &error))?;
        earned.push(path);
    }
    let left_out = writer.rewards_left_out();
    if !left_out.is_empty() {
        let reason = match format {
            Format::Drn => "DRN has no rewards of branches, and no blanks in their names".to_owned(),
            _ => format!("{format} has no place for rewards"),
        };
        warnings.push(format!("{}: {reason}", not_written(left_out.into_iter())));
    }
    let mut write_text = |extension: &str, text: &str| {
        let path = output.with_extension(extension);
        let written = files.write(&path, |out| out.write_all(text.as_bytes()));
        written.map_err(|error| CliError::writing(&path, &error))
    };
    if let Some(specification) = specification.filter(|_| has_place) {
        write_text("json", &format!("{specification:#}\n"))?;
    }
    if has_place && !text.is_empty() && !keeps_properties(arguments) {
        write_text("props", &text)?;
    }
    let committed = if arguments.force { files.commit() } else { files.commit_new() };
    committed.map_err(|error| match error.kind() {
        io::ErrorKind::AlreadyExists => taken(output),
        _ => CliError::writing(output, &error),
    })?;
    if has_place && format == Format::Prism {
        remove_others(output, &earned)?;
    }
    if !arguments.quiet {
        let text: String = warnings.iter().map(|warning| format!("warning: {warning}\n")).collect();
        warn(&text);
        let size = model.size();
        print(&format!(
            "{}: {} states, {} choices, {} transitions\n",
            output.display(),
            thousands(size.states),
            thousands(size.choices),
            thousands(size.transitions)
        ))?;
    }
    Ok(ExitCode::SUCCESS)
}

fn not_written<'n>(names: impl Iterator<Item = &'n str>) -> String {
    let names: Vec<_> = names.map(|name| format!("\"{name}\"")).collect();
    format!("the rewards {} are not written", names.join(", "))
}

/// Removes the rewards of the model that was replaced, which would be read as those of the new one.
fn remove_others(output: &Path, earned: &[PathBuf]) -> Result<(), CliError> {
    loop {
        let ExplicitFiles { srew, trew, .. } = ExplicitFiles::beside(output);
        let Some(path) = srew.into_iter().chain(trew).find(|path| !earned.contains(path)) else {
            return Ok(());
        };
        std::fs::remove_file(&path).map_err(|error| CliError::writing(&path, &error))?;
    }
}

fn refuse_existing(arguments: &ConvertArguments, format: Format) -> Result<(), CliError> {
    let output = &arguments.output;
    let mut written = vec![output.clone()];
    if format == Format::Netcdf {
        written.push(output.with_extension("json"));
    }
    if format == Format::Prism {
        written.extend(["sta", "lab"].map(|extension| output.with_extension(extension)));
        // What lies beside a .tra file is read with it.
        let ExplicitFiles { srew, trew, .. } = ExplicitFiles::beside(output);
        written.extend(srew.into_iter().chain(trew));
    }
    if !keeps_properties(arguments) {
        written.push(output.with_extension("props"));
    }
    match written.into_iter().find(|path| path.exists()).filter(|_| !arguments.force) {
        Some(path) => Err(taken(&path)),
        None => Ok(()),
    }
}

fn taken(path: &Path) -> CliError {
    let path = path.display();
    CliError::Input(format!(
        "{path}: found a file; expected a new name\n  Replace what is there with --force."
    ))
}

/// Whether the properties stay where they are, beside another file of the same model.
fn keeps_properties(arguments: &ConvertArguments) -> bool {
    let input = &arguments.input;
    let beside = if input.is_dir() { input.join("model.props") } else { input.with_extension("props") };
    arguments.encoding == EncodingName::Plain && beside == arguments.output.with_extension("props")
}

/// The properties of the model that is converted.
struct Properties {
    /// What is written to the new file.
    text: String,
    entries: Vec<Entry>,
}

impl Properties {
    fn read(path: &Path) -> Result<Self, CliError> {
        let source = match files::read_text(path) {
            Ok(source) => source,
            Err(error) if error.kind() == io::ErrorKind::NotFound => String::new(),
            Err(error) => return Err(CliError::reading(path, &error)),
        };
        let entries = parse_document(&source, &mut Definitions::default());
        if let Some(error) = entries.iter().find_map(|entry| entry.inquiry.as_ref().err()) {
            return Err(CliError::Input(format!("{}: {error}", path.display())));
        }
        let texts: Option<Vec<String>> = entries
            .iter()
            .map(|entry| match &entry.inquiry {
                Ok(Inquiry::Probability(property)) => Some(format!("{property}\n")),
                _ => None,
            })
            .collect();
        // What is more than single probabilities is kept as it is, definitions and all.
        let text = texts.map_or(source, |texts| texts.concat());
        Ok(Self { text, entries })
    }

    /// The properties about the model with one state per row; those that cannot be translated are left out.
    fn translate(&self, encoded: &RowStates, warnings: &mut Vec<String>) -> Result<String, CliError> {
        let mut text = String::new();
        for entry in &self.entries {
            match &entry.inquiry {
                Ok(Inquiry::Probability(property)) => {
                    text.push_str(&format!("{}\n", encoded.translate(property)?))
                }
                _ => warnings.push(format!("{}: is not translated to one state per row", entry.text)),
            }
        }
        Ok(text)
    }

    /// The first property as IntervalMDP.jl asks it, if it can.
    fn specification(&self, model: &IntervalMdp) -> Option<serde_json::Value> {
        let property = self.entries.iter().find_map(|entry| match &entry.inquiry {
            Ok(Inquiry::Probability(property)) => Some(property),
            _ => None,
        })?;
        let query = property.resolve(model.kind()).ok()?.query(model).ok()?;
        let (QueryKind::Until { safe, goal, steps }, false) = (query.kind, query.complement) else {
            return None;
        };
        let mut avoid = safe;
        avoid.toggle_range(..);
        avoid.difference_with(&goal);
        let avoid = (!avoid.is_clear()).then_some(avoid);
        let optimum = (query.resolution.policy_maximises(), query.resolution.nature_maximises());
        Some(netcdf::specification(optimum, &goal, avoid.as_ref(), steps))
    }
}
