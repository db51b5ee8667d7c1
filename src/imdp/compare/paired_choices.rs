//! Which choice of one model stands for which of the other.

use super::actions::{Actions, Name};
use crate::model::{RowId, StateId};
use std::collections::HashMap;

/// The choices of one state of two models.
#[derive(Default)]
pub(super) struct PairedChoices<'a> {
    /// Name, row on the left, row on the right.
    pub pairs: Vec<(Name<'a>, RowId, RowId)>,
    /// Choices that only the left has, by name or else index.
    pub left_only: Vec<String>,
    /// Choices that only the right has.
    pub right_only: Vec<String>,
}

impl<'a> PairedChoices<'a> {
    /// Pairs by name where names tell the choices apart, else by position.
    pub(super) fn new(left: &'a Actions<'_>, right: &'a Actions<'_>, state: StateId) -> Self {
        let a: Vec<_> = left.of_state(state).collect();
        let b: Vec<_> = right.of_state(state).collect();
        let same_names = a.len() == b.len() && a.iter().zip(&b).all(|((a, _), (b, _))| a == b);
        if same_names {
            let pairs = a.iter().zip(&b).map(|(&(name, a), &(_, b))| (name, a, b)).collect();
            return Self { pairs, ..Self::default() };
        }
        match (by_name(&a), by_name(&b)) {
            (Some(known_a), Some(known_b)) => {
                let pair = |&(name, row)| known_b.get(&name).map(|&other| (name, row, other));
                let only = |choices: &[(Name<'_>, RowId)], known: &HashMap<Name<'_>, RowId>| {
                    let missing = choices.iter().filter(|(name, _)| !known.contains_key(name));
                    missing.map(|(name, _)| name.to_string()).collect()
                };
                Self {
                    pairs: a.iter().filter_map(pair).collect(),
                    left_only: only(&a, &known_b),
                    right_only: only(&b, &known_a),
                }
            }
            _ => {
                let common = a.len().min(b.len());
                let rest = |length| (common..length).map(|choice| format!("choice {choice}")).collect();
                Self {
                    pairs: a.iter().zip(&b).map(|(&(name, a), &(_, b))| (name, a, b)).collect(),
                    left_only: rest(a.len()),
                    right_only: rest(b.len()),
                }
            }
        }
    }
}

/// Rows by name, if every choice has a name of its own.
fn by_name<'a>(choices: &[(Name<'a>, RowId)]) -> Option<HashMap<Name<'a>, RowId>> {
    let map: HashMap<_, _> = choices.iter().copied().collect();
    (map.len() == choices.len() && !map.contains_key(&Name::Unnamed)).then_some(map)
}
