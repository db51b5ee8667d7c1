//! Upper bounds that have a chance to be inductive in end components.

use super::expectation::poured_mass;
use super::graph::{Candidates, can_stay, end_components, stays};
use super::query::Direction;
use super::shared::Shared;
use super::sweep::Sweep;
use crate::model::{RowId, StateId};
use std::collections::HashMap;

/// Where upper bounds must be level, and the rows that cannot raise them there.
#[derive(Default)]
pub(super) struct LevelSets {
    /// End components, as positions in the component's states.
    pub classes: Vec<Vec<u32>>,
    /// Rows with `opt_p p·U ≤ max_C U` for a class `C`, decided exactly: rounding must not matter there.
    ///
    /// For a minimising nature `p(C) = 1` is possible, for a maximising one it is inevitable.
    pub capped: Vec<(RowId, usize)>,
}

impl LevelSets {
    /// Raises a candidate to its maximum over each class.
    pub(super) fn raise(&self, candidate: &mut [f64]) {
        for class in &self.classes {
            let top = maximum(class, candidate);
            class.iter().for_each(|&i| candidate[i as usize] = top);
        }
    }

    /// Lowers row values at a candidate to what is known exactly; returns whether there is any such row.
    pub(super) fn cap(&self, candidate: &[f64], weights: &mut [f64]) -> bool {
        let tops: Vec<f64> = self.classes.iter().map(|class| maximum(class, candidate)).collect();
        for &(row, class) in &self.capped {
            let weight = &mut weights[row.index()];
            *weight = weight.min(tops[class]);
        }
        !self.capped.is_empty()
    }
}

fn maximum(class: &[u32], candidate: &[f64]) -> f64 {
    class.iter().map(|&i| candidate[i as usize]).fold(0.0, f64::max)
}

/// The end components of the maximising side.
///
/// Every minimising side is fixed to what is best for the current lower bounds.
pub(super) fn levels(shared: &Shared<'_>, sweep: &Sweep<'_>) -> LevelSets {
    let players = shared.players;
    if (players.policy, players.nature) == (Direction::Min, Direction::Min) {
        // Who minimises in an end component stays there for value 0: such states are known already.
        return LevelSets::default();
    }
    let rows: Vec<RowId> = sweep.rows().collect();
    let supports: Option<Vec<Vec<bool>>> = (players.nature == Direction::Min)
        .then(|| rows.iter().map(|&id| minimal_support(shared, id)).collect());
    // Most rows can leave for a finished state: they are in no end component.
    let inside = |s: StateId| sweep.states.binary_search(&s).is_ok();
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
        return LevelSets::default();
    }
    let choices_of = |&s: &StateId| -> Vec<u32> {
        let all = shared.model.choices().rows(s);
        match players.policy {
            Direction::Max => all.filter_map(|row| position.get(&row).copied()).collect(),
            Direction::Min => {
                greedy_row(shared, s).and_then(|row| position.get(&row).copied()).into_iter().collect()
            }
        }
    };
    let choices = sweep.states.iter().map(choices_of).collect();
    let part = Candidates { model: shared.model, states: &sweep.states, choices, supports, rows };
    let classes = end_components(&part);
    let capped = capped_rows((shared, sweep), &classes, &part.rows);
    LevelSets { classes, capped }
}

/// What a minimising policy chooses for the current lower bounds.
pub(super) fn greedy_row(shared: &Shared<'_>, state: StateId) -> Option<RowId> {
    let best = shared.lower_rows.best(shared.model.choices().ranges(state));
    shared.model.choices().rows(state).find(|&row| shared.lower_rows.values()[row.index()] <= best)
}

fn capped_rows(
    (shared, sweep): (&Shared<'_>, &Sweep<'_>),
    classes: &[Vec<u32>],
    rows: &[RowId],
) -> Vec<(RowId, usize)> {
    let members = classes.iter().zip(0..).flat_map(|(class, index)| class.iter().map(move |&i| (i, index)));
    let label: HashMap<StateId, usize> =
        members.map(|(i, index)| (sweep.states[i as usize], index)).collect();
    let class_of = |&id: &RowId| {
        let row = shared.model.rows().row(id);
        let mut tried = None;
        let mut candidates = row.successors.iter().filter_map(|s| label.get(s).copied());
        let class = candidates.find(|&class| {
            let repeated = tried.replace(class) == Some(class);
            let inside = |s: StateId| label.get(&s) == Some(&class);
            !repeated && stays(row, shared.players.nature.flipped(), inside)
        });
        class.map(|class| (id, class))
    };
    rows.iter().filter_map(class_of).collect()
}

/// Where a minimising nature puts mass at the current lower bounds.
fn minimal_support(shared: &Shared<'_>, id: RowId) -> Vec<bool> {
    let row = shared.model.rows().row(id);
    // Less than this is what rounding leaves over.
    let negligible = crate::numeric::rounding_factor(row.len() + 4);
    let poured = poured_mass(row, &shared.lower, Direction::Min);
    poured.iter().zip(row.lower).map(|(p, l)| *l > 0.0 || *p > negligible).collect()
}
