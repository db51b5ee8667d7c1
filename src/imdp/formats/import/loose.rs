//! Transitions in any order, put in order before they are checked.

use super::assembly::{Assembly, AssemblyError, Expected, Transitions};
use super::bounds::{Judgement, written_bounds};
use super::error::{Fault, ImportError, Position, Warning};
use super::fields::Fields;
use super::interval::{Interval, read_any_interval};
use super::pending_row::{PendingRow, RowFault};
use super::row_table::hash_row;
use super::text::{Cursor, counted, describe};
use crate::model::{ActionNames, MemoryError, ModelKind, RowId, Rows, StateId, require_memory};
use std::collections::HashMap;
use std::path::Path;

/// What a transition takes in memory until all are there, its text included.
const BYTES: u64 = 96;

/// How many transitions are read between two looks at the memory.
const STRIDE: usize = 1 << 20;

/// How large a file of transitions says its model is.
#[derive(Clone, Copy, Debug)]
pub(in crate::formats) struct TransitionHeader {
    /// Whether states have choices.
    pub(crate) kind: ModelKind,
    /// The number of states.
    pub(crate) states: u64,
    /// The number of choices, if it is given.
    pub(crate) choices: Option<u64>,
    /// The number of transitions.
    pub(crate) transitions: u64,
    /// The line of the header, from 0.
    pub(crate) line: u64,
}

/// One line.
#[derive(Debug)]
struct Line {
    state: StateId,
    choice: u64,
    successor: StateId,
    bounds: Interval,
    /// Where the bounds are in the text, as `read_interval` wants them.
    text: (u32, u32),
    action: u32,
    number: u64,
}

/// The transitions so far.
#[derive(Debug, Default)]
pub(in crate::formats) struct LooseTransitions {
    lines: Vec<Line>,
    /// The intervals, one after the other.
    text: Vec<u8>,
    names: Vec<String>,
    ids: HashMap<String, u32>,
}

impl LooseTransitions {
    /// How many there are.
    pub(crate) fn len(&self) -> u64 {
        self.lines.len() as u64
    }

    /// Fails if many more do not fit.
    pub(crate) fn check_memory(&self) -> Result<(), MemoryError> {
        if !self.lines.len().is_multiple_of(STRIDE) {
            return Ok(());
        }
        require_memory("more transitions in any order", BYTES * STRIDE as u64)
    }

    /// Adds the transition of a line: from which state by which choice to which other.
    pub(crate) fn push(
        &mut self,
        fields: &Fields<'_>,
        (state, choice, successor): (StateId, u64, StateId),
        interval: &[u8],
        action: Option<&str>,
    ) -> Result<(), Box<Fault>> {
        let end = |text: &Vec<u8>| {
            u32::try_from(text.len()).map_err(|_| fields.fault("less than 4 GiB of intervals"))
        };
        let start = end(&self.text)?;
        let mut cursor = Cursor::new(interval, 0);
        let bounds = read_any_interval(&mut cursor, &mut self.text);
        let bounds = bounds.map_err(|fault| fields.fault(fault.expected))?;
        if !cursor.at_end() {
            return Err(fields.fault("a blank or the end of the line after a probability"));
        }
        let text = (start, end(&self.text)?);
        let action = action.map_or(ActionNames::UNNAMED, |name| self.action(name));
        let number = fields.line();
        self.lines.push(Line { state, choice, successor, bounds, text, action, number });
        Ok(())
    }

    fn action(&mut self, name: &str) -> u32 {
        if let Some(&id) = self.ids.get(name) {
            return id;
        }
        let id = self.names.len() as u32;
        self.names.push(name.to_owned());
        self.ids.insert(name.to_owned(), id);
        id
    }

    /// Puts them in order and checks them.
    ///
    /// # Errors
    /// [`ImportError`] if the choices of a state have gaps, a choice admits no distribution or has several actions, or the
    /// counts are not those of the header.
    pub(crate) fn finish(
        mut self,
        path: &Path,
        header: TransitionHeader,
    ) -> Result<Transitions, ImportError> {
        let found = self.len();
        let at_header = |expected: String, found: u64| {
            Fault::new(header.line, 1, expected, found.to_string()).in_file(path, 0)
        };
        if found != header.transitions {
            let expected = format!("{} as this header says", counted(header.transitions, "transition"));
            return Err(at_header(expected, found));
        }
        self.lines.sort_by_key(|line| (line.state, line.choice));
        let choices = header.choices.unwrap_or(found);
        let mut assembly = Assembly::new(Expected { states: header.states, choices, transitions: found })?;
        let (mut row, mut rows) = (PendingRow::default(), Rows::new());
        let mut widened: Option<(u64, u64)> = None;
        let mut previous = None;
        for choice in self.lines.chunk_by(|a, b| (a.state, a.choice) == (b.state, b.choice)) {
            let first = &choice[0];
            let fault = |line: &Line, expected: String, found: String| {
                Fault::new(line.number, 1, expected, found).in_file(path, 0)
            };
            let next =
                previous.filter(|(state, _)| *state == first.state).map_or(0, |(_, number)| number + 1);
            if first.choice != next {
                let expected = format!("choice {next} of state {}", first.state);
                return Err(fault(first, expected, format!("choice {}", first.choice)));
            }
            previous = Some((first.state, first.choice));
            if let Some(other) = choice.iter().find(|line| line.action != first.action) {
                let found = self.names.get(other.action as usize).map_or("none", String::as_str);
                return Err(fault(other, "one action for all transitions of a choice".into(), found.into()));
            }
            row.clear();
            rows.clear();
            choice.iter().for_each(|line| row.push(line.successor, line.bounds));
            let written = || {
                let texts = choice.iter().map(|line| &self.text[line.text.0 as usize..line.text.1 as usize]);
                texts.filter_map(written_bounds)
            };
            let judgement = row.finish(written, &mut rows).map_err(|problem| match problem {
                RowFault::NoDistribution(problem) => fault(first, problem.expected.into(), problem.sum),
                RowFault::Twice { nth, successor } => {
                    let line = choice.get(nth as usize).unwrap_or(first);
                    fault(line, RowFault::ONCE.into(), describe(successor.to_string().as_bytes()))
                }
            })?;
            if judgement != Judgement::FINE {
                widened.get_or_insert((0, first.number + 1)).0 += 1;
            }
            let action = self.names.get(first.action as usize).map(|name| assembly.action(name));
            let content = rows.row(RowId(0));
            assembly.push(first.state, hash_row(content), content, action).map_err(|error| match error {
                AssemblyError::Memory(error) => ImportError::Memory(error),
                AssemblyError::TooManyRows => fault(first, AssemblyError::at_most(), "one more".into()),
            })?;
        }
        if let Some(declared) = header.choices.filter(|&declared| declared != assembly.num_choices()) {
            let expected = format!("{} as this header says", counted(declared, "choice"));
            return Err(at_header(expected, assembly.num_choices()));
        }
        let mut transitions = assembly.finish();
        let widened =
            widened.map(|(count, line)| Warning::Widened { count, first: Position::text(path, line, 1) });
        transitions.warnings.splice(0..0, widened);
        Ok(transitions)
    }
}
