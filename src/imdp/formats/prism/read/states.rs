//! States: `(v1,v2)`, then `0:(3,true)` for every state in order.

use std::collections::HashSet;
use std::io::BufReader;
use std::path::Path;

use crate::files;
use crate::formats::import::{Cursor, Fault, ImportError, Lines, read_variable_value};
use crate::model::{StateVariables, VariableValues, require_memory};

/// Reads a `.sta` file for a model of `states` states.
pub(super) fn read_sta(path: &Path, states: u64) -> Result<StateVariables, ImportError> {
    let (file, _) = files::open(path).map_err(|error| ImportError::io(path, error))?;
    let mut lines = Lines::new(path, BufReader::new(file));
    lines.skip_comments()?;
    let Some(mut cursor) = lines.next()? else {
        return Err(lines.refuse(
            1,
            "a header with the names of the variables, `(x,y)`",
            "the end of the file",
        ));
    };
    let header = read_names(&mut cursor);
    let names = header.map_err(|fault| lines.place(*fault))?;
    require_memory(format!("{} variables", names.len()), states.saturating_mul(4 * names.len() as u64))?;
    let mut columns: Vec<VariableValues> = vec![];
    for state in 0..states {
        let Some(mut cursor) = lines.next()? else {
            return Err(lines.refuse(1, format!("state {state} in a further line"), "the end of the file"));
        };
        let outcome = read_state(&mut cursor, state, states, names.len(), &mut columns);
        outcome.map_err(|fault| lines.place(*fault))?;
    }
    if let Some(cursor) = lines.next()? {
        let fault = cursor.fault_here(format!("no state after {}, the last one", states - 1));
        return Err(lines.place(*fault));
    }
    let mut variables = StateVariables::default();
    for (name, values) in names.into_iter().zip(columns) {
        variables.push(name, values);
    }
    Ok(variables)
}

fn read_names(cursor: &mut Cursor<'_>) -> Result<Vec<String>, Box<Fault>> {
    let mut names: Vec<String> = vec![];
    let mut seen = HashSet::new();
    cursor.expect(b'(', "`(` and the names of the variables")?;
    while names.is_empty() || !cursor.skip(b")") {
        if !names.is_empty() {
            cursor.expect(b',', "`,` or `)`")?;
        }
        let start = cursor.offset();
        let name = cursor.identifier("the name of a variable")?;
        if !seen.insert(name) {
            return Err(cursor.fault_at(start, "every variable once"));
        }
        names.push(name.to_owned());
    }
    cursor.line_end("the end of the line")?;
    Ok(names)
}

fn read_state(
    cursor: &mut Cursor<'_>,
    state: u64,
    states: u64,
    variables: usize,
    columns: &mut Vec<VariableValues>,
) -> Result<(), Box<Fault>> {
    let expected = "the number of a state";
    if cursor.unsigned(expected)? != state {
        return Err(cursor.fault_at(0, format!("state {state}")));
    }
    cursor.expect(b':', "`:`")?;
    for variable in 0..variables {
        match variable {
            0 => cursor.expect(b'(', "`(`")?,
            _ => cursor.expect(b',', "`,` and the value of the next variable")?,
        }
        read_variable_value(cursor, state as usize, variable, states as usize, columns)?;
    }
    cursor.expect(b')', "`)` after the last variable")?;
    cursor.line_end("the end of the line")
}
