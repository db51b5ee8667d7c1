//! Reading a model from its three files.

use std::path::{Path, PathBuf};

use super::labels::read_lab;
use super::states::read_sta;
use super::transitions::read_tra;
use crate::files::{settle, steady};
use crate::formats::import::{ImportError, Imported};
use crate::model::StateVariables;

/// Reads an interval MDP or interval DTMC from PRISM's explicit files.
///
/// Transitions: `states choices transitions`, then `src choice dst [lo,hi] action` line by line, the action
/// being optional and a plain number standing for an interval without width. With `states transitions` and
/// lines `src dst [lo,hi]` the model is an interval DTMC. Where `sta` or `lab` is not given, the file of the
/// same stem beside the transitions is read: the label file must exist, the state file may be missing. Each
/// file may begin with lines that start with `#`, as those that PRISM exports do.
///
/// Bounds become the doubles nearest to them. Sums are judged on the decimals as written: lower bounds that
/// exceed 1, or upper bounds that do not reach it, by at most 10⁻⁹ are widened outwards with a warning.
/// Equal rows are stored once; a state whose only choice is to stay becomes absorbing.
///
/// # Errors
/// [`ImportError`] with the position of the first thing that is not as the format wants it.
pub fn import(tra: &Path, sta: Option<&Path>, lab: Option<&Path>) -> Result<Imported, ImportError> {
    import_with_progress(tra, sta, lab, &mut |_| {})
}

/// Reads a model like [`import`] and tells `progress` now and then how many bytes of `tra` have been read.
///
/// # Errors
/// Those of [`import`].
pub fn import_with_progress(
    tra: &Path,
    sta: Option<&Path>,
    lab: Option<&Path>,
    progress: &mut (dyn FnMut(u64) + Send),
) -> Result<Imported, ImportError> {
    let beside = |extension: &str| tra.with_extension(extension);
    let files = [
        tra.to_owned(),
        sta.map_or_else(|| beside("sta"), Path::to_owned),
        lab.map_or_else(|| beside("lab"), Path::to_owned),
    ];
    let directory = tra.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    // Three files of one writer: what a killed one had decided to write is finished, what is replaced meanwhile is read
    // again.
    steady(&files, || {
        settle(directory).map_err(|error| ImportError::io(directory, error))?;
        read(&files, sta.is_some(), progress)
    })
}

/// Reads the files for transitions, states and labels; that for states may be missing unless it is `given`.
fn read(
    [tra, sta, lab]: &[PathBuf; 3],
    given: bool,
    progress: &mut (dyn FnMut(u64) + Send),
) -> Result<Imported, ImportError> {
    // A missing file should not be noticed only after minutes of reading.
    if !lab.exists() {
        return Err(ImportError::NoLabelFile { path: lab.clone() });
    }
    let (kind, states, transitions) = read_tra(tra, progress)?;
    let variables = match given || sta.exists() {
        true => read_sta(sta, states)?,
        false => StateVariables::default(),
    };
    let (initial, labels) = read_lab(lab, states)?;
    transitions.into_model(kind, initial, labels, variables)
}
