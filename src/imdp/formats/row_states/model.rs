//! The model with row states.

use crate::model::{
    ActionNames, ChoicesBuilder, ImdpError, IntervalMdp, Labels, MemoryError, Parts, RowBuffer, RowId,
    RowRange, Rows, StateId, StateSet, StateVariables, VariableValues, require_memory,
};

/// A model in the row-sharing encoding.
#[derive(Clone, Debug)]
pub struct RowStates {
    /// The model: its first states are those of the original.
    pub model: IntervalMdp,
    /// The label of row states: `row`, or that with `_` behind it if the original has such a label.
    pub label: String,
}

/// Why a model or a property cannot be encoded.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum EncodingError {
    /// States and rows together are too many.
    #[error(
        "found {states} states and {rows} rows; expected at most {} together for one state per row",
        StateId::MAX
    )]
    TooLarge {
        /// The number of states.
        states: usize,
        /// The number of rows.
        rows: usize,
    },
    /// The doubled number of steps is more than PRISM reads.
    #[error("{property}: found {steps} steps, which double; expected at most {} for PRISM", i32::MAX / 2)]
    Steps {
        /// The property.
        property: String,
        /// Its number of steps.
        steps: u64,
    },
    /// It does not fit into memory.
    #[error(transparent)]
    Memory(#[from] MemoryError),
    /// The parts do not make a model.
    #[error(transparent)]
    Model(#[from] ImdpError),
}

impl RowStates {
    /// Encodes a model; rows that no state chooses are left out.
    ///
    /// # Errors
    /// [`EncodingError::TooLarge`] or [`EncodingError::Memory`].
    pub fn new(model: &IntervalMdp) -> Result<Self, EncodingError> {
        let states = model.num_states();
        let used = used_rows(model);
        let count = used.iter().filter(|&&used| used).count();
        // Every row becomes two, and ids must stay below the largest number.
        if states.max(count) + count >= StateId::MAX.index() {
            return Err(EncodingError::TooLarge { states, rows: count });
        }
        let ranges = model.choices().num_ranges() + count;
        // The rows again and one for each, ranges in a list that grows, and per state what states have.
        let bytes = 20 * (model.rows().num_entries() + 2 * count) + 16 * ranges + 48 * (states + count);
        require_memory("the model with row states", bytes as u64)?;
        let mut new_ids = Vec::with_capacity(used.len());
        let mut next = RowId(0);
        for &used in &used {
            new_ids.push(next);
            next.0 += u32::from(used);
        }
        let all = states + count;
        let label = fresh_label(model);
        let mut labels = Labels::default();
        for (name, set) in model.labels().iter() {
            labels.insert(name, widened(set, all));
        }
        let mut rows_set = StateSet::with_capacity(all);
        rows_set.insert_range(states..all);
        labels.insert(label.clone(), rows_set);
        let model = IntervalMdp::new(Parts {
            kind: model.kind(),
            rows: rows(model, &used, count),
            choices: choices(model, &new_ids, count),
            actions: actions(model, &new_ids, &used, count),
            initial: widened(model.initial(), all),
            labels,
            variables: variables(model, count),
        })?;
        Ok(Self { model, label })
    }
}

fn used_rows(model: &IntervalMdp) -> Vec<bool> {
    let mut used = vec![false; model.rows().len()];
    for state in StateId::first(model.num_states()) {
        for range in model.choices().ranges(state) {
            used[range.first.index()..=range.last.index()].fill(true);
        }
    }
    used
}

fn fresh_label(model: &IntervalMdp) -> String {
    let mut label = "row".to_owned();
    while model.labels().get(&label).is_some() {
        label.push('_');
    }
    label
}

fn widened(set: &StateSet, states: usize) -> StateSet {
    let mut set = set.clone();
    set.grow(states);
    set
}

/// First the rows that lead to row states, then the rows themselves.
fn rows(model: &IntervalMdp, used: &[bool], count: usize) -> Rows {
    let mut rows = Rows::with_capacity(2 * count, model.rows().num_entries() + count);
    let states = model.num_states();
    for state in states..states + count {
        rows.push_entry(StateId::from_index(state), 1.0, 1.0);
        rows.finish_row();
    }
    let mut buffer = RowBuffer::default();
    for (id, _) in RowId::first(used.len()).zip(used).filter(|(_, used)| **used) {
        rows.push_row(model.rows().row(id, &mut buffer));
    }
    rows
}

fn choices(model: &IntervalMdp, new_ids: &[RowId], count: usize) -> crate::model::Choices {
    let states = model.num_states();
    let mut choices = ChoicesBuilder::with_capacity(states + count);
    for state in StateId::first(states) {
        if model.choices().is_absorbing(state) {
            choices.push_absorbing();
            continue;
        }
        for range in model.choices().ranges(state) {
            let [first, last] = [range.first, range.last].map(|row| new_ids[row.index()]);
            choices.push_range(RowRange { first, last });
        }
        choices.finish_state();
    }
    for row in count..2 * count {
        choices.push_range(RowRange { first: RowId::from_index(row), last: RowId::from_index(row) });
        choices.finish_state();
    }
    choices.finish()
}

/// The choices of row states have no name.
fn actions(model: &IntervalMdp, new_ids: &[RowId], used: &[bool], count: usize) -> ActionNames {
    let of_rows = std::iter::repeat_n(ActionNames::UNNAMED, count);
    match model.actions() {
        ActionNames::None => ActionNames::None,
        ActionNames::OfChoice { names, ids } => {
            ActionNames::OfChoice { names: names.clone(), ids: ids.iter().copied().chain(of_rows).collect() }
        }
        ActionNames::OfRow => {
            let named = used.iter().enumerate().filter(|(_, used)| **used);
            let names = named.map(|(row, _)| format!("a_{row}")).collect();
            let mut ids = Vec::with_capacity(model.size().choices as usize + count);
            for state in StateId::first(model.num_states()) {
                if model.choices().is_absorbing(state) {
                    ids.push(ActionNames::UNNAMED);
                }
                ids.extend(model.choices().rows(state).map(|row| new_ids[row.index()].0));
            }
            ids.extend(of_rows);
            ActionNames::OfChoice { names, ids }
        }
    }
}

fn variables(model: &IntervalMdp, count: usize) -> StateVariables {
    let mut variables = StateVariables::default();
    for variable in model.variables().iter() {
        let values = match &variable.values {
            VariableValues::Int(values) => {
                let first = values.first().copied().unwrap_or_default();
                VariableValues::Int(values.iter().copied().chain(std::iter::repeat_n(first, count)).collect())
            }
            VariableValues::Bool(set) => {
                let states = model.num_states();
                let mut set = widened(set, states + count);
                if set.contains(0) {
                    set.insert_range(states..states + count);
                }
                VariableValues::Bool(set)
            }
        };
        variables.push(variable.name.clone(), values);
    }
    variables
}
