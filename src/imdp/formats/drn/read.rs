//! Reading DRN, line by line.

use super::UNNAMED;
use super::header::{Header, end_of_line, read_header};
use super::state_line::{StateNotes, read_labels};
use super::stopped::Stopped;
use crate::formats::import::{
    Assembly, AssemblyError, Cursor, Expected, Fault, ImportError, Imported, Judgement, Lines, PendingRow,
    Position, RowFault, Source, Warning, describe, hash_row, open, read_any_interval, written_bounds,
};
use crate::model::{ActionNames, ModelKind, RowId, Rows, StateId};
use std::io::BufRead;
use std::path::Path;

/// The shortest transition with its line end, `0 : 1`.
const SHORTEST_LINE: u64 = 6;

/// Reads an interval MDP or interval DTMC from Storm's DRN format.
///
/// What [`DrnWriter`](super::DrnWriter) writes, and what Storm and PRISM do, compressed or not: `@type` MDP or DTMC (IMDP
/// or IDTMC), any `@value_type` of numbers or intervals or none, `//` comments, labels with or without quotation marks,
/// rewards, values of variables in Storm's comments. Numbers mean the
/// decimals as written; sums are judged as [`prism::import`](crate::formats::prism::import) does. Choices that are all called by
/// their index have no names.
///
/// # Errors
/// [`ImportError`] with the position of the first thing that is not as the format wants it. Parameters,
/// placeholders and other types of model are refused by name.
pub fn import(path: &Path) -> Result<Imported, ImportError> {
    import_with_progress(path, &mut |_| {})
}

/// Reads a model like [`import`] and tells `progress` now and then how many bytes have been read.
///
/// # Errors
/// Those of [`import`].
pub fn import_with_progress(path: &Path, progress: &mut dyn FnMut(u64)) -> Result<Imported, ImportError> {
    let Source { reader, length } = open(path)?;
    let mut lines = Lines::new(path, reader);
    let header = read_header(&mut lines, length)?;
    // A header that lies must not decide how much is allocated.
    let fits = length / SHORTEST_LINE;
    let expected =
        Expected { states: header.states, choices: header.choices.unwrap_or(fits), transitions: fits };
    let mut body = Body {
        path,
        assembly: Assembly::new(expected)?,
        notes: StateNotes::new(&header, fits)?,
        header,
        row: PendingRow::default(),
        rows: Rows::new(),
        written: vec![],
        lines_of_row: vec![],
        state: None,
        choice: None,
        widened: None,
        indices: true,
    };
    body.row.clear();
    let mut told = 0;
    while let Some(mut cursor) = lines.next_or_blank()? {
        body.line(&mut cursor)?;
        if lines.bytes_read() - told > 1 << 20 {
            told = lines.bytes_read();
            progress(told);
        }
    }
    body.finish(lines)
}

/// A choice whose transitions are being read.
#[derive(Debug)]
struct PendingChoice {
    /// Its number within the state.
    number: u64,
    /// Its line, from 0.
    line: u64,
    action: Option<u32>,
    /// It is called by its index.
    is_index: bool,
}

struct Body<'a> {
    path: &'a Path,
    header: Header,
    assembly: Assembly,
    notes: StateNotes,
    row: PendingRow,
    /// Holds one row at a time.
    rows: Rows,
    /// The intervals of the row as written, line by line.
    written: Vec<u8>,
    /// The lines of the row's transitions, from 0.
    lines_of_row: Vec<u64>,
    /// The state whose choices are being read.
    state: Option<StateId>,
    choice: Option<PendingChoice>,
    widened: Option<(u64, u64)>,
    /// Every choice so far is called by its index.
    indices: bool,
}

impl Body<'_> {
    fn line(&mut self, cursor: &mut Cursor<'_>) -> Result<(), ImportError> {
        let outcome = self.dispatch(cursor);
        outcome.map_err(|error| match error {
            Stopped::Fault(fault) => fault.in_file(self.path, 0),
            Stopped::Import(error) => error,
        })
    }

    fn dispatch(&mut self, cursor: &mut Cursor<'_>) -> Result<(), Stopped> {
        if cursor.skip(b"//! ") {
            return Ok(self.notes.read(self.state, cursor)?);
        }
        cursor.skip_blanks();
        if cursor.skip(b"//") {
            self.notes.read_comment(self.state, cursor.rest().trim_ascii());
            return Ok(());
        }
        if cursor.at_line_end() || cursor.at_end() {
            return Ok(());
        }
        if cursor.skip(b"state ") {
            return self.begin_state(cursor);
        }
        if cursor.skip(b"action ") {
            return self.begin_choice(cursor);
        }
        Ok(self.transition(cursor)?)
    }

    fn begin_state(&mut self, cursor: &mut Cursor<'_>) -> Result<(), Stopped> {
        self.finish_choice()?;
        let start = cursor.offset();
        let next = self.state.map_or(0, |state| u64::from(state) + 1);
        if next == self.header.states {
            let expected = format!("no state after {}, the last one", next - 1);
            return Err(cursor.fault_here(expected).into());
        }
        if cursor.unsigned("the number of a state")? != next {
            return Err(cursor.fault_at(start, format!("state {next}")).into());
        }
        let state = StateId(next as u32);
        self.state = Some(state);
        read_labels(cursor, state, &mut self.notes)
    }

    fn begin_choice(&mut self, cursor: &mut Cursor<'_>) -> Result<(), Stopped> {
        let number = self.choice.as_ref().map_or(0, |choice| choice.number + 1);
        self.finish_choice()?;
        if self.state.is_none() {
            return Err(cursor.fault_at(0, "a state before its actions").into());
        }
        let start = cursor.offset();
        while !cursor.at_line_end() && !matches!(cursor.peek(), b' ' | b'\t') && !cursor.at_end() {
            cursor.advance(1);
        }
        let Ok(name) = std::str::from_utf8(cursor.since(start)) else {
            return Err(cursor.fault_at(start, "the name of an action in UTF-8").into());
        };
        if name.is_empty() {
            return Err(cursor.fault_at(start, "the name of an action").into());
        }
        let is_index = name == number.to_string();
        let action = (name != UNNAMED).then(|| self.assembly.action(name));
        self.choice = Some(PendingChoice { number, line: cursor.line, action, is_index });
        cursor.skip_blanks();
        if cursor.peek() == b'[' {
            self.notes.rewards.of_choice(cursor, self.assembly.num_choices())?;
        }
        Ok(end_of_line(cursor, "the end of the line")?)
    }

    fn transition(&mut self, cursor: &mut Cursor<'_>) -> Result<(), Box<Fault>> {
        const EXPECTED: &str = "`state`, `action` or a transition, `destination : [lower, upper]`";
        let line = cursor.line;
        let start = cursor.offset();
        let successor = cursor.unsigned(EXPECTED)?;
        match (&self.choice, self.header.kind, self.state) {
            (Some(_), ..) => {}
            // A chain has nothing to choose, so its one choice needs no name.
            (None, ModelKind::Idtmc, Some(_)) => {
                self.choice = Some(PendingChoice { number: 0, line, action: None, is_index: true });
            }
            _ => return Err(cursor.fault_at(start, "an action before its transitions")),
        }
        if successor >= self.header.states {
            let expected = format!("a destination below {}, the number of states", self.header.states);
            return Err(cursor.fault_at(start, expected));
        }
        cursor.skip_blanks();
        cursor.expect(b':', "` : ` and an interval")?;
        cursor.skip_blanks();
        let interval = read_any_interval(cursor, &mut self.written)?;
        self.written.push(b'\n');
        self.lines_of_row.push(line);
        self.row.push(StateId(successor as u32), interval);
        end_of_line(cursor, "the end of the line")
    }

    /// Ends the choice whose transitions have been read, if there is one.
    fn finish_choice(&mut self) -> Result<(), Stopped> {
        let (Some(choice), Some(state)) = (self.choice.take(), self.state) else { return Ok(()) };
        if self.row.is_empty() {
            // Storm writes a state without choices with an action that leads nowhere.
            if choice.number == 0 {
                return Ok(());
            }
            return Err(Fault::new(choice.line, 1, "an action with transitions", "one without").into());
        }
        let written = || self.written.split(|&byte| byte == b'\n').filter_map(written_bounds);
        self.rows.clear();
        let finished = self.row.finish(written, &mut self.rows);
        let judgement = finished.map_err(|fault| match fault {
            RowFault::NoDistribution(fault) => Fault::new(choice.line, 1, fault.expected, fault.sum),
            RowFault::Twice { nth, successor } => {
                let line = self.lines_of_row.get(nth as usize).copied().unwrap_or(choice.line);
                Fault::new(line, 1, RowFault::ONCE, describe(successor.to_string().as_bytes()))
            }
        })?;
        if judgement != Judgement::FINE {
            self.widened.get_or_insert((0, choice.line + 1)).0 += 1;
        }
        self.row.clear();
        self.written.clear();
        self.lines_of_row.clear();
        if self.notes.is_deadlock(state) {
            return Ok(());
        }
        self.indices &= choice.is_index;
        let row = self.rows.row(RowId(0));
        self.assembly.push(state, hash_row(row), row, choice.action).map_err(|error| match error {
            AssemblyError::Memory(error) => Stopped::Import(error.into()),
            AssemblyError::TooManyRows => {
                Fault::new(choice.line, 1, AssemblyError::at_most(), "one more").into()
            }
        })
    }

    fn finish<R: BufRead>(mut self, lines: Lines<'_, R>) -> Result<Imported, ImportError> {
        self.finish_choice().map_err(|error| match error {
            Stopped::Fault(fault) => fault.in_file(self.path, 0),
            Stopped::Import(error) => error,
        })?;
        let found = self.state.map_or(0, |state| u64::from(state) + 1);
        if found != self.header.states {
            let expected = format!("{} states as the header says", self.header.states);
            return Err(lines.refuse(1, expected, found.to_string()));
        }
        let choices = self.assembly.num_choices() + self.notes.deadlocks();
        let mut transitions = self.assembly.finish();
        let without: u64 = transitions
            .warnings
            .iter()
            .map(|warning| if let Warning::Deadlocks { count, .. } = warning { *count } else { 0 })
            .sum();
        // Storm counts a choice of a state that has none.
        let counts = [choices, choices + without - self.notes.deadlocks()];
        if let Some(declared) = self.header.choices.filter(|declared| !counts.contains(declared)) {
            let expected = format!("{declared} choices as the header says");
            return Err(lines.refuse(1, expected, choices.to_string()));
        }
        if self.indices {
            transitions.actions = ActionNames::None;
        }
        let rewards = std::mem::take(&mut self.notes.rewards);
        let (rewards, left_out) = rewards.finish(self.header.states as usize, choices);
        let (initial, labels, variables) = self.notes.finish();
        if initial.is_clear() {
            return Err(lines.refuse(1, "a state with the label init in some line", "none"));
        }
        let variables = variables.map_err(|missing| {
            lines.refuse(1, "values of the variables for every state", format!("none for state {missing}"))
        })?;
        let mut imported = transitions.into_model(self.header.kind, initial, labels, variables)?;
        let widened = |(count, line)| Warning::Widened { count, first: Position::text(self.path, line, 1) };
        imported.warnings.splice(0..0, self.widened.map(widened));
        if !left_out.is_empty() {
            let what = format!("the reward model {}, which holds intervals,", left_out.join(", "));
            imported.warnings.push(Warning::Ignored { path: self.path.to_owned(), what });
        }
        imported.model = imported.model.with_rewards(rewards)?;
        Ok(imported)
    }
}
