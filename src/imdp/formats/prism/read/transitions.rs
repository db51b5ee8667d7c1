//! Transitions: `states choices transitions`, then `src choice dst [lo,hi] action` line by line.
//!
//! Interval DTMCs have no choices: `states transitions`, then `src dst [lo,hi]`.

use std::io::BufRead;
use std::path::Path;

use rayon::prelude::*;

use super::assemble::Assembler;
use super::chunks::ChunkReader;
use super::loose::read_loosely;
use super::parse_chunk::{LineShape, parse_chunk};
use crate::formats::import::{ImportError, Lines, Source, TransitionHeader, Transitions, Warning, open};
use crate::model::{ModelKind, StateId};

/// How many chunks are in flight per thread.
const LOOK_AHEAD: usize = 4;

/// How many chunks are in flight at most, however many threads there are: memory is bounded.
const MOST_IN_FLIGHT: usize = 64;

/// The shortest transition with its line end, `0 0 1`.
const SHORTEST_LINE: u64 = 6;

/// States without transitions need no bytes; so many are believed, and one more for every byte.
const FEW_STATES: u64 = 1 << 16;

/// Reads a `.tra` file; `progress` is told how many bytes have been read.
///
/// What is not laid out as PRISM does it is read again, without minding the layout.
pub(super) fn read_tra(
    path: &Path,
    progress: &mut (dyn FnMut(u64) + Send),
) -> Result<(TransitionHeader, Transitions), ImportError> {
    let strict = match read_strictly(path, progress) {
        Err(ImportError::Refused { at, expected, found }) => (at, expected, found),
        outcome => return outcome,
    };
    let (at, expected, found) = strict;
    let Source { reader, length } = open(path)?;
    match read_loosely(path, &mut Lines::new(path, reader), length.saturating_add(FEW_STATES)) {
        Ok((header, mut transitions)) => {
            transitions.warnings.push(Warning::Layout { first: at });
            Ok((header, transitions))
        }
        // The one that got further knows better what is wrong.
        Err(ImportError::Refused { at: later, expected, found }) if later.is_after(&at) => {
            Err(later.refuse(expected, found))
        }
        Err(_) => Err(at.refuse(expected, found)),
    }
}

fn read_strictly(
    path: &Path,
    progress: &mut (dyn FnMut(u64) + Send),
) -> Result<(TransitionHeader, Transitions), ImportError> {
    let io = |error| ImportError::io(path, error);
    let Source { reader, length } = open(path)?;
    let mut lines = Lines::new(path, reader);
    let header = read_header(&mut lines)?;
    // A header that lies must not decide how much is allocated.
    let fits = (length + 1) / SHORTEST_LINE;
    if header.transitions > fits {
        let expected = format!("at most {fits} transitions in a file of {length} bytes");
        return Err(lines.refuse(1, expected, header.transitions.to_string()));
    }
    let fits = length.saturating_add(FEW_STATES);
    if header.states > fits {
        let expected = format!("at most {fits} states in a file of {length} bytes");
        return Err(lines.refuse(1, expected, header.states.to_string()));
    }
    let shape = LineShape { kind: header.kind, states: header.states };
    let mut assembler = Assembler::new(path, header)?;
    let bytes_read = lines.bytes_read();
    let mut reader = ChunkReader::new(lines.into_inner(), shape.key_fields(), bytes_read);
    let in_flight = (LOOK_AHEAD * rayon::current_num_threads()).min(MOST_IN_FLIGHT);
    let mut texts = reader.batch(in_flight).map_err(io)?;
    let mut parsed = vec![];
    while !texts.is_empty() || !parsed.is_empty() {
        // Chunks are parsed on all cores while the previous ones are appended in order.
        let (fresh, (appended, next)) = rayon::join(
            || texts.par_iter().map(|text| parse_chunk(text, shape)).collect::<Vec<_>>(),
            || {
                let appended = parsed.into_iter().try_for_each(|chunk| assembler.append(chunk));
                (appended, reader.batch(in_flight))
            },
        );
        appended?;
        (parsed, texts) = (fresh, next.map_err(io)?);
        progress(reader.bytes_read());
    }
    Ok((header, assembler.finish()?))
}

/// Reads `states choices transitions` or `states transitions`, after any lines that start with `#`.
fn read_header<R: BufRead>(lines: &mut Lines<'_, R>) -> Result<TransitionHeader, ImportError> {
    const COUNTS: &str =
        "a header: `states choices transitions`, or `states transitions` of an interval DTMC";
    lines.skip_comments()?;
    let line = lines.lines_read();
    let Some(mut cursor) = lines.next()? else {
        return Err(lines.refuse(1, COUNTS, "the end of the file"));
    };
    let header = (|| {
        let states = cursor.unsigned(COUNTS)?;
        if states == 0 || states > u64::from(StateId::MAX) {
            return Err(cursor.fault_at(0, format!("between 1 and {} states", StateId::MAX)));
        }
        cursor.expect(b' ', COUNTS)?;
        let second = cursor.unsigned(COUNTS)?;
        let third = match cursor.skip(b" ") {
            true => Some(cursor.unsigned(COUNTS)?),
            false => None,
        };
        cursor.line_end(COUNTS)?;
        Ok(match third {
            Some(transitions) => {
                TransitionHeader { kind: ModelKind::Imdp, states, choices: Some(second), transitions, line }
            }
            None => {
                TransitionHeader { kind: ModelKind::Idtmc, states, choices: None, transitions: second, line }
            }
        })
    })();
    header.map_err(|fault| lines.place(*fault))
}
