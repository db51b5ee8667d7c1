//! Labels: `0="init" 1="deadlock" 2="goal"`, then `3: 0 2` for every state with a label.

use std::collections::HashSet;
use std::io::BufReader;
use std::path::Path;

use crate::files;
use crate::formats::import::{Cursor, Fault, ImportError, Lines};
use crate::model::{Labels, StateSet, require_memory};

/// Reads a `.lab` file for a model of `states` states; returns the initial states and the other labels.
pub(super) fn read_lab(path: &Path, states: u64) -> Result<(StateSet, Labels), ImportError> {
    const HEADER: &str = "a header that declares labels, `0=\"init\" 1=\"deadlock\"`";
    let (file, _) = files::open(path).map_err(|error| ImportError::io(path, error))?;
    let mut lines = Lines::new(path, BufReader::new(file));
    lines.skip_comments()?;
    let Some(mut cursor) = lines.next()? else {
        return Err(lines.refuse(1, HEADER, "the end of the file"));
    };
    let header = read_names(&mut cursor);
    let names = header.map_err(|fault| lines.place(*fault))?;
    let Some(init) = names.iter().position(|name| name == "init") else {
        return Err(lines.refuse(1, "a label \"init\" for the initial states", "none"));
    };
    let bytes = (states / 8 + 8).saturating_mul(names.len() as u64 + 1);
    require_memory(format!("{} labels", names.len()), bytes)?;
    let mut sets = vec![StateSet::with_capacity(states as usize); names.len()];
    let mut seen = StateSet::with_capacity(states as usize);
    while let Some(mut cursor) = lines.next()? {
        let outcome = read_state(&mut cursor, &mut seen, &mut sets);
        outcome.map_err(|fault| lines.place(*fault))?;
    }
    if sets[init].is_clear() {
        return Err(lines.refuse(1, "a state with the label \"init\" in some line", "none"));
    }
    let initial = sets.remove(init);
    let others = names.into_iter().filter(|name| name != "init");
    let mut labels = Labels::default();
    for (name, set) in others.zip(sets) {
        labels.insert(name, set);
    }
    Ok((initial, labels))
}

fn read_names(cursor: &mut Cursor<'_>) -> Result<Vec<String>, Box<Fault>> {
    let mut names: Vec<String> = vec![];
    let mut seen = HashSet::new();
    while names.is_empty() || !cursor.at_line_end() {
        if !names.is_empty() {
            cursor.expect(b' ', "one blank and the next label")?;
        }
        let start = cursor.offset();
        if cursor.unsigned("the number of a label, `0=\"init\"`")? != names.len() as u64 {
            return Err(cursor.fault_at(start, format!("label {}: numbers count up from 0", names.len())));
        }
        cursor.expect(b'=', "`=` and a name in quotes")?;
        cursor.expect(b'"', "a name in quotes")?;
        let start = cursor.offset();
        let name = cursor.identifier("a name that is an identifier")?;
        if !seen.insert(name) {
            return Err(cursor.fault_at(start, "every label once"));
        }
        cursor.expect(b'"', "`\"` after the name")?;
        names.push(name.to_owned());
    }
    cursor.line_end("the end of the line")?;
    Ok(names)
}

fn read_state(cursor: &mut Cursor<'_>, seen: &mut StateSet, sets: &mut [StateSet]) -> Result<(), Box<Fault>> {
    let state = cursor.unsigned("the number of a state")?;
    if state >= seen.len() as u64 {
        return Err(cursor.fault_at(0, format!("a state below {}, the number of states", seen.len())));
    }
    let state = state as usize;
    if seen.put(state) {
        return Err(cursor.fault_at(0, "every state in one line only"));
    }
    cursor.expect(b':', "`:` and labels")?;
    let mut first = true;
    while first || !cursor.at_line_end() {
        cursor.expect(b' ', "one blank and the number of a label")?;
        let start = cursor.offset();
        let label = cursor.unsigned("the number of a label")?;
        let count = sets.len();
        let Some(set) = usize::try_from(label).ok().and_then(|label| sets.get_mut(label)) else {
            return Err(cursor.fault_at(start, format!("a label below {count}, the number of labels")));
        };
        if set.put(state) {
            return Err(cursor.fault_at(start, "every label of a state once"));
        }
        first = false;
    }
    cursor.line_end("the end of the line")
}
