//! Upper bounds that have a chance to be inductive in end components.

use super::component::Component;
use super::expectation::poured_mass;
use super::graph::{Candidates, end_components};
use super::query::Optimum;
use crate::imdp::RowId;
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
    let position: HashMap<RowId, u32> = rows.iter().copied().zip(0..).collect();
    let choices = component.sweep.states.iter().map(|&s| {
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
    });
    let support = |&id: &RowId| {
        let row = shared.model.rows().row(id);
        // Less than this is what rounding leaves over.
        let negligible = crate::numeric::rounding_factor(row.len() + 4);
        let poured = poured_mass(row, &shared.lower, Optimum::Min);
        poured.iter().zip(row.lower).map(|(p, l)| *l > 0.0 || *p > negligible).collect()
    };
    let part = Candidates {
        model: shared.model,
        states: &component.sweep.states,
        choices: choices.collect(),
        supports: (players.nature == Optimum::Min).then(|| rows.iter().map(support).collect()),
        rows,
    };
    for class in end_components(&part) {
        let top = class.iter().map(|&i| candidate[i as usize]).fold(0.0, f64::max);
        class.iter().for_each(|&i| candidate[i as usize] = top);
    }
}
