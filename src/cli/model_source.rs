//! Where a model to be solved comes from: a run directory or a file of any format.

use super::{Bars, CliError};
use dynabs::guarantee::{Claim, Gap, Guarantee};
use dynabs::run::{Manifest, NATIVE_MODEL, RunFiles};
use imdp::certificate::FileDigest;
use imdp::files::steady;
use imdp::formats::sha256_of_file;
use imdp::formats::{Format, Held, Warning};
use imdp::model::IntervalMdp;
use imdp::progress::Progress;
use imdp::property::{Property, PropertyError};
use std::path::{Path, PathBuf};

/// A model and where it was found.
pub(super) struct LoadedModel {
    pub(super) model: IntervalMdp,
    pub(super) warnings: Vec<String>,
    /// The file of properties that belongs to it, if there is one.
    pub(super) properties: PathBuf,
    /// PRISM would not read the files as they are.
    pub(super) has_own_layout: bool,
    /// What the model's files ask besides, in PRISM's syntax.
    pub(super) asks: String,
    /// The files it was read from.
    files: Vec<PathBuf>,
    /// What was promised of the run that it is of.
    promise: Option<Promise>,
}

/// What the manifest of a run promises of the model that was read.
struct Promise {
    guarantee: Guarantee,
    /// What is asked about costs, in PRISM's syntax.
    costs: Vec<String>,
    /// Whether the file that was read has raised lower bounds.
    raised: bool,
}

impl Promise {
    fn new(manifest: Manifest, raised: bool) -> Self {
        Self { guarantee: manifest.guarantee, costs: manifest.costs, raised }
    }
}

impl LoadedModel {
    /// What bounds on the value of a property claim of the system; none for models that are of no run.
    ///
    /// # Errors
    /// [`PropertyError`] if the property makes no sense for the model.
    pub(super) fn claim(
        &self,
        property: &Property,
        bounds: [f64; 2],
    ) -> Result<Option<Claim>, PropertyError> {
        let claim = |promise: &Promise| match promise.raised {
            true => Ok(promise.guarantee.no_claim(&[Gap::RaisedBounds])),
            false => promise.guarantee.claim(property, &self.model, bounds),
        };
        self.promise.as_ref().map(claim).transpose()
    }

    /// What the value of an expression claims of the system of a run: nothing, unless it is what the run asks about a cost.
    pub(super) fn claim_of_expression(&self, asked: &str, bounds: Option<[f64; 2]>) -> Option<Claim> {
        let claim = |promise: &Promise| {
            let unnamed = |text: &str| text.split_once(": ").map_or(text, |(_, own)| own).to_owned();
            let is_own = promise.costs.iter().any(|cost| unnamed(cost) == unnamed(asked));
            match bounds.filter(|_| is_own) {
                Some(_) if promise.raised => promise.guarantee.no_claim(&[Gap::RaisedBounds]),
                Some(bounds) => promise.guarantee.cost_claim(asked, bounds),
                None => promise.guarantee.no_claim(&[Gap::Expression]),
            }
        };
        self.promise.as_ref().map(claim)
    }

    /// What a certificate says about the files that the model was read from.
    ///
    /// # Errors
    /// [`CliError::Failure`] if they cannot be read again.
    pub(super) fn digests(&self) -> Result<Vec<FileDigest>, CliError> {
        let digest = |path: &PathBuf| {
            let kind = path.extension().unwrap_or_default().to_string_lossy().into_owned();
            match sha256_of_file(path) {
                Ok(sha256) => Ok(FileDigest { kind, sha256 }),
                Err(error) => Err(CliError::Failure(format!("{}: {error}", path.display()))),
            }
        };
        self.files.iter().map(digest).collect()
    }
}

/// Loads a model: a directory's native file (or its `.tra` if `explicit`), or a file whose extension tells its format; and
/// reads `more` of what belongs to it. Both are done again if another process replaced the files meanwhile.
///
/// # Errors
/// [`CliError::Input`] if nothing usable is there or it is malformed, and those of `more`.
pub(super) fn load<T>(
    path: &Path,
    explicit: bool,
    bars: &Bars,
    more: impl Fn(&LoadedModel) -> Result<T, CliError>,
) -> Result<(LoadedModel, T), CliError> {
    let expected = || {
        format!(
            "a directory written by dynabs-compile or a file that ends in {}",
            Format::endings(Format::all())
        )
    };
    let shown = path.display();
    let overtaken = |error| CliError::Failure(format!("{shown}: {error}"));
    let with_more = |loaded: LoadedModel| more(&loaded).map(|more| (loaded, more));
    match Held::at(path) {
        Held::Directory => {
            steady(&[path.to_owned()], overtaken, || with_more(load_directory(path, explicit, bars)?))
        }
        Held::Model(format, path) => {
            let mut files = format.files(&path);
            files.push(properties_beside(&files, &path));
            steady(&files, overtaken, || with_more(load_file(&path, format, bars)?))
        }
        Held::Nothing => Err(CliError::Input(format!("{shown}: found nothing; expected {}", expected()))),
        Held::Json | Held::Other => Err(CliError::Input(format!(
            "{shown}: found a file of another kind; expected {}{}",
            expected(),
            export_command(path)
        ))),
    }
}

/// What a command that takes a model says of it.
pub(super) fn model_help() -> String {
    let formats: Vec<_> = Format::all().map(|format| format!("  {}", format.about())).collect();
    format!(
        "A directory written by dynabs-compile, or a model (`m.tra,sta,lab` as well), compressed by gzip or xz or not:\n{}",
        formats.join("\n")
    )
}

/// How to make files of a model in the language of PRISM or Storm; nothing for other files.
fn export_command(path: &Path) -> String {
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    match extension {
        "prism" | "nm" | "pm" | "sm" | "mdp" | "dtmc" => format!(
            "\n  This looks like a model in PRISM's language: `prism {} -exportmodel {stem}.all` writes {stem}.tra and what \
             belongs to it (add -const NAME=VALUE for its constants).",
            path.display()
        ),
        "jani" => format!(
            "\n  This looks like a JANI model: `storm --jani {} --exportbuild {stem}.drn` writes {stem}.drn.",
            path.display()
        ),
        _ => String::new(),
    }
}

fn load_directory(directory: &Path, explicit: bool, bars: &Bars) -> Result<LoadedModel, CliError> {
    let found = RunFiles::find(directory)?;
    // In a directory without a manifest there is nothing to hold its files against.
    let verify = |names: &[&str]| {
        let there = names.iter().filter(|name| directory.join(name).exists());
        found.iter().try_for_each(|run| there.clone().try_for_each(|name| run.verified(name).map(drop)))
    };
    let (native, tra) = (directory.join(NATIVE_MODEL), directory.join("model.tra"));
    let manifest = found.as_ref().and_then(|run| run.manifest().ok());
    if native.exists() && !explicit {
        verify(&[NATIVE_MODEL, "model.props"])?;
        let mut loaded = load_file(&native, Format::Native, bars)?;
        loaded.promise = manifest.map(|manifest| Promise::new(manifest, false));
        return Ok(loaded);
    }
    if !tra.exists() {
        let wanted =
            if explicit { "model.tra (it was left out by --no-tra)" } else { "model.dynabs or model.tra" };
        return Err(CliError::Input(format!(
            "{}: found no {wanted}; expected a compiled model",
            directory.display()
        )));
    }
    verify(&["model.tra", "model.sta", "model.lab", "model.props"])?;
    let mut loaded = load_file(&tra, Format::Prism, bars)?;
    let raised =
        |manifest: &&Manifest| loaded.model.rows().any(|row| row.lower.contains(&manifest.prism_lower_bound));
    let raised = manifest.as_ref().filter(raised);
    loaded.warnings.extend(raised.map(|manifest| raised_bounds(manifest, &loaded.model)));
    let raised = raised.is_some();
    loaded.promise = manifest.map(|manifest| Promise::new(manifest, raised));
    Ok(loaded)
}

/// What raising lower bounds of 0 for PRISM can do to the values of this file.
fn raised_bounds(manifest: &Manifest, model: &IntervalMdp) -> String {
    let raised = manifest.prism_lower_bound;
    let longest = model.rows().longest();
    match manifest.horizon {
        Some(horizon) => format!(
            "model.tra has lower bounds of {raised:e} where the model has 0: within {} steps that changes a value by at \
             most {:.1e}",
            horizon.model_steps,
            horizon.model_steps as f64 * longest as f64 * raised
        ),
        None => format!(
            "model.tra has lower bounds of {raised:e} where the model has 0: without a bound on the steps its values can \
             be others altogether; those of the model are computed without --explicit"
        ),
    }
}

fn load_file(path: &Path, format: Format, bars: &Bars) -> Result<LoadedModel, CliError> {
    bars.start("reading", format.work(path));
    let imported = format.import(path, bars);
    bars.finish();
    let imported = imported.map_err(|error| match error.is_io() {
        true => CliError::Failure(error.to_string()),
        false => CliError::Input(error.to_string()),
    })?;
    let layout = |warning: &Warning| matches!(warning, Warning::Layout { .. } | Warning::NoLabelFile { .. });
    let has_own_layout = imported.warnings.iter().any(layout);
    let warnings = imported.warnings.iter().map(ToString::to_string).collect();
    let files = format.files(path);
    let properties = properties_beside(&files, path);
    let asks = imported.properties;
    Ok(LoadedModel {
        model: imported.model,
        warnings,
        has_own_layout,
        properties,
        asks,
        files,
        promise: None,
    })
}

/// Where the properties of a model are that has `files`: `m.tra.gz` and `m.tra,sta,lab` have those of `m.tra`.
fn properties_beside(files: &[PathBuf], path: &Path) -> PathBuf {
    let first = files.first().map_or(path, PathBuf::as_path);
    let packed = matches!(first.extension().and_then(|extension| extension.to_str()), Some("gz" | "xz"));
    let unpacked = if packed { first.with_extension("") } else { first.to_owned() };
    unpacked.with_extension("props")
}
