//! Reading a model from an archive.

use super::super::member;
use super::archive::Archive;
use super::index::Index;
use super::rewards::read_rewards;
use super::sets::read_set;
use super::transitions::read_transitions;
use super::valuations::read_variables;
use crate::formats::import::{ImportError, Imported, Position, Warning};
use crate::model::{Labels, StateVariables, require_memory};
use std::path::Path;

/// Reads an interval MDP or interval DTMC from a UMB archive, as it is or compressed with gzip or xz.
///
/// Reads what [`UmbWriter`](crate::formats::umb::UmbWriter), PRISM, Storm and `umbi` write. Members that
/// may be left out have the values of the standard. A double stands for its shortest decimal when sums are
/// judged as [`prism::import`](crate::formats::prism::import) does. Equal rows are stored once, and the arrays
/// are never in memory as a whole.
///
/// # Errors
/// [`ImportError`] with the member and the entry of the first thing that is not as the format wants it.
/// Observations, games, continuous time and rational numbers are refused by name.
pub fn import(path: &Path) -> Result<Imported, ImportError> {
    import_with_progress(path, &mut |_| {})
}

/// Reads a model like [`import`] and tells `progress` now and then how many branches have been read.
///
/// # Errors
/// Those of [`import`].
pub fn import_with_progress(path: &Path, progress: &mut dyn FnMut(u64)) -> Result<Imported, ImportError> {
    let archive = Archive::open(path)?;
    let mut index = Index::read(&archive)?;
    let states = index.counts.states;
    let sets = index.labels.len() as u64 + 2;
    require_memory(format!("{} labels", index.labels.len()), states.div_ceil(4).saturating_mul(sets))?;
    let initial = read_set(&archive, member::STATE_IS_INITIAL, states)?;
    let marked = initial.count_ones(..) as u64;
    if marked != index.counts.initial || marked == 0 {
        let expected = match index.counts.initial {
            0 => "at least one initial state".to_owned(),
            count => format!("{count} initial states, as the index says"),
        };
        let at = Position::member(path, member::STATE_IS_INITIAL, None);
        return Err(at.refuse(expected, marked.to_string()));
    }
    let mut labels = Labels::default();
    for (id, name) in std::mem::take(&mut index.labels) {
        let member = member::state_annotation(member::APS, &id);
        let set = read_set(&archive, &member, states)?;
        if name != "init" {
            labels.insert(name, set);
        } else if set != initial {
            let at = Position::member(path, &member, None);
            return Err(at.refuse("the initial states, for this is the label \"init\"", "other states"));
        }
    }
    let without_choices = match index.without_choices {
        true => {
            Some(read_set(&archive, &member::state_annotation(member::OWN, member::WITHOUT_CHOICES), states)?)
        }
        false => None,
    };
    let transitions = read_transitions(&archive, &mut index, without_choices.as_ref(), progress)?;
    let variables = match index.variables.take() {
        Some(class) => read_variables(&archive, class, states)?,
        None => StateVariables::default(),
    };
    let mut imported = transitions.into_model(index.kind, initial, labels, variables)?;
    imported.model =
        imported.model.with_rewards(read_rewards(&archive, &index, without_choices.as_ref())?)?;
    imported.warnings.extend(index.warnings);
    let foreign: Vec<_> = archive.names().filter(|name| !is_standard(name)).collect();
    if let Some(name) = foreign.iter().min() {
        let what = format!("{} member(s) with names that UMB does not have, such as {name},", foreign.len());
        imported.warnings.push(Warning::Ignored { path: path.to_owned(), what });
    }
    Ok(imported)
}

/// Whether a member has a name that the format defines.
fn is_standard(name: &str) -> bool {
    let of_model =
        ["state-", "choice-", "branch-", "actions/", "annotations/", "valuations/", "observations/"];
    name == member::INDEX || of_model.iter().any(|start| name.starts_with(start))
}
