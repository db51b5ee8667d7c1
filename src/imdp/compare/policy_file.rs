//! Policies as they were recorded.

use crate::formats::{LineError, PolicyEntry};
use crate::model::StateId;
use std::collections::BTreeMap;

/// The action taken in a state, at any time or after a number of steps.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PolicyFile {
    /// The action by state and number of steps elapsed; no number if it is the same at all times.
    pub actions: BTreeMap<(StateId, Option<u64>), String>,
}

impl PolicyFile {
    /// Reads a policy.
    ///
    /// # Errors
    /// [`LineError`] for the first line that is not of this form or repeats a state and step.
    pub fn parse(text: &str) -> Result<Self, LineError> {
        let mut actions = BTreeMap::new();
        for (line, entry) in PolicyEntry::read(text) {
            let entry = entry?;
            let found = entry.to_string();
            let PolicyEntry { state, step, action } = entry;
            if actions.insert((state, step), action.into_owned()).is_some() {
                return Err(LineError { line, found, expected: "each state and step once" });
            }
        }
        Ok(Self { actions })
    }
}

#[cfg(test)]
mod tests {
    use super::{PolicyFile, StateId};

    #[test]
    fn both_forms_are_read_and_others_refused() {
        let policy = PolicyFile::parse("3=a_1\n4,0=up\n\n4,1=0\n").unwrap();
        assert_eq!(policy.actions[&(StateId(3), None)], "a_1");
        assert_eq!(policy.actions[&(StateId(4), Some(1))], "0");
        for (text, line) in [("3", 1), ("1=a\nx=b", 2), ("1,x=a", 1), ("1=a\n1=b", 2), ("1=", 1)] {
            assert_eq!(PolicyFile::parse(text).unwrap_err().line, line, "{text}");
        }
    }
}
