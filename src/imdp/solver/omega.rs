//! Where a run can stay for ever such that it satisfies a condition about what it meets infinitely often.
//!
//! An *end component* is a set of states, each with choices that stay in it, through which all of its states can be reached
//! from each other again and again. A maximising policy that stays in one meets all of its states infinitely often with
//! probability 1. Two kinds are of interest, for nature may have some say in what stays and what is reached:
//!
//! - nature works against it: choices whose every distribution stays, and successors that every distribution reaches;
//! - nature helps: choices with some distribution that stays, and successors that some such distribution reaches.
//!
//! Whatever policy and nature do, the states that a run meets infinitely often are an end component of the second kind. So
//! the probability of ending in one of the first kind that satisfies the condition is a lower bound of the value for a
//! minimising nature, and that of ending in one of the second kind is an upper bound; for a maximising nature the second
//! is the value. Where no lower bound of an interval is 0, both kinds are the same.

use super::graph::{certain, possible_within, stays, strong_components};
use super::query::Direction;
use crate::model::{IntervalMdp, RowBuffer, RowId, StateId, StateSet};

/// A condition on a run: what it must meet finitely and what infinitely often.
#[derive(Clone, Debug)]
pub(crate) struct Acceptance {
    /// States that must be met finitely often.
    pub(crate) finitely: StateSet,
    /// Sets of states each of which must be met infinitely often.
    pub(crate) infinitely: Vec<StateSet>,
}

/// The states of all end components that satisfy one of the conditions; `helpful` says whether nature helps.
pub(crate) fn accepting_states(model: &IntervalMdp, conditions: &[Acceptance], helpful: bool) -> StateSet {
    let nature = if helpful { Direction::Max } else { Direction::Min };
    let mut all = StateSet::with_capacity(model.num_states());
    all.insert_range(..);
    let mut accepted = StateSet::with_capacity(model.num_states());
    for component in end_components(model, all, nature) {
        for condition in conditions {
            let mut rest = component.clone();
            rest.difference_with(&condition.finitely);
            for part in end_components(model, rest, nature) {
                if condition.infinitely.iter().all(|set| !set.is_disjoint(&part)) {
                    accepted.union_with(&part);
                }
            }
        }
    }
    accepted
}

/// The maximal end components within a set of states.
fn end_components(model: &IntervalMdp, within: StateSet, nature: Direction) -> Vec<StateSet> {
    let (mut open, mut closed) = (vec![within], vec![]);
    while let Some(set) = open.pop() {
        if set.is_clear() {
            continue;
        }
        let parts = split(model, &set, nature);
        match &parts[..] {
            [only] if *only == set => closed.push(set),
            _ => open.extend(parts),
        }
    }
    closed
}

/// The strong components of a set under the choices that stay in it, less states without such choices.
fn split(model: &IntervalMdp, set: &StateSet, nature: Direction) -> Vec<StateSet> {
    let inside = |s: StateId| set.contains(s.index());
    let mut row_stays: Vec<Option<bool>> = vec![None; model.rows().len()];
    let mut stays_in = |row: RowId| {
        *row_stays[row.index()].get_or_insert_with(|| {
            stays(model.rows().row(row, &mut RowBuffer::default()), nature, |s| set.contains(s.index()))
        })
    };
    let mut has_choice = StateSet::with_capacity(model.num_states());
    for state in set.ones() {
        let is_final = model.choices().ranges(StateId::from_index(state)).is_empty();
        // Every choice is looked at, for each has edges of its own.
        let stay = model.choices().rows(StateId::from_index(state)).filter(|&row| stays_in(row)).count();
        has_choice.set(state, is_final || stay > 0);
    }
    let states = model.num_states();
    let roots = has_choice.ones().collect::<Vec<_>>();
    let components = strong_components(states, roots.into_iter(), |node, out| {
        for row in model.choices().rows(StateId::from_index(node)) {
            if !row_stays[row.index()].unwrap_or(false) {
                continue;
            }
            let buffer = &mut RowBuffer::default();
            let row = model.rows().row(row, buffer);
            for (position, &successor) in row.successors.iter().enumerate() {
                if !inside(successor) || !has_choice.contains(successor.index()) {
                    continue;
                }
                let reached = match nature {
                    Direction::Min => certain(row, position),
                    Direction::Max => possible_within(row, position, |s| set.contains(s as usize)),
                };
                if reached {
                    out.push(successor.0);
                }
            }
        }
    });
    components
        .into_iter()
        .map(|component| {
            let mut part = StateSet::with_capacity(states);
            component.into_iter().for_each(|state| part.insert(state as usize));
            part
        })
        .collect()
}
