//! Transitions in any layout: more blanks, blank lines and comments, any order, any names, fractions.
//!
//! What PRISM's files look like is read by `transitions`, fast and on all cores. What it refuses is read here once more,
//! line by line, before it is refused for good: none of these liberties can change a value.

use crate::formats::import::{
    Fault, Fields, ImportError, Lines, LooseTransitions, TransitionHeader, Transitions,
};
use crate::model::{ModelKind, StateId};
use std::io::BufRead;
use std::path::Path;

/// Reads the transitions of `lines`, which are at the start of the file; more states than given are not believed.
pub(super) fn read_loosely<R: BufRead>(
    path: &Path,
    lines: &mut Lines<'_, R>,
    most_states: u64,
) -> Result<(TransitionHeader, Transitions), ImportError> {
    let header = loop {
        let Some(cursor) = lines.next_or_blank()? else {
            return Err(lines.refuse(1, "a header, `states choices transitions`", "the end of the file"));
        };
        let Some(mut fields) = Fields::cut(&cursor, b"#") else { continue };
        break read_header(&mut fields).map_err(|fault| lines.place(*fault))?;
    };
    if header.states > most_states {
        let expected = format!("at most {most_states} states in so short a file");
        return Err(lines.refuse(1, expected, header.states.to_string()));
    }
    let mut transitions = LooseTransitions::default();
    while let Some(cursor) = lines.next_or_blank()? {
        let Some(mut fields) = Fields::cut(&cursor, b"#") else { continue };
        let outcome = read_line(&mut fields, header, &mut transitions);
        outcome.map_err(|fault| lines.place(*fault))?;
        transitions.check_memory()?;
    }
    Ok((header, transitions.finish(path, header)?))
}

fn read_header(fields: &mut Fields<'_>) -> Result<TransitionHeader, Box<Fault>> {
    const COUNTS: &str =
        "a header: `states choices transitions`, or `states transitions` of an interval DTMC";
    let line = fields.line();
    let states = fields.number(COUNTS, u64::from(StateId::MAX) + 1)?;
    if states == 0 {
        return Err(fields.fault("at least one state"));
    }
    let second = fields.number(COUNTS, u64::MAX)?;
    Ok(match fields.last(COUNTS)? {
        Some(field) => {
            let third = std::str::from_utf8(field).ok().and_then(|text| text.parse().ok());
            let transitions = third.ok_or_else(|| fields.fault(COUNTS))?;
            TransitionHeader { kind: ModelKind::Imdp, states, choices: Some(second), transitions, line }
        }
        None => TransitionHeader { kind: ModelKind::Idtmc, states, choices: None, transitions: second, line },
    })
}

fn read_line(
    fields: &mut Fields<'_>,
    header: TransitionHeader,
    transitions: &mut LooseTransitions,
) -> Result<(), Box<Fault>> {
    let state = StateId(fields.number("a state", header.states)? as u32);
    let choice = match header.kind {
        ModelKind::Imdp => fields.number("the number of a choice", u64::MAX)?,
        ModelKind::Idtmc => 0,
    };
    let successor = StateId(fields.number("a destination", header.states)? as u32);
    let interval = fields.next("a probability or an interval")?;
    let action = match fields.last("the end of the line")? {
        None => None,
        Some(name) => match std::str::from_utf8(name) {
            Ok(name) => Some(name),
            Err(_) => return Err(fields.fault("an action in UTF-8")),
        },
    };
    transitions.push(fields, (state, choice, successor), interval, action)
}
