//! From parsed chunks, in order, to the rows and choices of a model.

use std::collections::HashMap;
use std::path::Path;

use super::error::{Fault, ImportError, Position, Warning};
use super::parse_chunk::{ParsedChoice, ParsedChunk};
use super::row_table::{RowTable, hash_row};
use crate::imdp::{
    ActionNames, Choices, ChoicesBuilder, Row, RowId, RowRange, Rows, StateId, require_memory,
};

/// What an entry of [`Rows`] takes: a successor and two bounds.
const ENTRY_BYTES: u64 = 20;

/// Room that is always made, in entries.
const SMALL: u64 = 1 << 16;

/// The numbers of a header.
#[derive(Clone, Copy, Debug)]
pub(super) struct Header {
    /// The number of states.
    pub states: u64,
    /// The number of choices; interval DTMCs do not give it.
    pub choices: Option<u64>,
    /// The number of transitions.
    pub transitions: u64,
    /// The line of the header, from 0.
    pub line: u64,
}

/// What a `.tra` file describes.
#[derive(Debug)]
pub(super) struct Transitions {
    pub rows: Rows,
    pub choices: Choices,
    pub actions: ActionNames,
    pub warnings: Vec<Warning>,
}

/// Appends chunks and shares equal rows.
#[derive(Debug)]
pub(super) struct Assembler<'a> {
    path: &'a Path,
    header: Header,
    rows: Rows,
    /// Entries that fit into `rows` without asking again.
    capacity: u64,
    table: RowTable,
    choices: ChoicesBuilder,
    num_choices: u64,
    num_transitions: u64,
    lines_before: u64,
    /// The last state that has choices so far, and the number of its last one.
    last: Option<(StateId, u64)>,
    /// The last state's only choice so far is to stay.
    stays: bool,
    name_ids: HashMap<String, u32>,
    action_ids: Vec<u32>,
    deadlocks: Option<(u64, StateId)>,
    widened: Option<(u64, u64)>,
}

impl<'a> Assembler<'a> {
    /// Nothing appended yet; the first chunk follows the header.
    ///
    /// # Errors
    /// [`ImportError::Memory`] if so many states do not fit.
    pub fn new(path: &'a Path, header: Header) -> Result<Self, ImportError> {
        require_memory(format!("{} states", header.states), header.states.saturating_mul(9))?;
        Ok(Self {
            path,
            header,
            rows: Rows::new(),
            capacity: 0,
            table: RowTable::default(),
            // States without transitions are believed when they are reached.
            choices: ChoicesBuilder::with_capacity(header.states.min(header.transitions) as usize),
            num_choices: 0,
            num_transitions: 0,
            lines_before: header.line + 1,
            last: None,
            stays: false,
            name_ids: HashMap::new(),
            action_ids: vec![],
            deadlocks: None,
            widened: None,
        })
    }

    /// Appends what follows; the chunk's own fault is reported after everything before it.
    pub fn append(&mut self, chunk: ParsedChunk) -> Result<(), ImportError> {
        let base = self.lines_before;
        let names = self.name_ids_of(chunk.names);
        for (choice, row) in chunk.choices.iter().zip(chunk.rows.iter()) {
            self.continue_with(choice).map_err(|fault| fault.in_file(self.path, base))?;
            self.push_action(choice.action, &names);
            self.num_choices += 1;
            self.num_transitions += row.len() as u64;
            if self.num_transitions > self.header.transitions {
                let (column, declared) = (self.transitions_column(), self.header.transitions);
                return Err(self.wrong_count(column, "transition", declared, "more".to_owned()));
            }
            self.push_row(choice.hash, row)?;
        }
        if let Some((count, first)) = chunk.widened {
            self.widened.get_or_insert((0, base + first + 1)).0 += count;
        }
        if let Some(fault) = chunk.fault {
            // A choice without a row is the one that has the fault, and may be out of place besides.
            if let Some(choice) = chunk.choices.get(chunk.rows.len())
                && u64::from(choice.line) < fault.line
            {
                self.continue_with(choice).map_err(|fault| fault.in_file(self.path, base))?;
            }
            return Err(fault.in_file(self.path, base));
        }
        self.lines_before += chunk.lines;
        Ok(())
    }

    /// Moves on to the next choice.
    fn continue_with(&mut self, choice: &ParsedChoice) -> Result<(), Box<Fault>> {
        let line = u64::from(choice.line);
        match self.last {
            Some((state, number)) if state == choice.state => {
                if choice.number != number + 1 {
                    let column = state.to_string().len() + 2;
                    let expected = format!("choice {} of state {state}, or a later state", number + 1);
                    return Err(Fault::new(line, column, expected, choice.number.to_string()));
                }
                if self.stays {
                    // It has company, so it is a choice like any other.
                    self.stays = false;
                    let itself = Row { successors: &[state], lower: &[1.0], upper: &[1.0] };
                    self.share(hash_row(itself), itself).map_err(|_| too_many_rows(line))?;
                }
            }
            Some((state, _)) if state > choice.state => {
                let expected = format!("state {state} or a later one");
                return Err(Fault::new(line, 1, expected, choice.state.to_string()));
            }
            _ if choice.number != 0 => {
                let (state, number) = (choice.state, choice.number);
                let column = state.to_string().len() + 2;
                return Err(Fault::new(
                    line,
                    column,
                    format!("choice 0 of state {state}"),
                    number.to_string(),
                ));
            }
            _ => self.finish_states_before(choice.state),
        }
        self.last = Some((choice.state, choice.number));
        Ok(())
    }

    fn finish_states_before(&mut self, next: StateId) {
        let first = match self.last {
            None => 0,
            Some((state, _)) if self.stays => {
                self.stays = false;
                self.choices.push_absorbing();
                state + 1
            }
            Some((state, _)) => {
                self.choices.finish_state();
                state + 1
            }
        };
        for _ in first..next {
            self.choices.finish_state();
        }
        if first < next {
            self.deadlocks.get_or_insert((0, first)).0 += u64::from(next - first);
        }
    }

    fn push_row(&mut self, hash: u32, row: Row<'_>) -> Result<(), ImportError> {
        if let Some((state, 0)) = self.last
            && row.successors == [state]
            && row.lower == [1.0]
        {
            self.stays = true;
            return Ok(());
        }
        self.make_room(row.len() as u64)?;
        let line = self.lines_before;
        self.share(hash, row).map_err(|_| too_many_rows(0).in_file(self.path, line))
    }

    /// Adds a choice of the row, stored once.
    fn share(&mut self, hash: u32, row: Row<'_>) -> Result<(), TooManyRows> {
        let id = match self.table.find(hash, row, &self.rows) {
            Some(id) => id,
            None => {
                if self.rows.len() >= RowId::MAX as usize {
                    return Err(TooManyRows);
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
    fn make_room(&mut self, len: u64) -> Result<(), ImportError> {
        let kept = self.rows.num_entries() as u64;
        if kept + len <= self.capacity {
            return Ok(());
        }
        let left = self.header.transitions - self.num_transitions + len;
        let hardly_shared = kept > 0 && kept * 2 >= self.num_transitions;
        let more = if hardly_shared { left } else { kept.max(SMALL).min(left) }.max(len);
        require_memory(format!("{more} more transitions"), more.saturating_mul(ENTRY_BYTES))?;
        self.rows.reserve_exact(more as usize);
        self.capacity = kept + more;
        Ok(())
    }

    /// The ids of the names of a chunk.
    fn name_ids_of(&mut self, names: Vec<String>) -> Vec<u32> {
        let ids = names.into_iter().map(|name| {
            let next = self.name_ids.len() as u32;
            *self.name_ids.entry(name).or_insert(next)
        });
        ids.collect()
    }

    /// Notes the action of the next choice, unless no choice has had any so far.
    fn push_action(&mut self, action: u32, names: &[u32]) {
        let id = names.get(action as usize).copied();
        if self.action_ids.is_empty() && id.is_some() {
            let expected = self.header.choices.unwrap_or(self.header.states).min(self.header.transitions);
            self.action_ids.reserve_exact(expected as usize);
            self.action_ids.resize(self.num_choices as usize, ActionNames::UNNAMED);
        }
        if id.is_some() || !self.action_ids.is_empty() {
            self.action_ids.push(id.unwrap_or(ActionNames::UNNAMED));
        }
    }

    /// Ends the last state and compares the counts with the header.
    pub fn finish(mut self) -> Result<Transitions, ImportError> {
        let header = self.header;
        if let Some(declared) = header.choices.filter(|&declared| declared != self.num_choices) {
            let column = header.states.to_string().len() + 2;
            return Err(self.wrong_count(column, "choice", declared, self.num_choices.to_string()));
        }
        if header.transitions != self.num_transitions {
            let found = self.num_transitions.to_string();
            return Err(self.wrong_count(self.transitions_column(), "transition", header.transitions, found));
        }
        self.finish_states_before(header.states as StateId);
        let mut names = vec![String::new(); self.name_ids.len()];
        for (name, id) in self.name_ids {
            names[id as usize] = name;
        }
        let actions = match names.is_empty() {
            true => ActionNames::None,
            false => ActionNames::OfChoice { names, ids: self.action_ids },
        };
        let widened = self.widened.map(|(count, line)| {
            let first = Position { path: self.path.to_owned(), line, column: 1 };
            Warning::Widened { count, first }
        });
        let deadlocks = self.deadlocks.map(|(count, first)| Warning::Deadlocks { count, first });
        self.rows.shrink_to_fit();
        let warnings = widened.into_iter().chain(deadlocks).collect();
        Ok(Transitions { rows: self.rows, choices: self.choices.finish(), actions, warnings })
    }

    fn transitions_column(&self) -> usize {
        let before = [Some(self.header.states), self.header.choices];
        before.iter().flatten().map(|count| count.to_string().len() + 1).sum::<usize>() + 1
    }

    fn wrong_count(&self, column: usize, noun: &str, declared: u64, found: String) -> ImportError {
        let expected = format!("{} as this header says", super::text::counted(declared, noun));
        Fault::new(self.header.line, column, expected, found).in_file(self.path, 0)
    }
}

/// More rows than [`RowId`] can number.
struct TooManyRows;

fn too_many_rows(line: u64) -> Box<Fault> {
    Fault::new(line, 1, format!("at most {} distinct rows", RowId::MAX), "one more")
}
