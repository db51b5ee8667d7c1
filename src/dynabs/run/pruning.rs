//! What the manifest says about pruning.

use imdp::model::Size;
use imdp::property::Property;
use imdp::solver::Pruned;
use serde::{Deserialize, Serialize};

/// What pruning kept, and why the value is preserved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PruningReport {
    /// The property whose value is preserved.
    pub property: String,
    /// What was kept.
    pub kept: String,
    /// Why the value is preserved.
    pub preserved: String,
    /// What is not preserved.
    pub scope: String,
    /// The number of choices of the whole model.
    pub choices_before: u64,
    /// The number of transitions of the whole model.
    pub transitions_before: u64,
    /// The number of distinct rows of the whole model.
    pub rows_before: u64,
    /// Bounds on the value of the whole model at the initial states.
    pub value_before: [f64; 2],
    /// Bounds on the value of what is left at the initial states.
    pub value_after: [f64; 2],
    /// How far apart the bounds of any state of the whole model are: the value of no state changed by more.
    pub largest_gap: f64,
}

impl PruningReport {
    /// Describes how a model of this size was pruned.
    pub fn new(property: &Property, before: Size, pruned: &Pruned) -> Self {
        let after = pruned.model.size();
        Self {
            property: property.to_string(),
            kept: format!(
                "pruned: {} of {} choices and {} of {} transitions are left, those of actions that one optimal policy \
                 takes at some step",
                after.choices, before.choices, after.transitions, before.transitions
            ),
            preserved:
                "the policy that attains the lower bound is still there, and fewer choices cannot raise a \
                        maximum; the pruned model was solved again to check it"
                    .into(),
            scope: format!("only {property} keeps its value, other properties may have any"),
            choices_before: before.choices,
            transitions_before: before.transitions,
            rows_before: before.rows,
            value_before: [pruned.before.lower, pruned.before.upper],
            value_after: [pruned.after.lower, pruned.after.upper],
            largest_gap: pruned.before.values.gap(),
        }
    }
}
