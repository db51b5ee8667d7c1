//! Labels: `0="init" 1="deadlock" 2="goal"`, then `3: 0 2` for every state with a label.

use std::collections::HashSet;
use std::io::BufRead;

use crate::formats::import::{Cursor, Fault, ImportError, Lines};
use crate::model::{Labels, StateSet, require_memory};

/// Reads the labels of a model of `states` states; returns the initial states and the other labels.
///
/// States come in any order, on any number of lines; blanks, blank lines and lines that start with `#` are passed over.
pub(super) fn read_lab<R: BufRead>(
    lines: &mut Lines<'_, R>,
    states: u64,
) -> Result<(StateSet, Labels), ImportError> {
    const HEADER: &str = "a header that declares labels, `0=\"init\" 1=\"deadlock\"`";
    let names = loop {
        let Some(mut cursor) = lines.next_or_blank()? else {
            return Err(lines.refuse(1, HEADER, "the end of the file"));
        };
        if !is_content(&mut cursor) {
            continue;
        }
        let header = read_names(&mut cursor);
        break header.map_err(|fault| lines.place(*fault))?;
    };
    let Some(init) = names.iter().position(|name| name == "init") else {
        return Err(lines.refuse(1, "a label \"init\" for the initial states", "none"));
    };
    let bytes = (states / 8 + 8).saturating_mul(names.len() as u64 + 1);
    require_memory(format!("{} labels", names.len()), bytes)?;
    let mut sets = vec![StateSet::with_capacity(states as usize); names.len()];
    while let Some(mut cursor) = lines.next_or_blank()? {
        if is_content(&mut cursor) {
            let outcome = read_state(&mut cursor, states, &mut sets);
            outcome.map_err(|fault| lines.place(*fault))?;
        }
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

/// Skips blanks; whether anything but a comment follows.
pub(super) fn is_content(cursor: &mut Cursor<'_>) -> bool {
    cursor.skip_blanks();
    !cursor.at_line_end() && !cursor.at_end() && cursor.peek() != b'#'
}

fn read_names(cursor: &mut Cursor<'_>) -> Result<Vec<String>, Box<Fault>> {
    let mut names: Vec<String> = vec![];
    let mut seen = HashSet::new();
    while !cursor.at_line_end() && !cursor.at_end() {
        let start = cursor.offset();
        if cursor.unsigned("the number of a label, `0=\"init\"`")? != names.len() as u64 {
            return Err(cursor.fault_at(start, format!("label {}: numbers count up from 0", names.len())));
        }
        cursor.expect(b'=', "`=` and a name in quotes")?;
        cursor.expect(b'"', "a name in quotes")?;
        let start = cursor.offset();
        while !matches!(cursor.peek(), b'"' | b'\n') {
            cursor.advance(1);
        }
        let name = std::str::from_utf8(cursor.since(start)).ok().filter(|name| !name.is_empty());
        let name = name.ok_or_else(|| cursor.fault_at(start, "a name in UTF-8"))?;
        if !seen.insert(name) {
            return Err(cursor.fault_at(start, "every label once"));
        }
        names.push(name.to_owned());
        cursor.expect(b'"', "`\"` after the name")?;
        if !cursor.skip_blanks() && !cursor.at_line_end() && !cursor.at_end() {
            return Err(cursor.fault_here("a blank and the next label"));
        }
    }
    Ok(names)
}

fn read_state(cursor: &mut Cursor<'_>, states: u64, sets: &mut [StateSet]) -> Result<(), Box<Fault>> {
    let start = cursor.offset();
    let state = cursor.unsigned("the number of a state")?;
    if state >= states {
        return Err(cursor.fault_at(start, format!("a state below {states}, the number of states")));
    }
    cursor.skip_blanks();
    cursor.expect(b':', "`:` and labels")?;
    cursor.skip_blanks();
    while !cursor.at_line_end() && !cursor.at_end() {
        let start = cursor.offset();
        let label = cursor.unsigned("the number of a label")?;
        let count = sets.len();
        let Some(set) = usize::try_from(label).ok().and_then(|label| sets.get_mut(label)) else {
            return Err(cursor.fault_at(start, format!("a label below {count}, the number of labels")));
        };
        set.insert(state as usize);
        if !cursor.skip_blanks() && !cursor.at_line_end() && !cursor.at_end() {
            return Err(cursor.fault_here("a blank and the number of a label"));
        }
    }
    Ok(())
}
