//! Policies as lines `state=action` or `state,step=action`.

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
    /// The first line, counted from 1, that is not of this form or repeats a state and step.
    pub fn parse(text: &str) -> Result<Self, (usize, String)> {
        let mut actions = BTreeMap::new();
        for (number, line) in (1..).zip(text.lines()) {
            let line = line.trim();
            if line.is_empty() {
                continue;
            }
            let refuse = || (number, line.to_owned());
            let (key, action) = line.split_once('=').ok_or_else(refuse)?;
            let (state, step) = match key.split_once(',') {
                None => (key, None),
                Some((state, step)) => (state, Some(step.parse().map_err(|_| refuse())?)),
            };
            let state = state.parse().map_err(|_| refuse())?;
            if action.is_empty() || actions.insert((state, step), action.to_owned()).is_some() {
                return Err(refuse());
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
            assert_eq!(PolicyFile::parse(text).unwrap_err().0, line, "{text}");
        }
    }
}
