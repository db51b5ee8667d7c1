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
        VariableValues::Int(values) => {
            let start = cursor.offset();
            let negative = cursor.skip(b"-");
            let magnitude = cursor.unsigned("an integer")?;
            let value =
                i64::try_from(magnitude).map_or(i64::MAX, |value| if negative { -value } else { value });
            let value = i32::try_from(value)
                .map_err(|_| cursor.fault_at(start, format!("between {} and {}", i32::MIN, i32::MAX)))?;
            values.push(value);
        }
    }
    Ok(())
}
