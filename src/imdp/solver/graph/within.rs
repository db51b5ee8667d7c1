//! Where the value with a bound on the steps is 0, and where it is 1, decided exactly.
//!
//! With `k` steps the value is positive, or 1, in the goal and where `Q_a Q_p p(X) > 0`, or `p(X) = 1`, for the set `X` in
//! which it is with `k − 1` steps (`zero_one` has the notation). These sets grow, and stay the same once they do not.

use super::super::query::Players;
use super::choice_tree::ChoiceTree;
use super::zero_one::{Predecessors, hits, stays};
use crate::model::{IntervalMdp, RowId, StateId, StateSet};

/// The states of positive value and those of value 1, after so many steps from values of 1 in `goal` and 0 elsewhere: in the
/// states of `moving`; others keep their values.
pub(in crate::solver) fn within(
    model: &IntervalMdp,
    goal: &StateSet,
    moving: &StateSet,
    players: Players,
    steps: u64,
) -> (StateSet, StateSet) {
    let rows = model.rows();
    let Players { policy, nature } = players;
    let tree = ChoiceTree::new(rows.len(), model.choices(), |s| moving.contains(s.index()));
    let predecessors = Predecessors::new(rows, goal.len());
    let grown = |satisfies: &dyn Fn(RowId, &StateSet) -> bool| {
        let (mut inside, mut fresh) = (goal.clone(), goal.ones().collect::<Vec<_>>());
        let mut found = goal.clone();
        found.difference_with(moving);
        let mut collector = tree.collect(policy);
        let (mut done, mut seen) = (StateSet::with_capacity(rows.len()), StateSet::with_capacity(rows.len()));
        for _ in 0..steps {
            let mut asked: Vec<RowId> = vec![];
            for state in fresh.drain(..) {
                let new = predecessors.get(StateId::from_index(state)).iter();
                asked.extend(new.filter(|row| !done.contains(row.index()) && !seen.put(row.index())));
            }
            let mut joined = vec![];
            for row in asked {
                seen.set(row.index(), false);
                if satisfies(row, &inside) {
                    done.insert(row.index());
                    collector.add(row, |state| joined.push(state.index()));
                }
            }
            found.extend(joined.iter().copied());
            fresh.extend(joined.into_iter().filter(|&state| !inside.put(state)));
            if fresh.is_empty() {
                break;
            }
        }
        found
    };
    (
        grown(&|row, set| hits(rows.row(row), nature, |s| set.contains(s.index()))),
        grown(&|row, set| stays(rows.row(row), nature, |s| set.contains(s.index()))),
    )
}
