//! Where a run can stay for ever such that it satisfies a condition about what it meets infinitely often.
//!
//! An *end component* is a set of states, each with choices that stay in it, through which all of its states can be reached
//! from each other again and again. A maximising policy that stays in one meets all of its states infinitely often with
//! probability 1, if nature helps: by choices with some distribution that stays, and successors that some such distribution
//! reaches. Whatever policy and nature do, the states that a run meets infinitely often are such a component. So the
//! probability of ending in one that satisfies the condition is the value for a maximising nature, and an upper bound of it
//! for a minimising one.
//!
//! Against nature a policy needs choices whose every distribution stays in a set, and leads on with positive probability to what
//! is to be met: the probability of ending in such a set is a lower bound of the value. Where no lower bound of an interval
//! is 0, both bounds are the same.

use super::graph::{hits, possible_within, stays, strong_components};
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

/// The states of all end components that satisfy one of the conditions, if nature helps; else those from which a policy
/// satisfies one of them with probability 1 without meeting what must be met finitely often, whatever nature does.
pub(crate) fn accepting_states(model: &IntervalMdp, conditions: &[Acceptance], helpful: bool) -> StateSet {
    if !helpful {
        let mut accepted = StateSet::with_capacity(model.num_states());
        conditions.iter().for_each(|condition| accepted.union_with(&winning(model, condition)));
        return accepted;
    }
    let mut all = StateSet::with_capacity(model.num_states());
    all.insert_range(..);
    let mut accepted = StateSet::with_capacity(model.num_states());
    for component in end_components(model, all) {
        for condition in conditions {
            let mut rest = component.clone();
            rest.difference_with(&condition.finitely);
            for part in end_components(model, rest) {
                if condition.infinitely.iter().all(|set| !set.is_disjoint(&part)) {
                    accepted.union_with(&part);
                }
            }
        }
    }
    accepted
}

/// The largest set outside of what must be met finitely often in which every state has a choice all of whose distributions stay,
/// and from which such choices lead to each set to be met infinitely often: from every state with at least some probability,
/// so again and again, for there are finitely many.
///
/// Nature may decide where exactly a run goes on in it.
fn winning(model: &IntervalMdp, condition: &Acceptance) -> StateSet {
    let mut set = StateSet::with_capacity(model.num_states());
    set.insert_range(..);
    set.difference_with(&condition.finitely);
    let buffer = &mut RowBuffer::default();
    loop {
        let before = set.count_ones(..);
        let mut staying: Vec<Option<bool>> = vec![None; model.rows().len()];
        let mut has_choice = StateSet::with_capacity(model.num_states());
        for state in set.ones() {
            let id = StateId::from_index(state);
            for row in model.choices().rows(id) {
                let stay = staying[row.index()].get_or_insert_with(|| {
                    stays(model.rows().row(row, buffer), Direction::Min, |s| set.contains(s.index()))
                });
                if *stay {
                    has_choice.insert(state);
                }
            }
            if model.choices().ranges(id).is_empty() {
                has_choice.insert(state);
            }
        }
        set = has_choice;
        for infinitely in &condition.infinitely {
            let mut found = set.clone();
            found.intersect_with(infinitely);
            loop {
                let mut leads: Vec<Option<bool>> = vec![None; staying.len()];
                let mut lead = |row: RowId| {
                    staying[row.index()] == Some(true)
                        && *leads[row.index()].get_or_insert_with(|| {
                            hits(model.rows().row(row, buffer), Direction::Min, |s| found.contains(s.index()))
                        })
                };
                let more: Vec<usize> = (set.difference(&found))
                    .filter(|&state| model.choices().rows(StateId::from_index(state)).any(&mut lead))
                    .collect();
                if more.is_empty() {
                    break;
                }
                more.into_iter().for_each(|state| found.insert(state));
            }
            set.intersect_with(&found);
        }
        if set.count_ones(..) == before {
            return set;
        }
    }
}

/// The maximal end components within a set of states, where nature helps.
fn end_components(model: &IntervalMdp, within: StateSet) -> Vec<StateSet> {
    let (mut open, mut closed) = (vec![within], vec![]);
    while let Some(set) = open.pop() {
        if set.is_clear() {
            continue;
        }
        let parts = split(model, &set);
        match &parts[..] {
            [only] if *only == set => closed.push(set),
            _ => open.extend(parts),
        }
    }
    closed
}

/// The strong components of a set under the choices that stay in it, less states without such choices.
fn split(model: &IntervalMdp, set: &StateSet) -> Vec<StateSet> {
    let inside = |s: StateId| set.contains(s.index());
    let mut row_stays: Vec<Option<bool>> = vec![None; model.rows().len()];
    let mut stays_in = |row: RowId| {
        *row_stays[row.index()].get_or_insert_with(|| {
            stays(model.rows().row(row, &mut RowBuffer::default()), Direction::Max, |s| {
                set.contains(s.index())
            })
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
                if possible_within(row, position, |s| set.contains(s as usize)) {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{
        ActionNames, ChoicesBuilder, Labels, ModelKind, Parts, RowRange, Rows, StateVariables,
    };

    /// State 0 goes to 0 or 1 as nature likes, 1 to 0, 1 or, if `leaves`, to 2, where it ends.
    fn model(leaves: bool) -> IntervalMdp {
        let mut rows = Rows::new();
        for successors in [2, if leaves { 3 } else { 2 }] {
            (0..successors).for_each(|state| rows.push_entry(StateId(state), 0.0, 1.0));
            rows.finish_row();
        }
        let mut choices = ChoicesBuilder::with_capacity(3);
        for row in [0, 1] {
            choices.push_range(RowRange { first: RowId(row), last: RowId(row) });
            choices.finish_state();
        }
        choices.push_absorbing();
        let mut initial = StateSet::with_capacity(3);
        initial.insert(0);
        IntervalMdp::new(Parts {
            kind: ModelKind::Imdp,
            rows,
            choices: choices.finish(),
            actions: ActionNames::None,
            initial,
            labels: Labels::default(),
            variables: StateVariables::default(),
        })
        .unwrap()
    }

    fn set(members: &[usize]) -> StateSet {
        let mut set = StateSet::with_capacity(3);
        set.extend(members.iter().copied());
        set
    }

    #[test]
    fn nature_may_choose_where_a_run_goes_on() {
        let again = |states: &[usize]| Acceptance { finitely: set(&[2]), infinitely: vec![set(states)] };
        // It is in one of the two, whichever nature prefers, but neither can be met for certain.
        assert_eq!(accepting_states(&model(false), &[again(&[0, 1])], false), set(&[0, 1]));
        assert_eq!(accepting_states(&model(false), &[again(&[1])], false), set(&[]));
        assert_eq!(accepting_states(&model(false), &[again(&[1])], true), set(&[0, 1]));
        assert_eq!(accepting_states(&model(true), &[again(&[0, 1])], false), set(&[]));
        assert_eq!(accepting_states(&model(true), &[again(&[0, 1])], true), set(&[0, 1]));
    }
}
