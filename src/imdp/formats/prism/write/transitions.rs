//! The `.tra` file: every transition of every choice, streamed from shared rows.

use crate::files::interruption;
use crate::model::{ActionNames, End, IntervalMdp, ModelKind, RowId, StateId};
use crate::numeric::shortest_decimal;
use crate::progress::Progress;
use rayon::prelude::*;
use std::io::{self, Write};
use std::ops::Range;
use std::sync::mpsc;

/// What a lower bound of 0 is raised to: PRISM refuses interval models with a 0 below a positive bound.
///
/// With `m` successors per row and `k` steps a bounded value moves by at most `k m 10⁻³⁰⁰`, nothing in
/// doubles. For unbounded properties any positive number can change everything: see the manifest's note.
pub const RAISED_LOWER_BOUND: f64 = 1e-300;

/// The largest count of states, choices or transitions that PRISM reads.
pub const MAX_COUNT: u64 = i32::MAX as u64;

/// Text is made in pieces of about this many bytes.
const CHUNK_BYTES: u64 = 1 << 20;
/// How many finished pieces may wait for the disk.
const CHUNKS_IN_FLIGHT: usize = 8;

/// Writes a model as PRISM's explicit transitions.
///
/// `states choices transitions`, then `source choice destination [lower,upper] action` (without the choice
/// column for interval DTMCs). What follows source and choice is the same for all states that share a
/// row, so it is rendered once per row and copied.
#[derive(Debug)]
pub struct TraWriter<'a> {
    model: &'a IntervalMdp,
    rows: RowTexts,
    chunks: Vec<Chunk>,
    header: String,
}

/// Consecutive states and the exact size of their text.
#[derive(Debug)]
struct Chunk {
    states: Range<StateId>,
    first_choice: u64,
    bytes: u64,
}

/// Per entry of every row, the text after the choice: ` destination [lower,upper] action`, with the end of
/// the line unless every choice has its own name.
#[derive(Debug, Default)]
struct RowTexts {
    text: Vec<u8>,
    /// Where the text of each entry ends, and where the entries of each row start.
    ends: Vec<usize>,
    first_entry: Vec<usize>,
}

impl RowTexts {
    fn render(model: &IntervalMdp) -> Self {
        let mut texts = Self { first_entry: vec![0], ..Self::default() };
        model.rows().for_each(|id, row| {
            let tail = match model.actions() {
                ActionNames::None => "\n".to_owned(),
                ActionNames::OfRow => format!(" a_{id}\n"),
                ActionNames::OfChoice { .. } => String::new(),
            };
            for (i, successor) in row.successors.iter().enumerate() {
                // Not above the upper bound, which may be smaller still.
                let tiny = (0.0 < row.upper[i] && row.upper[i] < RAISED_LOWER_BOUND).then_some(End::Upper);
                let raised = |bound: f64, end| match (bound == 0.0, tiny) {
                    (true, Some(upper)) => row.text(upper, i),
                    (true, None) => shortest_decimal(RAISED_LOWER_BOUND),
                    (false, _) => row.text(end, i),
                };
                let (lower, upper) = (raised(row.lower[i], End::Lower), raised(row.upper[i], End::Upper));
                let text = format!(" {successor} [{lower},{upper}]{tail}");
                texts.text.extend_from_slice(text.as_bytes());
                texts.ends.push(texts.text.len());
            }
            texts.first_entry.push(texts.ends.len());
        });
        texts
    }

    fn entries(&self, row: RowId) -> impl Iterator<Item = &[u8]> {
        let range = self.first_entry[row.index()]..self.first_entry[row.index() + 1];
        let mut start = self.start(range.start);
        range.map(move |entry| {
            let text = &self.text[start..self.ends[entry]];
            start = self.ends[entry];
            text
        })
    }

    fn start(&self, entry: usize) -> usize {
        entry.checked_sub(1).map_or(0, |before| self.ends[before])
    }

    /// The number of bytes of a row's texts.
    fn bytes(&self, row: RowId) -> u64 {
        let (first, end) = (self.first_entry[row.index()], self.first_entry[row.index() + 1]);
        (self.start(end) - self.start(first)) as u64
    }
}

impl<'a> TraWriter<'a> {
    /// Prepares to write `model`: renders its rows and computes the exact size of the file.
    pub fn new(model: &'a IntervalMdp) -> Self {
        let size = model.size();
        let header = match model.kind() {
            ModelKind::Imdp => format!("{} {} {}\n", size.states, size.choices, size.transitions),
            ModelKind::Idtmc => format!("{} {}\n", size.states, size.transitions),
        };
        let mut writer = Self { model, rows: RowTexts::render(model), chunks: vec![], header };
        writer.chunks = writer.plan();
        writer
    }

    /// The size of the file in bytes.
    pub fn bytes(&self) -> u64 {
        self.header.len() as u64 + self.chunks.iter().map(|chunk| chunk.bytes).sum::<u64>()
    }

    /// Writes the file. The bytes do not depend on the number of threads.
    ///
    /// Text is made by the ambient thread pool and written by a thread of its own, with a bounded number of
    /// pieces in between.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, out: &mut (impl Write + Send), progress: &dyn Progress) -> io::Result<()> {
        out.write_all(self.header.as_bytes())?;
        let (filled, to_write) = mpsc::sync_channel::<Vec<u8>>(CHUNKS_IN_FLIGHT);
        let (emptied, to_fill) = mpsc::channel::<Vec<u8>>();
        std::thread::scope(|scope| {
            let disk = std::thread::Builder::new().spawn_scoped(scope, move || -> io::Result<()> {
                for piece in to_write {
                    out.write_all(&piece)?;
                    progress.advance(piece.len() as u64);
                    // Nobody may need the buffer any more.
                    let _ = emptied.send(piece);
                }
                Ok(())
            })?;
            for batch in self.chunks.chunks(CHUNKS_IN_FLIGHT / 2) {
                if progress.is_interrupted() {
                    return Err(interruption());
                }
                let mut pieces: Vec<Vec<u8>> =
                    batch.iter().map(|_| to_fill.try_recv().unwrap_or_default()).collect();
                pieces.par_iter_mut().zip(batch).for_each(|(piece, chunk)| self.render(chunk, piece));
                // Sending fails only if the writer has stopped at an error, which it returns below.
                if pieces.into_iter().any(|piece| filled.send(piece).is_err()) {
                    break;
                }
            }
            drop(filled);
            disk.join().unwrap_or_else(|_| Err(io::Error::other("the writing thread panicked")))
        })
    }

    /// Cuts the states into chunks of about [`CHUNK_BYTES`].
    fn plan(&self) -> Vec<Chunk> {
        let mut chunks = Vec::new();
        let mut choice = 0;
        let mut chunk = Chunk { states: StateId(0)..StateId(0), first_choice: 0, bytes: 0 };
        for state in StateId::first(self.model.num_states()) {
            let (bytes, choices) = self.measure(state, choice);
            choice += choices;
            chunk.bytes += bytes;
            chunk.states.end = state.next();
            if chunk.bytes >= CHUNK_BYTES {
                let next = Chunk { states: state.next()..state.next(), first_choice: choice, bytes: 0 };
                chunks.push(std::mem::replace(&mut chunk, next));
            }
        }
        chunks.push(chunk);
        chunks
    }

    /// The number of bytes and choices of one state.
    fn measure(&self, state: StateId, first_choice: u64) -> (u64, u64) {
        let is_imdp = self.model.kind() == ModelKind::Imdp;
        let prefix = |index: u64| digits(u64::from(state)) + if is_imdp { 1 + digits(index) } else { 0 };
        let choices = self.model.choices();
        if choices.is_absorbing(state) {
            let tail = self.name(first_choice).map_or(1, |name| name.len() as u64 + 2);
            let line = prefix(0) + 1 + digits(u64::from(state)) + " [1,1]".len() as u64 + tail;
            return (line, 1);
        }
        let (mut bytes, mut index) = (0, 0u64);
        for row in choices.rows(state) {
            let tail = self.tail(first_choice + index).map_or(0, |tail| tail.len() as u64);
            let entries = self.model.rows().row_len(row) as u64;
            bytes += self.rows.bytes(row) + entries * (prefix(index) + tail);
            index += 1;
        }
        (bytes, index)
    }

    fn render(&self, chunk: &Chunk, out: &mut Vec<u8>) {
        out.clear();
        out.reserve(chunk.bytes as usize);
        let mut choice = chunk.first_choice;
        for state in (chunk.states.start.0..chunk.states.end.0).map(StateId) {
            choice += self.render_state(state, choice, out);
        }
        debug_assert_eq!(out.len() as u64, chunk.bytes, "the planned size is exact");
    }

    /// Appends the lines of one state; returns the number of its choices.
    fn render_state(&self, state: StateId, first_choice: u64, out: &mut Vec<u8>) -> u64 {
        let is_imdp = self.model.kind() == ModelKind::Imdp;
        let prefix = |index: u64| if is_imdp { format!("{state} {index}") } else { format!("{state}") };
        let choices = self.model.choices();
        if choices.is_absorbing(state) {
            let name = self.name(first_choice).map(|name| format!(" {name}")).unwrap_or_default();
            out.extend_from_slice(format!("{} {state} [1,1]{name}\n", prefix(0)).as_bytes());
            return 1;
        }
        let mut index = 0;
        for row in choices.rows(state) {
            let prefix = prefix(index);
            let tail = self.tail(first_choice + index);
            for entry in self.rows.entries(row) {
                out.extend_from_slice(prefix.as_bytes());
                out.extend_from_slice(entry);
                if let Some(tail) = &tail {
                    out.extend_from_slice(tail.as_bytes());
                }
            }
            index += 1;
        }
        index
    }

    /// The name of a choice, where choices have names of their own.
    fn name(&self, choice: u64) -> Option<&str> {
        match self.model.actions() {
            ActionNames::OfChoice { names, ids } => {
                names.get(ids[choice as usize] as usize).map(String::as_str)
            }
            _ => None,
        }
    }

    /// What ends the lines of a choice, where the row's text does not.
    fn tail(&self, choice: u64) -> Option<String> {
        matches!(self.model.actions(), ActionNames::OfChoice { .. })
            .then(|| self.name(choice).map_or("\n".to_owned(), |name| format!(" {name}\n")))
    }
}

/// The number of decimal digits of `n`.
fn digits(n: u64) -> u64 {
    n.checked_ilog10().map_or(1, |log| u64::from(log) + 1)
}
