//! Policies as text: the form of PRISM's `-exportstrat f:type=actions,states=false`.

use super::LineError;
use crate::model::StateId;
use std::borrow::Cow;
use std::fmt;

/// One line of a policy, `state=action` or `state,step=action`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PolicyEntry<'a> {
    /// The state.
    pub state: StateId,
    /// The number of steps elapsed; none if the action is the same at all times.
    pub step: Option<u64>,
    /// The name of the action, or the index of the choice.
    pub action: Cow<'a, str>,
}

impl<'a> PolicyEntry<'a> {
    /// The form that lines have.
    pub const EXPECTED: &'static str = "state=action or state,step=action";

    /// Reads the lines of a policy; blank ones say nothing.
    pub fn read(text: &'a str) -> impl Iterator<Item = (usize, Result<Self, LineError>)> {
        let lines = (1..).zip(text.lines().map(str::trim)).filter(|(_, found)| !found.is_empty());
        lines.map(|(line, found)| {
            let refused = || LineError { line, found: found.to_owned(), expected: PolicyEntry::EXPECTED };
            (line, Self::of_line(found).ok_or_else(refused))
        })
    }

    fn of_line(line: &'a str) -> Option<Self> {
        let (key, action) = line.split_once('=').filter(|(_, action)| !action.is_empty())?;
        let (state, step) = match key.split_once(',') {
            None => (key, None),
            Some((state, step)) => (state, Some(step.parse().ok()?)),
        };
        Some(Self { state: state.parse().ok()?, step, action: action.into() })
    }
}

impl fmt::Display for PolicyEntry<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { state, step, action } = self;
        match step {
            None => write!(f, "{state}={action}"),
            Some(step) => write!(f, "{state},{step}={action}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read() {
        for text in ["3=a_1", "4,0=up", "0,18446744073709551615=0"] {
            let entries: Vec<_> = PolicyEntry::read(text).map(|(_, entry)| entry.unwrap()).collect();
            assert_eq!(entries.len(), 1);
            assert_eq!(entries[0].to_string(), text);
        }
    }

    #[test]
    fn other_lines_are_refused() {
        for text in ["3", "x=b", "1,x=a", "1=", "=a", "1,2,3=a"] {
            let (line, entry) =
                PolicyEntry::read(&format!("\n0=a\n{text}\n")).last().map(|(l, e)| (l, e.is_err())).unwrap();
            assert_eq!((line, entry), (3, true), "{text}");
        }
    }
}
