//! What is known of states besides their transitions: labels and variables.

use super::{StateId, StateSet};

/// Named sets of states, in the order in which they were declared.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Labels {
    entries: Vec<(String, StateSet)>,
}

impl Labels {
    /// Adds a label; one of the same name is replaced.
    pub fn insert(&mut self, name: impl Into<String>, states: StateSet) {
        let name = name.into();
        match self.entries.iter_mut().find(|(existing, _)| *existing == name) {
            Some(entry) => entry.1 = states,
            None => self.entries.push((name, states)),
        }
    }

    /// The states with this label.
    pub fn get(&self, name: &str) -> Option<&StateSet> {
        self.entries.iter().find(|(existing, _)| existing == name).map(|(_, states)| states)
    }

    /// All labels.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &StateSet)> {
        self.entries.iter().map(|(name, states)| (name.as_str(), states))
    }
}

/// The values of one variable, by state.
#[derive(Clone, Debug, PartialEq)]
pub enum VariableValues {
    /// An integer variable.
    Int(Vec<i32>),
    /// A Boolean variable.
    Bool(StateSet),
}

/// A variable of the states.
#[derive(Clone, Debug, PartialEq)]
pub struct StateVariable {
    /// Its name, an identifier.
    pub name: String,
    /// Its values.
    pub values: VariableValues,
}

/// The variables of the states, in the order in which they were declared.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StateVariables {
    variables: Vec<StateVariable>,
}

impl StateVariables {
    /// Adds a variable.
    pub fn push(&mut self, name: impl Into<String>, values: VariableValues) {
        self.variables.push(StateVariable { name: name.into(), values });
    }

    /// The variable of this name.
    pub fn get(&self, name: &str) -> Option<&StateVariable> {
        self.variables.iter().find(|variable| variable.name == name)
    }

    /// All variables.
    pub fn iter(&self) -> impl Iterator<Item = &StateVariable> {
        self.variables.iter()
    }

    /// Whether there are no variables.
    pub fn is_empty(&self) -> bool {
        self.variables.is_empty()
    }
}

impl StateVariable {
    /// The number of states it has values for.
    pub fn num_states(&self) -> usize {
        match &self.values {
            VariableValues::Int(values) => values.len(),
            VariableValues::Bool(states) => states.len(),
        }
    }

    /// The value in one state, as PRISM writes it.
    pub fn write_value(&self, state: StateId, out: &mut impl std::fmt::Write) -> std::fmt::Result {
        match &self.values {
            VariableValues::Int(values) => write!(out, "{}", values[state as usize]),
            VariableValues::Bool(states) => write!(out, "{}", states.contains(state as usize)),
        }
    }
}
