//! A small model with everything that a format may have no place for.

use imdp::model::*;

fn set(states: usize, members: &[usize]) -> StateSet {
    let mut set = StateSet::with_capacity(states);
    members.iter().for_each(|&state| set.insert(state));
    set
}

/// Five states: two rows that are shared, an absorbing state, a deadlock, a label without states, both types of
/// variables, choices with and without a name.
pub fn model() -> IntervalMdp {
    let mut rows = Rows::new();
    for entries in [&[(1, 0.2, 0.5), (2, 0.0, 0.8)][..], &[(2, 1.0, 1.0)], &[(0, 1e-300, 1.0), (4, 0.1, 1.0)]]
    {
        entries
            .iter()
            .for_each(|&(successor, lower, upper)| rows.push_entry(StateId(successor), lower, upper));
        rows.finish_row();
    }
    let mut choices = ChoicesBuilder::with_capacity(5);
    choices.push_range(RowRange { first: RowId(0), last: RowId(1) });
    choices.finish_state();
    choices.push_absorbing();
    choices.push_range(RowRange { first: RowId(1), last: RowId(2) });
    choices.finish_state();
    choices.push_range(RowRange { first: RowId(0), last: RowId(0) });
    choices.finish_state();
    choices.finish_state();
    let mut labels = Labels::default();
    labels.insert("goal", set(5, &[1, 4]));
    labels.insert("empty", set(5, &[]));
    labels.insert("bad", set(5, &[3]));
    let mut variables = StateVariables::default();
    variables.push("x1", VariableValues::Int(vec![0, -1, 3, i32::MIN, i32::MAX]));
    variables.push("ok", VariableValues::Bool(set(5, &[0, 2])));
    let names = ["a_0", "b", "c"].map(str::to_owned).to_vec();
    let ids = vec![0, 1, ActionNames::UNNAMED, 1, 2, ActionNames::UNNAMED];
    IntervalMdp::new(Parts {
        kind: ModelKind::Imdp,
        rows,
        choices: choices.finish(),
        actions: ActionNames::OfChoice { names, ids },
        initial: set(5, &[0, 2]),
        labels,
        variables,
    })
    .unwrap()
}
