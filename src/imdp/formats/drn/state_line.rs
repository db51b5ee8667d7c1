//! What is said of a state besides its choices.

use super::header::{Header, end_of_line, read_name};
use super::rewards::RewardNotes;
use super::stopped::Stopped;
use super::valuations::Valuations;
use crate::formats::import::{Cursor, Fault, read_variable_value};
use crate::model::{Labels, MemoryError, StateId, StateSet, StateVariables, VariableValues, require_memory};
use std::collections::HashMap;

/// Labels, values of variables and deadlocks of the states so far.
#[derive(Debug)]
pub(super) struct StateNotes {
    states: usize,
    /// For how many states to make room.
    room: usize,
    initial: StateSet,
    labels: Vec<(String, StateSet)>,
    ids: HashMap<String, usize>,
    names: Vec<String>,
    columns: Vec<VariableValues>,
    /// How many states have values.
    valued: usize,
    /// The last state that is marked as one without choices, and how many there are.
    deadlock: Option<StateId>,
    deadlocks: u64,
    /// What is earned.
    pub rewards: RewardNotes,
    /// Values in comments as Storm writes them.
    valuations: Valuations,
}

impl StateNotes {
    /// Nothing but what the header declares; sets have room for no more states than `fit` in the file.
    ///
    /// # Errors
    /// [`MemoryError`] if so many labels do not fit.
    pub(super) fn new(header: &Header, fit: u64) -> Result<Self, MemoryError> {
        let mut notes = Self {
            states: header.states as usize,
            room: header.states.min(fit) as usize,
            initial: StateSet::new(),
            labels: vec![],
            ids: HashMap::new(),
            names: header.variables.clone(),
            columns: vec![],
            valued: 0,
            deadlock: None,
            deadlocks: 0,
            rewards: RewardNotes::new(&header.rewards),
            valuations: Valuations::default(),
        };
        for name in &header.labels {
            notes.label(name.clone())?;
        }
        Ok(notes)
    }

    fn label(&mut self, name: String) -> Result<&mut StateSet, MemoryError> {
        if name == "init" {
            return Ok(&mut self.initial);
        }
        let next = self.labels.len();
        let id = *self.ids.entry(name.clone()).or_insert(next);
        if id == next {
            if next.is_power_of_two() {
                let bytes = (self.states as u64).div_ceil(8).saturating_mul(2 * next as u64);
                require_memory(format!("{} labels", 2 * next), bytes)?;
            }
            self.labels.push((name, StateSet::new()));
        }
        Ok(&mut self.labels[id].1)
    }

    /// Reads a comment that says something of `state`.
    pub(super) fn read(&mut self, state: Option<StateId>, cursor: &mut Cursor<'_>) -> Result<(), Box<Fault>> {
        let Some(state) = state else { return Ok(()) };
        if cursor.skip(b"deadlock") {
            cursor.line_end("the end of the line")?;
            self.deadlocks += u64::from(self.deadlock.replace(state) != Some(state));
            return Ok(());
        }
        if !cursor.skip(b"values") {
            return Ok(());
        }
        if self.valued != state.index() || self.names.is_empty() {
            return Err(cursor.fault_at(0, "values of declared variables, once and for every state"));
        }
        for variable in 0..self.names.len() {
            cursor.expect(b' ', "one blank and the value of the next variable")?;
            read_variable_value(cursor, state.index(), variable, self.room, &mut self.columns)?;
        }
        self.valued += 1;
        cursor.line_end("the end of the line")
    }

    /// Reads a comment that may hold the values of Storm's variables in `state`.
    pub(super) fn read_comment(&mut self, state: Option<StateId>, comment: &[u8]) {
        if let Some(state) = state.filter(|_| comment.starts_with(b"[")) {
            self.valuations.read(comment, state.index());
        }
    }

    /// Whether a state is marked as one without choices.
    pub(super) fn is_deadlock(&self, state: StateId) -> bool {
        self.deadlock == Some(state)
    }

    /// How many states are marked as ones without choices.
    pub(super) fn deadlocks(&self) -> u64 {
        self.deadlocks
    }

    /// The initial states, the labels, and the variables or the first state without values.
    pub(super) fn finish(mut self) -> (StateSet, Labels, Result<StateVariables, usize>) {
        self.initial.grow(self.states);
        let mut labels = Labels::default();
        for (name, mut set) in self.labels {
            set.grow(self.states);
            labels.insert(name, set);
        }
        if let Some(variables) = self.valuations.finish(self.states).filter(|_| self.names.is_empty()) {
            return (self.initial, labels, Ok(variables));
        }
        let mut variables = StateVariables::default();
        if !self.names.is_empty() && self.valued != self.states {
            return (self.initial, labels, Err(self.valued));
        }
        for (name, mut values) in self.names.into_iter().zip(self.columns) {
            if let VariableValues::Bool(set) = &mut values {
                set.grow(self.states);
            }
            variables.push(name, values);
        }
        (self.initial, labels, Ok(variables))
    }
}

/// Reads the rewards and labels of a state up to the end of the line.
pub(super) fn read_labels(
    cursor: &mut Cursor<'_>,
    state: StateId,
    notes: &mut StateNotes,
) -> Result<(), Stopped> {
    let mut first = true;
    loop {
        let blanks = cursor.skip_blanks();
        if cursor.at_line_end() || cursor.at_end() {
            return Ok(end_of_line(cursor, "the end of the line")?);
        }
        if !blanks {
            return Err(cursor.fault_here("a blank and a label").into());
        }
        match cursor.peek() {
            b'[' if first => {
                notes.rewards.of_state(cursor, state.index())?;
                first = false;
                continue;
            }
            b'!' | b'{' => {
                return Err(cursor.fault_here("a label: rates and observations are not supported").into());
            }
            _ => first = false,
        }
        let start = cursor.offset();
        let set = notes.label(read_name(cursor)?)?;
        set.grow(state.index() + 1);
        if set.put(state.index()) {
            return Err(cursor.fault_at(start, "every label of a state once").into());
        }
    }
}
