//! Where a model to be solved comes from: a run directory or a file of any format.

use super::{Bars, CliError};
use dynabs::guarantee::{Claim, Gap, Guarantee};
use dynabs::run::{Manifest, NATIVE_MODEL};
use imdp::certificate::ModelFile;
use imdp::formats::Format;
use imdp::formats::sha256_of_file;
use imdp::model::IntervalMdp;
use imdp::progress::Progress;
use imdp::property::{Property, PropertyError};
use std::fs;
use std::path::{Path, PathBuf};

/// A model and where it was found.
pub(super) struct LoadedModel {
    pub(super) model: IntervalMdp,
    pub(super) warnings: Vec<String>,
    /// The file of properties that belongs to it, if there is one.
    pub(super) properties: PathBuf,
    /// The files it was read from.
    files: Vec<PathBuf>,
    /// What was promised of the run that it is of.
    promise: Option<Promise>,
}

/// What the manifest of a run promises of the model that was read.
struct Promise {
    guarantee: Guarantee,
    /// Why it is not about the file that was read.
    gap: Option<Gap>,
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
        let claim = |promise: &Promise| match promise.gap {
            Some(gap) => Ok(promise.guarantee.no_claim(&[gap])),
            None => promise.guarantee.claim(property, &self.model, bounds),
        };
        self.promise.as_ref().map(claim).transpose()
    }

    /// What a certificate says about the files that the model was read from.
    ///
    /// # Errors
    /// [`CliError::Failure`] if they cannot be read again.
    pub(super) fn digests(&self) -> Result<Vec<ModelFile>, CliError> {
        let digest = |path: &PathBuf| {
            let kind = path.extension().unwrap_or_default().to_string_lossy().into_owned();
            match sha256_of_file(path) {
                Ok(sha256) => Ok(ModelFile { kind, sha256 }),
                Err(error) => Err(CliError::Failure(format!("{}: {error}", path.display()))),
            }
        };
        self.files.iter().map(digest).collect()
    }
}

/// Loads a model: a directory's native file (or its `.tra` if `explicit`), or a file whose extension tells its format.
///
/// # Errors
/// [`CliError::Input`] if nothing usable is there or it is malformed.
pub(super) fn load(path: &Path, explicit: bool, bars: &Bars) -> Result<LoadedModel, CliError> {
    const EXPECTED: &str = "a directory written by dynabs-compile or a .tra, .drn, .umb or .dynabs file";
    let shown = path.display();
    if path.is_dir() {
        return load_directory(path, explicit, bars);
    }
    if !path.exists() {
        return Err(CliError::Input(format!("{shown}: found nothing; expected {EXPECTED}")));
    }
    match Format::of_path(path) {
        Some(format) => load_file(path, format, bars),
        None => Err(CliError::Input(format!("{shown}: found a file of another kind; expected {EXPECTED}"))),
    }
}

fn load_directory(directory: &Path, explicit: bool, bars: &Bars) -> Result<LoadedModel, CliError> {
    let (native, tra) = (directory.join(NATIVE_MODEL), directory.join("model.tra"));
    let manifest = fs::read(directory.join("manifest.json")).ok();
    let manifest = manifest.and_then(|bytes| serde_json::from_slice::<Manifest>(&bytes).ok());
    if native.exists() && !explicit {
        let mut loaded = load_file(&native, Format::Native, bars)?;
        loaded.promise = promise(manifest.as_ref(), &loaded, false)?;
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
    let mut loaded = load_file(&tra, Format::Prism, bars)?;
    let raised = |manifest: &&Manifest| {
        loaded.model.rows().iter().any(|row| row.lower.contains(&manifest.prism_lower_bound))
    };
    let raised = manifest.as_ref().filter(raised);
    loaded.promise = promise(manifest.as_ref(), &loaded, raised.is_some())?;
    loaded.warnings.extend(raised.map(|manifest| raised_bounds(manifest, &loaded.model)));
    Ok(loaded)
}

/// What the manifest promises, which is nothing of files that it does not describe.
fn promise(
    manifest: Option<&Manifest>,
    loaded: &LoadedModel,
    raised: bool,
) -> Result<Option<Promise>, CliError> {
    let Some(manifest) = manifest else { return Ok(None) };
    let described = || {
        let digests = loaded.digests()?;
        Ok::<_, CliError>(
            (digests.iter()).all(|file| manifest.outputs.iter().any(|o| o.sha256 == file.sha256)),
        )
    };
    let gap = match raised {
        true => Some(Gap::RaisedBounds),
        false => (!described()?).then_some(Gap::OtherModel),
    };
    Ok(Some(Promise { guarantee: manifest.guarantee.clone(), gap }))
}

/// What raising lower bounds of 0 for PRISM can do to the values of this file.
fn raised_bounds(manifest: &Manifest, model: &IntervalMdp) -> String {
    let raised = manifest.prism_lower_bound;
    let longest = model.rows().iter().map(|row| row.len()).max().unwrap_or(0);
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
    let mut before = 0;
    let imported = format.import(path, &mut |read| {
        bars.advance(read.saturating_sub(before));
        before = read;
    });
    bars.finish();
    let imported = imported.map_err(|error| match error.is_io() {
        true => CliError::Failure(error.to_string()),
        false => CliError::Input(error.to_string()),
    })?;
    let warnings = imported.warnings.iter().map(ToString::to_string).collect();
    let files = match format {
        Format::Prism => {
            let files = ["tra", "sta", "lab"].map(|extension| path.with_extension(extension));
            files.into_iter().filter(|path| path.exists()).collect()
        }
        _ => vec![path.to_owned()],
    };
    Ok(LoadedModel {
        model: imported.model,
        warnings,
        properties: path.with_extension("props"),
        files,
        promise: None,
    })
}
