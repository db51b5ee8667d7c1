//! What the manifest says of a model with row states.

use imdp::formats::row_states::RowStates;
use serde::{Deserialize, Serialize};

/// The model of the files `rows.*`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RowStatesReport {
    /// The number of states, with one per row.
    pub states: u64,
    /// The number of choices.
    pub choices: u64,
    /// The number of transitions.
    pub transitions: u64,
    /// The label of row states.
    pub label: String,
    /// The property of `rows.props`.
    pub property: String,
    /// Why its value is that of the model.
    pub note: String,
}

impl RowStatesReport {
    /// Describes an encoding and the property that goes with it.
    pub(super) fn new(encoded: &RowStates, property: String) -> Self {
        let size = encoded.model.size();
        Self {
            states: size.states,
            choices: size.choices,
            transitions: size.transitions,
            label: encoded.label.clone(),
            property,
            note: "two steps of this model are one of model.dynabs: to a state that stands for a row, and from there by \
                   the row; the value of this property is that of the property above"
                .into(),
        }
    }
}
