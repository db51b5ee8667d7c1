//! Upper bounds that have a chance to be inductive in end components.

use super::component::{Component, Shared};
use super::expectation::poured_mass;
use super::graph::{Candidates, can_stay, end_components};
use super::query::Optimum;
use crate::imdp::{RowId, StateId};
use std::collections::HashMap;

/// Raises a candidate to its maximum over each end component of the maximising side.
///
/// Every minimising side is fixed to what is best for the current lower bounds.
pub(super) fn level(component: &Component<'_, '_>, candidate: &mut [f64]) {
    let shared = &*component.shared;
    let players = shared.players;
    if (players.policy, players.nature) == (Optimum::Min, Optimum::Min) {
        // Who minimises in an end component stays there for value 0: such states are known already.
        return;
    }
    let rows: Vec<RowId> = component.sweep.rows().collect();
    let supports: Option<Vec<Vec<bool>>> = (players.nature == Optimum::Min)
        .then(|| rows.iter().map(|&id| minimal_support(shared, id)).collect());
    // Most rows can leave for a finished state: they are in no end component.
    let inside = |s: StateId| component.sweep.states.binary_search(&s).is_ok();
    let may_stay = |position: usize| {
        let row = shared.model.rows().row(rows[position]);
        match &supports {
            Some(supports) => row.successors.iter().zip(&supports[position]).all(|(s, p)| !p || inside(*s)),
            None => can_stay(row, &inside),
        }
    };
    let staying = (0..rows.len()).filter(|&i| may_stay(i)).map(|i| (rows[i], i as u32));
    let position: HashMap<RowId, u32> = staying.collect();
    if position.is_empty() {
        return;
    }
    let choices_of = |&s: &StateId| -> Vec<u32> {
        let ranges = shared.model.choices().ranges(s);
        let all = shared.model.choices().rows(s);
        match players.policy {
            Optimum::Max => all.filter_map(|row| position.get(&row).copied()).collect(),
            Optimum::Min => {
                let best = shared.lower_rows.best(ranges);
                let attains = |row: &RowId| shared.lower_rows.values()[*row as usize] <= best;
                all.filter(attains).take(1).filter_map(|row| position.get(&row).copied()).collect()
            }
        }
    };
    let choices = component.sweep.states.iter().map(choices_of).collect();
    let part = Candidates { model: shared.model, states: &component.sweep.states, choices, supports, rows };
    for class in end_components(&part) {
        let top = class.iter().map(|&i| candidate[i as usize]).fold(0.0, f64::max);
        class.iter().for_each(|&i| candidate[i as usize] = top);
    }
}

/// Where a minimising nature puts mass at the current lower bounds.
fn minimal_support(shared: &Shared<'_>, id: RowId) -> Vec<bool> {
    let row = shared.model.rows().row(id);
    // Less than this is what rounding leaves over.
    let negligible = crate::numeric::rounding_factor(row.len() + 4);
    let poured = poured_mass(row, &shared.lower, Optimum::Min);
    poured.iter().zip(row.lower).map(|(p, l)| *l > 0.0 || *p > negligible).collect()
}
