//! The names of the members of an archive.

pub(super) const INDEX: &str = "index.json";
pub(super) const STATE_TO_CHOICES: &str = "state-to-choices.bin";
pub(super) const CHOICE_TO_BRANCHES: &str = "choice-to-branches.bin";
pub(super) const STATE_IS_INITIAL: &str = "state-is-initial.bin";
pub(super) const BRANCH_TO_TARGET: &str = "branch-to-target.bin";
pub(super) const BRANCH_TO_PROBABILITY: &str = "branch-to-probability.bin";
pub(super) const VALUATIONS: &str = "valuations/states/valuations.bin";

/// Where the names of actions are, of choices or of branches.
pub(super) struct ActionMembers {
    /// Per choice or branch, the index of its name.
    pub values: &'static str,
    /// Where each name starts in `strings`.
    pub mapping: &'static str,
    /// All names, one after the other.
    pub strings: &'static str,
}

pub(super) const CHOICE_ACTIONS: ActionMembers = ActionMembers {
    values: "actions/choices/values.bin",
    mapping: "actions/choices/string-mapping.bin",
    strings: "actions/choices/strings.bin",
};

pub(super) const BRANCH_ACTIONS: ActionMembers = ActionMembers {
    values: "actions/branches/values.bin",
    mapping: "actions/branches/string-mapping.bin",
    strings: "actions/branches/strings.bin",
};

/// The group of annotations that are labels.
pub(super) const APS: &str = "aps";
/// The group of annotations that are rewards.
pub(super) const REWARDS: &str = "rewards";
/// The group of our own annotations.
pub(super) const OWN: &str = "dynabs";
/// Which of them marks the states without choices.
pub(super) const WITHOUT_CHOICES: &str = "without-choices";
/// The parameter that says what lower bounds of 0 are written as.
pub(super) const ZERO_LOWER_BOUND: &str = "zero-lower-bound";

/// The values of an annotation of states.
pub(super) fn state_annotation(group: &str, id: &str) -> String {
    format!("annotations/{group}/{id}/states/values.bin")
}

/// The number of bytes of one bit per state, filled up to whole words.
pub(super) fn bitset_bytes(states: u64) -> u64 {
    states.div_ceil(64) * 8
}
