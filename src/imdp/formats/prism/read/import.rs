//! Reading a model from its files.

use std::io::BufRead;
use std::path::Path;

use super::files::ExplicitFiles;
use super::labels::read_lab;
use super::rewards::{read_srew, read_trew};
use super::states::read_sta;
use super::transitions::read_tra;
use crate::files::{settle, steady};
use crate::formats::import::{ImportError, Imported, Lines, Transitions, Warning, open};
use crate::model::{Labels, ModelKind, RewardStructure, StateSet, StateVariables};

/// Reads an interval MDP or interval DTMC from PRISM's explicit files.
///
/// Where `sta` or `lab` is not given, the file of the same stem beside the transitions is read. See [`import_files`].
///
/// # Errors
/// Those of [`import_files`].
pub fn import(tra: &Path, sta: Option<&Path>, lab: Option<&Path>) -> Result<Imported, ImportError> {
    import_with_progress(tra, sta, lab, &mut |_| {})
}

/// Reads a model like [`import`] and tells `progress` now and then how many bytes of `tra` have been read.
///
/// # Errors
/// Those of [`import_files`].
pub fn import_with_progress(
    tra: &Path,
    sta: Option<&Path>,
    lab: Option<&Path>,
    progress: &mut (dyn FnMut(u64) + Send),
) -> Result<Imported, ImportError> {
    let mut files = ExplicitFiles::beside(tra);
    files.sta = sta.map(Path::to_owned).or(files.sta);
    files.lab = lab.map(Path::to_owned).or(files.lab);
    import_files(&files, progress)
}

/// Reads an interval MDP or interval DTMC from PRISM's explicit files, each of which may be compressed by gzip or xz.
///
/// Transitions: `states choices transitions`, then `src choice dst [lo,hi] action` line by line, the action
/// being optional and a plain number standing for an interval without width. With `states transitions` and
/// lines `src dst [lo,hi]` the model is an interval DTMC. Without labels, state 0 is the initial one. Lines that start
/// with `#` are comments, as in the files that PRISM exports. Blanks, order and names that PRISM would not accept are
/// read with a warning; they change nothing.
///
/// Bounds become the doubles nearest to them, with the numbers themselves beside where those are not the shortest decimals of
/// the doubles. Sums are judged on the decimals as written: lower bounds that
/// exceed 1, or upper bounds that do not reach it, by at most 10⁻⁹ are widened outwards with a warning.
/// Equal rows are stored once; a state whose only choice is to stay becomes absorbing.
///
/// # Errors
/// [`ImportError`] with the position of the first thing that is not as the format wants it.
pub fn import_files(
    files: &ExplicitFiles,
    progress: &mut (dyn FnMut(u64) + Send),
) -> Result<Imported, ImportError> {
    let directory =
        files.tra.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    // Files of one writer: what a killed one had decided to write is finished, what is replaced meanwhile is read again.
    let failed = |error| ImportError::io(directory, error);
    steady(&files.all(), failed, || {
        settle(directory).map_err(failed)?;
        read(files, progress)
    })
}

fn read(files: &ExplicitFiles, progress: &mut (dyn FnMut(u64) + Send)) -> Result<Imported, ImportError> {
    // A missing file should not be noticed only after minutes of reading.
    for file in files.all() {
        std::fs::metadata(&file).map_err(|error| ImportError::io(&file, error))?;
    }
    let (header, transitions) = read_tra(&files.tra, progress)?;
    let mut parts = StateFiles::default();
    if let Some(sta) = &files.sta {
        parts.read_variables(sta, &mut Lines::new(sta, open(sta)?.reader), header.states)?;
    }
    match &files.lab {
        Some(lab) => parts.labels = Some(read_lab(&mut Lines::new(lab, open(lab)?.reader), header.states)?),
        None => parts.warnings.push(Warning::NoLabelFile { path: files.tra.with_extension("lab") }),
    }
    let mut imported = parts.into_model(header.kind, header.states, transitions)?;
    let mut structures: Vec<RewardStructure> = vec![];
    for (i, srew) in files.srew.iter().enumerate() {
        let mut lines = Lines::new(srew, open(srew)?.reader);
        read_srew(&mut lines, &imported.model, structure(&mut structures, i))?;
    }
    for (i, trew) in files.trew.iter().enumerate() {
        let mut lines = Lines::new(trew, open(trew)?.reader);
        read_trew(&mut lines, &imported.model, structure(&mut structures, i))?;
    }
    imported.model = imported.model.with_rewards(structures)?;
    Ok(imported)
}

/// The structure of this number, counted from 0.
pub(super) fn structure(structures: &mut Vec<RewardStructure>, number: usize) -> &mut RewardStructure {
    if structures.len() <= number {
        structures.resize(number + 1, RewardStructure::default());
    }
    &mut structures[number]
}

/// What is known of the states besides their transitions.
#[derive(Default)]
pub(super) struct StateFiles {
    variables: StateVariables,
    /// The initial states and the labels; without a file, state 0 is the initial one.
    pub labels: Option<(StateSet, Labels)>,
    pub warnings: Vec<Warning>,
}

impl StateFiles {
    /// Reads the variables of so many states.
    pub(super) fn read_variables<R: BufRead>(
        &mut self,
        path: &Path,
        lines: &mut Lines<'_, R>,
        states: u64,
    ) -> Result<(), ImportError> {
        let (variables, left_out) = read_sta(lines, states)?;
        if !left_out.is_empty() {
            let what =
                format!("the variables {}, not all of whose values are integers,", left_out.join(", "));
            self.warnings.push(Warning::Ignored { path: path.to_owned(), what });
        }
        self.variables = variables;
        Ok(())
    }

    /// The model of these states and transitions.
    pub(super) fn into_model(
        self,
        kind: ModelKind,
        states: u64,
        transitions: Transitions,
    ) -> Result<Imported, ImportError> {
        let first_state = || {
            let mut initial = StateSet::with_capacity(states as usize);
            initial.insert(0);
            (initial, Labels::default())
        };
        let (initial, labels) = self.labels.unwrap_or_else(first_state);
        let mut imported = transitions.into_model(kind, initial, labels, self.variables)?;
        imported.warnings.extend(self.warnings);
        Ok(imported)
    }
}
