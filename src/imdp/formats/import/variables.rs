//! Values of variables as they are written.

use super::error::Fault;
use super::text::Cursor;
use crate::model::{StateSet, VariableValues};

/// Reads the value of a variable in a state and appends it to the variable's column.
///
/// Values come state by state; the first one decides what the variable is. A new column has room for `room` states.
pub(crate) fn read_variable_value(
    cursor: &mut Cursor<'_>,
    state: usize,
    variable: usize,
    room: usize,
    columns: &mut Vec<VariableValues>,
) -> Result<(), Box<Fault>> {
    if columns.len() == variable {
        columns.push(new_column(cursor, room));
    }
    match columns.get_mut(variable) {
        Some(column) => push_value(cursor, state, column),
        None => Err(cursor.fault_here("no more values than variables")),
    }
}

fn new_column(cursor: &Cursor<'_>, states: usize) -> VariableValues {
    match cursor.peek() {
        b't' | b'f' => VariableValues::Bool(StateSet::with_capacity(states)),
        _ => VariableValues::Int(Vec::with_capacity(states)),
    }
}

fn push_value(cursor: &mut Cursor<'_>, state: usize, column: &mut VariableValues) -> Result<(), Box<Fault>> {
    match column {
        VariableValues::Bool(set) => {
            if cursor.skip(b"true") {
                set.grow_and_insert(state);
            } else if !cursor.skip(b"false") {
                return Err(cursor.fault_here("`true` or `false`"));
            }
        }
        VariableValues::Int(values) => values.push(read_integer(cursor)?),
    }
    Ok(())
}

fn read_integer(cursor: &mut Cursor<'_>) -> Result<i32, Box<Fault>> {
    let start = cursor.offset();
    let negative = cursor.skip(b"-");
    let magnitude = cursor.unsigned("an integer")?;
    let value = i64::try_from(magnitude).map_or(i64::MAX, |value| if negative { -value } else { value });
    i32::try_from(value).map_err(|_| cursor.fault_at(start, format!("between {} and {}", i32::MIN, i32::MAX)))
}

/// The value of a variable in one state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::formats) enum Value {
    Bool(bool),
    Int(i32),
    /// Something that no formula can ask about, such as a number with a fraction.
    Other,
}

/// Reads a value up to a comma, a blank or a closing parenthesis; Python's `True` and `False` are Boolean too.
pub(in crate::formats) fn read_value(cursor: &mut Cursor<'_>) -> Result<Value, Box<Fault>> {
    let start = cursor.offset();
    while !matches!(cursor.peek(), b',' | b')' | b' ' | b'\t' | b'\r' | b'\n') {
        cursor.advance(1);
    }
    let text = cursor.since(start);
    Ok(match text {
        b"" => return Err(cursor.fault_here("a value")),
        b"true" | b"True" => Value::Bool(true),
        b"false" | b"False" => Value::Bool(false),
        _ => {
            let (digits, line) = (text.strip_prefix(b"-").unwrap_or(text), [text, b"\n"].concat());
            if digits.iter().all(u8::is_ascii_digit) {
                let outcome = read_integer(&mut Cursor::new(&line, 0));
                Value::Int(outcome.map_err(|fault| cursor.fault_at(start, fault.expected))?)
            } else {
                let number = std::str::from_utf8(text).ok().and_then(|text| text.parse::<f64>().ok());
                match number.filter(|number| number.is_finite()) {
                    Some(_) => Value::Other,
                    None => return Err(cursor.fault_at(start, "a number, true or false")),
                }
            }
        }
    })
}
