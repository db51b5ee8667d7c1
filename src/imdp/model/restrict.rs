//! Sub-models: the same states with fewer choices.

use super::{
    ActionNames, ChoicesBuilder, ImdpError, IntervalMdp, Parts, RowBuffer, RowId, RowRange, Rows, StateId,
};

/// The model with only those choices that `keeps(state, choice)` accepts, and only the rows they use.
///
/// Choices are counted within their state, from 0. States, labels, variables and the self-loops of absorbing
/// states stay; choices keep their order and their names, so that `a_<row>` still names the row of `model`.
/// A state that keeps none of its choices becomes a deadlock.
///
/// # Errors
/// Those of [`IntervalMdp::new`]; none, if `model` is an interval MDP.
pub fn restrict(model: &IntervalMdp, keeps: impl Fn(StateId, u32) -> bool) -> Result<IntervalMdp, ImdpError> {
    let keeps = &keeps;
    let states = || StateId::first(model.num_states());
    let kept = |state| {
        let choices = (0..).zip(model.choices().rows(state));
        choices.filter(move |(choice, _)| keeps(state, *choice))
    };
    let kept = &kept;

    let mut renumbered = vec![UNUSED; model.rows().len()];
    states().flat_map(kept).for_each(|(_, row)| renumbered[row.index()] = RowId(0));
    let (mut rows, mut buffer) = (Rows::new(), RowBuffer::default());
    for (id, new) in renumbered.iter_mut().enumerate().filter(|(_, new)| **new != UNUSED) {
        *new = rows.push_row(model.rows().row(RowId::from_index(id), &mut buffer));
    }

    let mut choices = ChoicesBuilder::with_capacity(model.num_states());
    for state in states() {
        if model.choices().is_absorbing(state) {
            choices.push_absorbing();
            continue;
        }
        for (_, row) in kept(state) {
            let row = renumbered[row.index()];
            choices.push_range(RowRange { first: row, last: row });
        }
        choices.finish_state();
    }
    IntervalMdp::new(Parts {
        kind: model.kind(),
        actions: names(model, kept, &renumbered),
        rows,
        choices: choices.finish(),
        initial: model.initial().clone(),
        labels: model.labels().clone(),
        variables: model.variables().clone(),
    })
}

/// Stands for a row that no choice uses any more.
const UNUSED: RowId = RowId::MAX;

/// The names of the choices that are kept.
fn names<K: Iterator<Item = (u32, RowId)>>(
    model: &IntervalMdp,
    kept: impl Fn(StateId) -> K,
    renumbered: &[RowId],
) -> ActionNames {
    let absorbing = |state| model.choices().is_absorbing(state);
    let states = StateId::first(model.num_states());
    match model.actions() {
        ActionNames::None => ActionNames::None,
        ActionNames::OfRow => {
            let used = (0..).zip(renumbered).filter(|(_, new)| **new != UNUSED);
            let names = used.map(|(id, _): (u32, _)| format!("a_{id}")).collect();
            let of_state = |state| {
                let loops = absorbing(state).then_some(ActionNames::UNNAMED);
                loops.into_iter().chain(kept(state).map(|(_, row)| renumbered[row.index()].0))
            };
            ActionNames::OfChoice { names, ids: states.flat_map(of_state).collect() }
        }
        ActionNames::OfChoice { names, ids } => {
            let mut first = 0;
            let mut kept_ids = vec![];
            for state in states {
                if absorbing(state) {
                    kept_ids.push(ids[first]);
                    first += 1;
                } else {
                    kept_ids.extend(kept(state).map(|(choice, _)| ids[first + choice as usize]));
                    first += model.choices().ranges(state).iter().map(|range| range.len()).sum::<usize>();
                }
            }
            ActionNames::OfChoice { names: names.clone(), ids: kept_ids }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Labels, ModelKind, StateSet, StateVariables};

    /// State 0 chooses among all rows, state 1 is absorbing, state 2 chooses row 1.
    fn model(actions: ActionNames) -> IntervalMdp {
        let mut rows = Rows::new();
        for successor in 0..3 {
            rows.push_entry(StateId(successor), 1.0, 1.0);
            rows.finish_row();
        }
        let mut choices = ChoicesBuilder::with_capacity(3);
        choices.push_range(RowRange { first: RowId(0), last: RowId(2) });
        choices.finish_state();
        choices.push_absorbing();
        choices.push_range(RowRange { first: RowId(1), last: RowId(1) });
        choices.finish_state();
        let mut initial = StateSet::with_capacity(3);
        initial.insert(0);
        IntervalMdp::new(Parts {
            kind: ModelKind::Imdp,
            rows,
            choices: choices.finish(),
            actions,
            initial,
            labels: Labels::default(),
            variables: StateVariables::default(),
        })
        .unwrap()
    }

    #[test]
    fn rows_are_renumbered_and_names_are_not() {
        let small =
            restrict(&model(ActionNames::OfRow), |state, choice| state != StateId(0) || choice != 0).unwrap();
        assert_eq!(small.rows().len(), 2);
        assert_eq!(small.rows().row(RowId(0), &mut RowBuffer::default()).successors, [StateId(1)]);
        assert_eq!(small.choices().ranges(StateId(0)), [RowRange { first: RowId(0), last: RowId(1) }]);
        assert!(small.choices().is_absorbing(StateId(1)));
        let names = vec!["a_1".to_owned(), "a_2".to_owned()];
        let ids = vec![0, 1, ActionNames::UNNAMED, 0];
        assert_eq!(*small.actions(), ActionNames::OfChoice { names, ids });
    }

    #[test]
    fn choices_keep_their_own_names_and_states_may_lose_all() {
        let names: Vec<String> = ["left", "right", "stay"].map(String::from).to_vec();
        let all = model(ActionNames::OfChoice { names: names.clone(), ids: vec![0, 1, 0, 2, 1] });
        let small = restrict(&all, |state, choice| (state, choice) == (StateId(0), 2)).unwrap();
        assert_eq!(*small.actions(), ActionNames::OfChoice { names, ids: vec![0, 2] });
        assert!(small.choices().is_deadlock(StateId(2)));
        assert_eq!((small.rows().len(), small.size().transitions), (1, 2));
    }
}
