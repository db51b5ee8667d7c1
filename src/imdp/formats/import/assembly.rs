//! From choices, state by state, to the rows and choices of a model.

use std::collections::HashMap;

use super::Imported;
use super::error::{ImportError, Warning};
use super::row_table::{RowTable, hash_row};
use crate::model::{
    ActionNames, Choices, ChoicesBuilder, IntervalMdp, Labels, MemoryError, ModelKind, Parts, Row, RowId,
    RowRange, Rows, StateId, StateSet, StateVariables, require_memory,
};

/// What an entry of [`Rows`] takes: a successor and two bounds.
const ENTRY_BYTES: u64 = 20;

/// Room that is always made, in entries.
const SMALL: u64 = 1 << 16;

/// The transitions of a model.
#[derive(Debug)]
pub(crate) struct Transitions {
    pub rows: Rows,
    pub choices: Choices,
    pub actions: ActionNames,
    /// About states without choices.
    pub warnings: Vec<Warning>,
}

impl Transitions {
    /// The model that these transitions and what the file says about its states are.
    pub(crate) fn into_model(
        self,
        kind: ModelKind,
        initial: StateSet,
        labels: Labels,
        variables: StateVariables,
    ) -> Result<Imported, ImportError> {
        let Self { rows, choices, actions, warnings } = self;
        let model = IntervalMdp::new(Parts { kind, rows, choices, actions, initial, labels, variables })?;
        Ok(Imported { model, warnings, properties: String::new() })
    }
}

/// How large a model is going to be, as far as a file has said so far.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expected {
    pub states: u64,
    pub choices: u64,
    /// No more than this many transitions come.
    pub transitions: u64,
}

/// Collects the choices of states in order and shares equal rows.
#[derive(Debug)]
pub(crate) struct Assembly {
    expected: Expected,
    rows: Rows,
    /// Entries that fit into `rows` without asking again.
    capacity: u64,
    table: RowTable,
    choices: ChoicesBuilder,
    num_choices: u64,
    num_transitions: u64,
    /// The last state that has choices so far.
    last: Option<StateId>,
    /// The last state's only choice so far is to stay.
    stays: bool,
    name_ids: HashMap<String, u32>,
    action_ids: Vec<u32>,
    deadlocks: Option<(u64, StateId)>,
}

/// Why a choice cannot be added.
#[derive(Debug)]
pub(crate) enum AssemblyError {
    /// It does not fit into memory.
    Memory(MemoryError),
    /// There are more rows than [`RowId`] can number.
    TooManyRows,
}

impl AssemblyError {
    /// What was expected instead of [`TooManyRows`](Self::TooManyRows).
    pub(crate) fn at_most() -> String {
        format!("at most {} distinct rows", RowId::MAX)
    }
}

impl Assembly {
    /// Nothing added yet.
    ///
    /// # Errors
    /// [`MemoryError`] if so many states do not fit.
    pub(crate) fn new(expected: Expected) -> Result<Self, MemoryError> {
        require_memory(format!("{} states", expected.states), expected.states.saturating_mul(9))?;
        Ok(Self {
            expected,
            rows: Rows::new(),
            capacity: 0,
            table: RowTable::default(),
            // States without transitions are believed when they are reached.
            choices: ChoicesBuilder::with_capacity(expected.states.min(expected.transitions) as usize),
            num_choices: 0,
            num_transitions: 0,
            last: None,
            stays: false,
            name_ids: HashMap::new(),
            action_ids: vec![],
            deadlocks: None,
        })
    }

    /// The number of choices so far.
    pub(crate) fn num_choices(&self) -> u64 {
        self.num_choices
    }

    /// The number of transitions so far.
    pub(crate) fn num_transitions(&self) -> u64 {
        self.num_transitions
    }

    /// The id of an action.
    pub(crate) fn action(&mut self, name: &str) -> u32 {
        if let Some(&id) = self.name_ids.get(name) {
            return id;
        }
        let id = self.name_ids.len() as u32;
        self.name_ids.insert(name.to_owned(), id);
        id
    }

    /// Adds a choice of `state`, which is that of the last choice or a later one; `hash` is that of the row.
    pub(crate) fn push(
        &mut self,
        state: StateId,
        hash: u32,
        row: Row<'_>,
        action: Option<u32>,
    ) -> Result<(), AssemblyError> {
        let is_first = self.last != Some(state);
        if is_first {
            self.finish_states_before(state);
            self.last = Some(state);
        } else if self.stays {
            // It has company, so it is a choice like any other.
            self.stays = false;
            let itself = Row { successors: &[state], lower: &[1.0], upper: &[1.0], exact: &[] };
            self.share(hash_row(itself), itself)?;
        }
        self.push_action(action);
        self.num_choices += 1;
        self.num_transitions += row.len() as u64;
        if is_first && row.successors == [state] && row.lower == [1.0] && row.exact.is_empty() {
            self.stays = true;
            return Ok(());
        }
        self.make_room(row.len() as u64).map_err(AssemblyError::Memory)?;
        self.share(hash, row)
    }

    fn finish_states_before(&mut self, next: StateId) {
        let first = match self.last {
            None => StateId(0),
            Some(state) if self.stays => {
                self.stays = false;
                self.choices.push_absorbing();
                state.next()
            }
            Some(state) => {
                self.choices.finish_state();
                state.next()
            }
        };
        for _ in first.0..next.0 {
            self.choices.finish_state();
        }
        if first < next {
            self.deadlocks.get_or_insert((0, first)).0 += u64::from(next.0 - first.0);
        }
    }

    /// Adds a choice of the row, stored once.
    fn share(&mut self, hash: u32, row: Row<'_>) -> Result<(), AssemblyError> {
        let id = match self.table.find(hash, row, &self.rows) {
            Some(id) => id,
            None => {
                if self.rows.len() >= RowId::MAX.index() {
                    return Err(AssemblyError::TooManyRows);
                }
                let id = self.rows.push_row(row);
                self.table.insert(hash, id);
                id
            }
        };
        self.choices.push_range(RowRange { first: id, last: id });
        Ok(())
    }

    /// Makes room for one more row of this length: all that can come where rows hardly repeat, else double.
    fn make_room(&mut self, len: u64) -> Result<(), MemoryError> {
        let kept = self.rows.num_entries() as u64;
        if kept + len <= self.capacity {
            return Ok(());
        }
        let left = self.expected.transitions.saturating_sub(self.num_transitions) + len;
        let hardly_shared = kept > 0 && kept * 2 >= self.num_transitions;
        let more = if hardly_shared { left } else { kept.max(SMALL).min(left) }.max(len);
        require_memory(format!("{more} more transitions"), more.saturating_mul(ENTRY_BYTES))?;
        self.rows.reserve_exact(more as usize);
        self.capacity = kept + more;
        Ok(())
    }

    /// Notes the action of the next choice, unless no choice has had any so far.
    fn push_action(&mut self, id: Option<u32>) {
        if self.action_ids.is_empty() && id.is_some() {
            let expected = self.expected.choices.min(self.expected.transitions);
            self.action_ids.reserve_exact(expected as usize);
            self.action_ids.resize(self.num_choices as usize, ActionNames::UNNAMED);
        }
        if id.is_some() || !self.action_ids.is_empty() {
            self.action_ids.push(id.unwrap_or(ActionNames::UNNAMED));
        }
    }

    /// Ends the last state; those that follow have no choices.
    pub(crate) fn finish(mut self) -> Transitions {
        self.finish_states_before(StateId(self.expected.states as u32));
        let mut names = vec![String::new(); self.name_ids.len()];
        for (name, id) in self.name_ids {
            names[id as usize] = name;
        }
        let actions = match self.action_ids.is_empty() {
            true => ActionNames::None,
            false => ActionNames::OfChoice { names, ids: self.action_ids },
        };
        self.rows.shrink_to_fit();
        let deadlocks = self.deadlocks.map(|(count, first)| Warning::Deadlocks { count, first });
        let warnings = deadlocks.into_iter().collect();
        Transitions { rows: self.rows, choices: self.choices.finish(), actions, warnings }
    }
}
