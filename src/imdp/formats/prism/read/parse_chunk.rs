//! From whole lines of a `.tra` file to rows, without looking at what came before.

use std::collections::HashMap;

use crate::formats::import::{
    Cursor, Fault, Interval, Judgement, PendingRow, RowFault, describe, hash_row, read_interval,
    written_bounds,
};
use crate::model::{ActionNames, ModelKind, Row, RowId, Rows, StateId};

/// What the header says about the lines.
#[derive(Clone, Copy, Debug)]
pub(super) struct LineShape {
    /// Interval MDPs have a choice number in every line, interval DTMCs have not.
    pub kind: ModelKind,
    /// The number of states.
    pub states: u64,
}

impl LineShape {
    /// The number of leading fields that say which choice a line belongs to.
    pub(super) fn key_fields(self) -> usize {
        match self.kind {
            ModelKind::Imdp => 2,
            ModelKind::Idtmc => 1,
        }
    }
}

/// What a chunk says, in order.
#[derive(Debug, Default)]
pub(super) struct ParsedChunk {
    /// The number of lines, one transition each.
    pub lines: u64,
    /// The choices; choice `i` has row `i` of `rows`.
    pub choices: Vec<ParsedChoice>,
    /// The rows, equal ones not shared yet.
    pub rows: Rows,
    /// The names of actions that occur.
    pub names: Vec<String>,
    /// How many rows were widened, and the line of the first.
    pub widened: Option<(u64, u64)>,
    /// What ended the chunk early.
    pub fault: Option<Box<Fault>>,
}

/// A choice, apart from its row.
#[derive(Clone, Copy, Debug)]
pub(super) struct ParsedChoice {
    /// Its state.
    pub state: StateId,
    /// Its number within the state.
    pub number: u64,
    /// The line it starts at.
    pub line: u32,
    /// The hash of its row.
    pub hash: u32,
    /// An index into the chunk's names, or [`ActionNames::UNNAMED`].
    pub action: u32,
}

/// Parses lines that start and end with whole choices.
pub(super) fn parse_chunk(text: &[u8], shape: LineShape) -> ParsedChunk {
    let mut parser = Parser {
        text,
        shape,
        cursor: Cursor::new(text, 0),
        chunk: ParsedChunk::default(),
        row: PendingRow::default(),
        key: &[],
        start: 0,
        action: None,
        name_ids: HashMap::new(),
    };
    parser.row.clear();
    let outcome = parser.parse();
    let mut chunk = parser.chunk;
    chunk.lines = parser.cursor.line;
    chunk.fault = outcome.err();
    chunk
}

struct Parser<'a> {
    text: &'a [u8],
    shape: LineShape,
    cursor: Cursor<'a>,
    chunk: ParsedChunk,
    row: PendingRow,
    /// The text before the destination, the same in all lines of a choice.
    key: &'a [u8],
    /// Where the choice starts.
    start: usize,
    action: Option<&'a str>,
    name_ids: HashMap<&'a str, u32>,
}

impl<'a> Parser<'a> {
    fn parse(&mut self) -> Result<(), Box<Fault>> {
        while !self.cursor.at_end() {
            if self.row.is_empty() || !self.cursor.skip(self.key) {
                self.finish_choice()?;
                self.begin_choice()?;
                let (successor, interval) = self.transition()?;
                self.first_action()?;
                self.row.push(successor, interval);
            } else {
                let (successor, interval) = self.transition()?;
                self.same_action()?;
                self.row.push(successor, interval);
            }
            self.cursor.line_end("the end of the line")?;
        }
        self.finish_choice()
    }

    fn begin_choice(&mut self) -> Result<(), Box<Fault>> {
        self.start = self.cursor.offset();
        let line = self.cursor.line as u32;
        let state = self.state("a state")?;
        self.cursor.expect(b' ', "one blank")?;
        let mut number = 0;
        if self.shape.kind == ModelKind::Imdp {
            number = self.cursor.unsigned("the number of a choice")?;
            self.cursor.expect(b' ', "one blank")?;
        }
        self.key = &self.text[self.start..self.cursor.offset()];
        let unknown = ActionNames::UNNAMED;
        self.chunk.choices.push(ParsedChoice { state, number, line, hash: 0, action: unknown });
        Ok(())
    }

    fn state(&mut self, what: &str) -> Result<StateId, Box<Fault>> {
        let start = self.cursor.offset();
        let state = self.cursor.unsigned(what)?;
        if state >= self.shape.states {
            let expected = format!("{what} below {}, the number of states", self.shape.states);
            return Err(self.cursor.fault_at(start, expected));
        }
        Ok(StateId(state as u32))
    }

    #[inline]
    fn transition(&mut self) -> Result<(StateId, Interval), Box<Fault>> {
        let successor = self.state("a destination")?;
        self.cursor.expect(b' ', "one blank")?;
        Ok((successor, read_interval(&mut self.cursor, b"")?))
    }

    fn first_action(&mut self) -> Result<(), Box<Fault>> {
        self.action = None;
        if self.cursor.at_line_end() {
            return Ok(());
        }
        self.cursor.expect(b' ', "one blank and an action, or the end of the line")?;
        let action = self.cursor.identifier("an action that is an identifier")?;
        let names = &mut self.chunk.names;
        let id = *self.name_ids.entry(action).or_insert_with(|| {
            names.push(action.to_owned());
            names.len() as u32 - 1
        });
        self.action = Some(action);
        if let Some(choice) = self.chunk.choices.last_mut() {
            choice.action = id;
        }
        Ok(())
    }

    #[inline]
    fn same_action(&mut self) -> Result<(), Box<Fault>> {
        let start = self.cursor.offset();
        let Some(action) = self.action else {
            return match self.cursor.at_line_end() {
                true => Ok(()),
                false => Err(self.cursor.fault_here("no action, as in the first line of this choice")),
            };
        };
        if self.cursor.skip(b" ") && self.cursor.skip(action.as_bytes()) && self.cursor.at_line_end() {
            return Ok(());
        }
        let start = start + usize::from(self.text.get(start) == Some(&b' '));
        Err(Fault::new(
            self.cursor.line,
            self.cursor.column(start),
            format!("the action `{action}` of the first line of this choice"),
            describe(&self.text[start..]),
        ))
    }

    fn finish_choice(&mut self) -> Result<(), Box<Fault>> {
        if self.row.is_empty() {
            return Ok(());
        }
        let Some(choice) = self.chunk.choices.last_mut() else { return Ok(()) };
        let lines = &self.text[self.start..self.cursor.offset()];
        let (line, field) = (u64::from(choice.line), self.shape.key_fields() + 1);
        let written = || lines.split(|&byte| byte == b'\n').filter_map(|line| bounds_of_line(line, field));
        let finished = self.row.finish(written, &mut self.chunk.rows);
        let finished = finished.map_err(|fault| place(fault, lines, line, field));
        self.row.clear();
        if finished? != Judgement::FINE {
            self.chunk.widened.get_or_insert((0, u64::from(choice.line))).0 += 1;
        }
        choice.hash = hash_row(last_row(&self.chunk.rows));
        Ok(())
    }
}

fn last_row(rows: &Rows) -> Row<'_> {
    rows.row(RowId(rows.len() as u32 - 1))
}

/// The texts of the bounds in a line that has been parsed before, in its field number `field`.
fn bounds_of_line(line: &[u8], field: usize) -> Option<(&[u8], &[u8])> {
    let start = line.iter().enumerate().filter(|(_, byte)| **byte == b' ').nth(field - 1)?.0 + 1;
    let length = line[start..].iter().position(|byte| matches!(byte, b' ' | b'\r'));
    written_bounds(&line[start..length.map_or(line.len(), |length| start + length)])
}

/// Says where in the lines of a choice a fault is; the first of them is `first_line`.
#[cold]
fn place(fault: RowFault, lines: &[u8], first_line: u64, field: usize) -> Box<Fault> {
    match fault {
        RowFault::NoDistribution(fault) => Fault::new(first_line, 1, fault.expected, fault.sum),
        RowFault::Twice { nth, .. } => {
            let line = lines.split(|&byte| byte == b'\n').nth(nth as usize).unwrap_or_default();
            let before = line.split(|&byte| byte == b' ').take(field - 1);
            let column = before.map(|text| text.len() + 1).sum::<usize>();
            let found = describe(&line[column..]);
            Fault::new(first_line + u64::from(nth), column + 1, RowFault::ONCE, found)
        }
    }
}
