//! What is known of states besides their transitions: labels and variables.

use super::{StateId, StateSet};
use std::collections::HashMap;

/// Named sets of states, in the order in which they were declared.
#[derive(Clone, Debug, Default)]
pub struct Labels {
    entries: Vec<(String, StateSet)>,
    /// Where each name is in `entries`.
    places: HashMap<String, usize>,
}

impl PartialEq for Labels {
    fn eq(&self, other: &Self) -> bool {
        self.entries == other.entries
    }
}

impl Labels {
    /// Adds a label; one of the same name is replaced.
    pub fn insert(&mut self, name: impl Into<String>, states: StateSet) {
        let name = name.into();
        let next = self.entries.len();
        match *self.places.entry(name.clone()).or_insert(next) {
            place if place < next => self.entries[place].1 = states,
            _ => self.entries.push((name, states)),
        }
    }

    /// The states with this label.
    pub fn get(&self, name: &str) -> Option<&StateSet> {
        self.places.get(name).map(|&place| &self.entries[place].1)
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
#[derive(Clone, Debug, Default)]
pub struct StateVariables {
    variables: Vec<StateVariable>,
    /// Where each name is in `variables`.
    places: HashMap<String, usize>,
}

impl PartialEq for StateVariables {
    fn eq(&self, other: &Self) -> bool {
        self.variables == other.variables
    }
}

impl StateVariables {
    /// Adds a variable.
    pub fn push(&mut self, name: impl Into<String>, values: VariableValues) {
        let name = name.into();
        self.places.entry(name.clone()).or_insert(self.variables.len());
        self.variables.push(StateVariable { name, values });
    }

    /// The variable of this name.
    pub fn get(&self, name: &str) -> Option<&StateVariable> {
        self.places.get(name).map(|&place| &self.variables[place])
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
            VariableValues::Int(values) => write!(out, "{}", values[state.index()]),
            VariableValues::Bool(states) => write!(out, "{}", states.contains(state.index())),
        }
    }
}
