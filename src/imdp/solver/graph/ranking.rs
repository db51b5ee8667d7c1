//! Ranks that show that the states with a positive lower bound are left almost surely.

use super::super::query::{Direction, Players};
use super::choice_tree::ChoiceTree;
use super::zero_one::Analysis;
use crate::exact::{ExactValues, Replaced, maximal_support};
use crate::model::{ChoicesBuilder, IntervalMdp, RowRange, RowSet, Rows, StateId, StateSet};

/// A rank for every moving state with `L > 0`, as [`crate::verify`] wants it.
///
/// States are numbered in the order in which they are found to lead out of `{L > 0}` with positive
/// probability: a maximising policy by its choice, a minimising one by every choice; a minimising nature by
/// every distribution, a maximising one by some distribution that is optimal for `L`. States that are never
/// found have no rank.
pub(in crate::solver) fn ranks(
    model: &IntervalMdp,
    moving: &StateSet,
    players: Players,
    lower: &[f64],
    exact: &Replaced,
    choices: &[u32],
) -> Vec<(StateId, u32)> {
    let mut outside = StateSet::with_capacity(lower.len());
    (0..lower.len()).filter(|&s| !moving.contains(s) || lower[s] == 0.0).for_each(|s| outside.insert(s));
    let open = |s: StateId| !outside.contains(s.index());
    let tree = match players.policy {
        Direction::Min => ChoiceTree::new(model.rows().len(), model.choices(), open),
        Direction::Max => {
            let mut chosen = ChoicesBuilder::with_capacity(lower.len());
            for state in StateId::first(lower.len()) {
                let row = model.choices().row_of_choice(state, choices[state.index()]);
                row.into_iter().for_each(|row| chosen.push_range(RowRange { first: row, last: row }));
                chosen.finish_state();
            }
            ChoiceTree::new(model.rows().len(), &chosen.finish(), open)
        }
    };
    let lower = ExactValues::to_compare(lower, exact);
    let supports: Option<RowSet> =
        (players.nature == Direction::Max).then(|| maximal_supports(model.rows(), &lower).into());
    // Of a support, every distribution is taken to give all of it positive probability.
    let players = Players { nature: Direction::Min, ..players };
    let rows = supports.as_ref().unwrap_or(model.rows());
    let mut all = StateSet::with_capacity(rows.len());
    all.insert_range(..);
    let mut ranks = vec![];
    Analysis::new(rows, &outside, players, &tree).attract_with(&all, |state, _| {
        ranks.push((state, ranks.len() as u32 + 1));
    });
    ranks.sort_unstable();
    ranks
}

/// The rows reduced to what optimal distributions of a maximising nature may use, with bounds above 0.
fn maximal_supports(rows: &RowSet, lower: &ExactValues<'_>) -> Rows {
    let mut supports = Rows::with_capacity(rows.len(), rows.num_entries());
    rows.for_each(|_, row| {
        let support = maximal_support(row, lower).unwrap_or_default();
        for (&s, _) in row.successors.iter().zip(support).filter(|(_, possible)| *possible) {
            supports.push_entry(s, f64::MIN_POSITIVE, 1.0);
        }
        supports.finish_row();
    });
    supports
}
