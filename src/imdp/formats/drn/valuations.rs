//! Values of variables as Storm writes them in a comment behind a state: `//[x=1 & !b]`.

use crate::formats::names::is_identifier;
use crate::model::{StateSet, StateVariables, VariableValues};

/// The values so far, as long as every state has one for the same variables.
#[derive(Debug, Default)]
pub(super) struct Valuations {
    names: Vec<String>,
    columns: Vec<VariableValues>,
    /// How many states have values.
    valued: usize,
    /// Something was not as expected: these were comments of another kind.
    spoilt: bool,
}

enum Value {
    Bool(bool),
    Int(i32),
}

impl Valuations {
    /// Reads the comment of a state, all that follows `//`.
    pub(super) fn read(&mut self, comment: &[u8], state: usize) {
        if self.spoilt {
            return;
        }
        let assignments = std::str::from_utf8(comment).ok().and_then(assignments);
        self.spoilt = assignments.and_then(|assignments| self.note(assignments, state)).is_none();
    }

    fn note(&mut self, assignments: Vec<(&str, Value)>, state: usize) -> Option<()> {
        if state != self.valued {
            return None;
        }
        if state == 0 {
            for (name, value) in &assignments {
                if self.names.iter().any(|earlier| earlier == name) {
                    return None;
                }
                self.names.push((*name).to_owned());
                self.columns.push(match value {
                    Value::Bool(_) => VariableValues::Bool(StateSet::new()),
                    Value::Int(_) => VariableValues::Int(vec![]),
                });
            }
        }
        if assignments.len() != self.names.len() {
            return None;
        }
        for ((name, value), (known, column)) in
            assignments.into_iter().zip(self.names.iter().zip(&mut self.columns))
        {
            match (column, value) {
                (VariableValues::Bool(set), Value::Bool(value)) if name == known => {
                    set.grow(state + 1);
                    set.set(state, value);
                }
                (VariableValues::Int(values), Value::Int(value)) if name == known => values.push(value),
                _ => return None,
            }
        }
        self.valued += 1;
        Some(())
    }

    /// The variables, if all of so many states have values.
    pub(super) fn finish(self, states: usize) -> Option<StateVariables> {
        if self.spoilt || self.valued != states || self.names.is_empty() {
            return None;
        }
        let mut variables = StateVariables::default();
        for (name, values) in self.names.into_iter().zip(self.columns) {
            variables.push(name, values);
        }
        Some(variables)
    }
}

/// `[x=1 & !b & c]` as assignments.
fn assignments(comment: &str) -> Option<Vec<(&str, Value)>> {
    let inside = comment.trim().strip_prefix('[')?.strip_suffix(']')?;
    let assignment = |text| {
        let (name, value) = assignment(text)?;
        is_identifier(name).then_some((name, value))
    };
    inside.split('&').map(assignment).collect()
}

fn assignment(text: &str) -> Option<(&str, Value)> {
    let text = text.trim();
    Some(match (text.split_once('='), text.strip_prefix('!')) {
        (Some((name, value)), _) => (name.trim_end(), Value::Int(value.trim().parse().ok()?)),
        (None, Some(name)) => (name, Value::Bool(false)),
        (None, None) => (text, Value::Bool(true)),
    })
}
