//! From parsed chunks, in order, to the transitions of a model.

use std::path::Path;

use super::parse_chunk::{ParsedChoice, ParsedChunk};
use crate::formats::import::{
    Assembly, AssemblyError, Expected, Fault, ImportError, Position, TransitionHeader, Transitions, Warning,
    counted,
};
use crate::model::StateId;

/// Appends chunks and holds them against the header.
#[derive(Debug)]
pub(super) struct Assembler<'a> {
    path: &'a Path,
    header: TransitionHeader,
    assembly: Assembly,
    lines_before: u64,
    /// The last state that has choices so far, and the number of its last one.
    last: Option<(StateId, u64)>,
    widened: Option<(u64, u64)>,
}

impl<'a> Assembler<'a> {
    /// Nothing appended yet; the first chunk follows the header.
    ///
    /// # Errors
    /// [`ImportError::Memory`] if so many states do not fit.
    pub(super) fn new(path: &'a Path, header: TransitionHeader) -> Result<Self, ImportError> {
        let TransitionHeader { states, choices, transitions, .. } = header;
        let expected = Expected { states, choices: choices.unwrap_or(states), transitions };
        Ok(Self {
            path,
            header,
            assembly: Assembly::new(expected)?,
            lines_before: header.line + 1,
            last: None,
            widened: None,
        })
    }

    /// Appends what follows; the chunk's own fault is reported after everything before it.
    pub(super) fn append(&mut self, chunk: ParsedChunk) -> Result<(), ImportError> {
        let base = self.lines_before;
        let names: Vec<_> = chunk.names.iter().map(|name| self.assembly.action(name)).collect();
        for (choice, row) in chunk.choices.iter().zip(chunk.rows.iter()) {
            self.continue_with(choice).map_err(|fault| fault.in_file(self.path, base))?;
            if self.assembly.num_transitions() + row.len() as u64 > self.header.transitions {
                let (column, declared) = (self.transitions_column(), self.header.transitions);
                return Err(self.wrong_count(column, "transition", declared, "more".to_owned()));
            }
            let action = names.get(choice.action as usize).copied();
            self.assembly.push(choice.state, choice.hash, row, action).map_err(|error| match error {
                AssemblyError::Memory(error) => ImportError::Memory(error),
                AssemblyError::TooManyRows => {
                    let line = u64::from(choice.line);
                    Fault::new(line, 1, AssemblyError::at_most(), "one more").in_file(self.path, base)
                }
            })?;
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
            Some((state, number)) if state == choice.state && choice.number == number + 1 => {}
            Some((state, number)) if state == choice.state => {
                let column = state.to_string().len() + 2;
                let expected = format!("choice {} of state {state}, or a later state", number + 1);
                return Err(Fault::new(line, column, expected, choice.number.to_string()));
            }
            Some((state, _)) if state > choice.state => {
                let expected = format!("state {state} or a later one");
                return Err(Fault::new(line, 1, expected, choice.state.to_string()));
            }
            _ if choice.number != 0 => {
                let (state, number) = (choice.state, choice.number);
                let column = state.to_string().len() + 2;
                let expected = format!("choice 0 of state {state}");
                return Err(Fault::new(line, column, expected, number.to_string()));
            }
            _ => {}
        }
        self.last = Some((choice.state, choice.number));
        Ok(())
    }

    /// Ends the last state and compares the counts with the header.
    pub(super) fn finish(self) -> Result<Transitions, ImportError> {
        let header = self.header;
        let (choices, found) = (self.assembly.num_choices(), self.assembly.num_transitions());
        if let Some(declared) = header.choices.filter(|&declared| declared != choices) {
            let column = header.states.to_string().len() + 2;
            return Err(self.wrong_count(column, "choice", declared, choices.to_string()));
        }
        if header.transitions != found {
            let column = self.transitions_column();
            return Err(self.wrong_count(column, "transition", header.transitions, found.to_string()));
        }
        let widened = self
            .widened
            .map(|(count, line)| Warning::Widened { count, first: Position::text(self.path, line, 1) });
        let mut transitions = self.assembly.finish();
        transitions.warnings.splice(0..0, widened);
        Ok(transitions)
    }

    fn transitions_column(&self) -> usize {
        let before = [Some(self.header.states), self.header.choices];
        before.iter().flatten().map(|count| count.to_string().len() + 1).sum::<usize>() + 1
    }

    fn wrong_count(&self, column: usize, noun: &str, declared: u64, found: String) -> ImportError {
        let expected = format!("{} as this header says", counted(declared, noun));
        Fault::new(self.header.line, column, expected, found).in_file(self.path, 0)
    }
}
