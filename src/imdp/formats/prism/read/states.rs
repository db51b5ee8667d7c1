//! States: `(v1,v2)`, then `0:(3,true)` for every state.

use std::collections::HashSet;
use std::io::BufRead;

use super::labels::is_content;
use crate::formats::import::{Cursor, Fault, ImportError, Lines, Value, read_value};
use crate::model::{StateSet, StateVariables, VariableValues, require_memory};

/// Reads the variables of a model of `states` states.
///
/// States come in any order, each once. Blanks, a comma behind the last value (as Python prints tuples of one), blank
/// lines and lines that start with `#` are passed over. Returns the names of variables that are left out as well: those
/// with values that are neither integers nor Boolean.
pub(super) fn read_sta<R: BufRead>(
    lines: &mut Lines<'_, R>,
    states: u64,
) -> Result<(StateVariables, Vec<String>), ImportError> {
    let names = loop {
        let Some(mut cursor) = lines.next_or_blank()? else {
            let expected = "a header with the names of the variables, `(x,y)`";
            return Err(lines.refuse(1, expected, "the end of the file"));
        };
        if !is_content(&mut cursor) {
            continue;
        }
        let header = read_names(&mut cursor);
        break header.map_err(|fault| lines.place(*fault))?;
    };
    require_memory(format!("{} variables", names.len()), states.saturating_mul(4 * names.len() as u64 + 1))?;
    let mut table = Table { states, seen: StateSet::with_capacity(states as usize), columns: vec![] };
    while let Some(mut cursor) = lines.next_or_blank()? {
        if is_content(&mut cursor) {
            let outcome = table.read_state(&mut cursor, names.len());
            outcome.map_err(|fault| lines.place(*fault))?;
        }
    }
    if let Some(missing) = table.seen.zeroes().next() {
        return Err(lines.refuse(1, format!("state {missing} in a further line"), "the end of the file"));
    }
    let (mut variables, mut left_out) = (StateVariables::default(), vec![]);
    for (name, column) in names.into_iter().zip(table.columns) {
        match column {
            Column::Known(values) => variables.push(name, values),
            Column::Other => left_out.push(name),
        }
    }
    Ok((variables, left_out))
}

fn read_names(cursor: &mut Cursor<'_>) -> Result<Vec<String>, Box<Fault>> {
    let mut names: Vec<String> = vec![];
    let mut seen = HashSet::new();
    cursor.expect(b'(', "`(` and the names of the variables")?;
    cursor.skip_blanks();
    while names.is_empty() || !cursor.skip(b")") {
        let start = cursor.offset();
        let name = cursor.identifier("the name of a variable")?;
        if !seen.insert(name) {
            return Err(cursor.fault_at(start, "every variable once"));
        }
        names.push(name.to_owned());
        end_of_item(cursor, "`,` or `)`")?;
    }
    end_of_line(cursor)?;
    Ok(names)
}

/// Passes over blanks and a comma; a closing parenthesis is left.
fn end_of_item(cursor: &mut Cursor<'_>, expected: &str) -> Result<(), Box<Fault>> {
    cursor.skip_blanks();
    if cursor.peek() != b')' {
        cursor.expect(b',', expected)?;
        cursor.skip_blanks();
    }
    Ok(())
}

fn end_of_line(cursor: &mut Cursor<'_>) -> Result<(), Box<Fault>> {
    cursor.skip_blanks();
    if cursor.at_line_end() || cursor.at_end() {
        Ok(())
    } else {
        Err(cursor.fault_here("the end of the line"))
    }
}

/// The values of a variable, as far as they are of a kind that formulas know.
enum Column {
    Known(VariableValues),
    Other,
}

struct Table {
    states: u64,
    seen: StateSet,
    columns: Vec<Column>,
}

impl Table {
    fn read_state(&mut self, cursor: &mut Cursor<'_>, variables: usize) -> Result<(), Box<Fault>> {
        let start = cursor.offset();
        let state = cursor.unsigned("the number of a state")?;
        if state >= self.states {
            let last = self.states - 1;
            return Err(cursor.fault_at(start, format!("no state after {last}, the last one")));
        }
        let state = state as usize;
        if self.seen.put(state) {
            return Err(cursor.fault_at(start, "every state once"));
        }
        cursor.skip_blanks();
        cursor.expect(b':', "`:`")?;
        cursor.skip_blanks();
        cursor.expect(b'(', "`(`")?;
        cursor.skip_blanks();
        for variable in 0..variables {
            if cursor.peek() == b')' {
                return Err(cursor.fault_here("the value of the next variable"));
            }
            let at = cursor.offset();
            let value = read_value(cursor)?;
            if self.columns.len() == variable {
                self.columns.push(Column::new(&value, self.states as usize));
            }
            if let Some(column) = self.columns.get_mut(variable) {
                column.set(state, value).map_err(|expected| cursor.fault_at(at, expected))?;
            }
            end_of_item(cursor, "`,` and the value of the next variable, or `)`")?;
        }
        cursor.expect(b')', "`)` after the last variable")?;
        end_of_line(cursor)
    }
}

impl Column {
    fn new(first: &Value, states: usize) -> Self {
        match first {
            Value::Bool(_) => Self::Known(VariableValues::Bool(StateSet::with_capacity(states))),
            Value::Int(_) => Self::Known(VariableValues::Int(vec![0; states])),
            Value::Other => Self::Other,
        }
    }

    fn set(&mut self, state: usize, value: Value) -> Result<(), &'static str> {
        match (&mut *self, value) {
            (Self::Known(VariableValues::Bool(set)), Value::Bool(value)) => set.set(state, value),
            (Self::Known(VariableValues::Int(values)), Value::Int(value)) => values[state] = value,
            (Self::Known(VariableValues::Bool(_)), _) => return Err("`true` or `false`"),
            (_, Value::Bool(_)) => return Err("a number"),
            _ => *self = Self::Other,
        }
        Ok(())
    }
}
