//! Reading bmdp-tool's format.

use super::REACH;
use crate::formats::import::{
    Fields, ImportError, Imported, Lines, LooseTransitions, Source, TransitionHeader, Warning, open,
};
use crate::model::{Labels, ModelKind, StateId, StateSet, StateVariables};
use std::io::{BufRead, Read};
use std::path::Path;

/// The shortest transition with its line end, `0 0 0 1 1`.
const SHORTEST_LINE: u64 = 10;

/// Reads an interval MDP from bmdp-tool's format, compressed or not.
///
/// # Errors
/// [`ImportError`] with the position of the first thing that is not as the format wants it.
pub fn import(path: &Path) -> Result<Imported, ImportError> {
    import_with_progress(path, &mut |_| {})
}

/// Reads a model like [`import`] and tells `progress` now and then how many bytes have been read.
///
/// # Errors
/// Those of [`import`].
pub fn import_with_progress(
    path: &Path,
    progress: &mut (dyn FnMut(u64) + Send),
) -> Result<Imported, ImportError> {
    let Source { reader, length } = open(path)?;
    let mut lines = Lines::new(path, reader);
    let states = read_count(&mut lines, "the number of states", 1, u64::from(StateId::MAX))?;
    let actions = read_count(&mut lines, "the number of actions", 0, u64::MAX - 1)?;
    let reached = read_count(&mut lines, "the number of states to be reached", 0, states)?;
    let fits = length / SHORTEST_LINE + 1;
    let mut reach = StateSet::with_capacity(states.min(length) as usize);
    for _ in 0..reached {
        let state = read_count(&mut lines, "a state to be reached", 0, states - 1)? as usize;
        reach.grow_and_insert(state);
    }
    let mut transitions = LooseTransitions::default();
    let mut told = 0;
    while let Some(cursor) = lines.next_or_blank()? {
        let Some(mut fields) = Fields::cut(&cursor, b"#") else { continue };
        let outcome = read_line(&mut fields, states, actions, &mut transitions);
        outcome.map_err(|fault| lines.place(*fault))?;
        transitions.check_memory()?;
        if lines.bytes_read() - told > 1 << 20 {
            told = lines.bytes_read();
            progress(told);
        }
    }
    let header = TransitionHeader {
        kind: ModelKind::Imdp,
        states,
        choices: None,
        transitions: transitions.len().min(fits),
        line: 0,
    };
    let transitions = transitions.finish(path, header)?;
    let mut initial = StateSet::with_capacity(states as usize);
    initial.insert(0);
    reach.grow(states as usize);
    let mut labels = Labels::default();
    labels.insert(REACH, reach);
    let mut imported = transitions.into_model(ModelKind::Imdp, initial, labels, StateVariables::default())?;
    imported.warnings.push(Warning::NoInitialState { path: path.to_owned() });
    Ok(imported)
}

/// Whether a file begins as one of this format does, with a line that is a number.
pub(crate) fn begins(path: &Path) -> bool {
    let Ok(Source { reader, .. }) = open(path) else { return false };
    let mut line = String::new();
    // Whatever is longer is no number.
    reader.take(32).read_line(&mut line).is_ok() && line.trim().parse::<u64>().is_ok()
}

fn read_line(
    fields: &mut Fields<'_>,
    states: u64,
    actions: u64,
    transitions: &mut LooseTransitions,
) -> Result<(), Box<crate::formats::import::Fault>> {
    let state = StateId(fields.number("a state", states)? as u32);
    let action = fields.number("an action", actions)?;
    let successor = StateId(fields.number("a destination", states)? as u32);
    let lower = fields.next("the lower bound")?;
    let upper = fields.last("the upper bound and the end of the line")?;
    let upper = upper.ok_or_else(|| fields.fault("the upper bound"))?;
    let interval = [b"[", lower, b",", upper, b"]"].concat();
    // The number of an action is its name: not every state has all of them.
    transitions.push(fields, (state, action, successor), &interval, Some(&action.to_string()))
}

fn read_count<R: BufRead>(
    lines: &mut Lines<'_, R>,
    what: &str,
    least: u64,
    most: u64,
) -> Result<u64, ImportError> {
    loop {
        let Some(cursor) = lines.next_or_blank()? else {
            return Err(lines.refuse(1, what, "the end of the file"));
        };
        let Some(mut fields) = Fields::cut(&cursor, b"#") else { continue };
        let outcome = fields.number(what, most + 1).and_then(|number| {
            fields.last(&format!("{what} and the end of the line"))?;
            if fields.len() > 1 || number < least { Err(fields.fault(what)) } else { Ok(number) }
        });
        return outcome.map_err(|fault| lines.place(*fault));
    }
}
