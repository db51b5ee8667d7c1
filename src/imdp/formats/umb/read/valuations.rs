//! The values of variables, packed bit by bit.

use super::super::member;
use super::archive::Archive;
use super::array::Array;
use super::index::{Field, ValuationClass};
use crate::formats::import::{ImportError, Position};
use crate::model::{StateSet, StateVariables, VariableValues, require_memory};
use std::collections::HashSet;

/// Where a variable is in the bits of a state.
struct Packed {
    name: String,
    first: usize,
    width: usize,
    offset: i64,
    is_signed: bool,
    values: VariableValues,
}

/// Reads the variables of `states` states.
///
/// # Errors
/// [`ImportError`] if the member is missing or has another size, or a value is beyond 32 bits.
pub(super) fn read_variables(
    archive: &Archive,
    class: ValuationClass,
    states: u64,
) -> Result<StateVariables, ImportError> {
    let at = |name: &str| Position::member(archive.path(), name, None);
    // No more bits are believed than there are.
    let most = archive.bytes(member::VALUATIONS).unwrap_or(u64::MAX / 8).saturating_mul(8);
    let (mut packed, bits) = layout(class, most).map_err(|found| {
        at(member::INDEX).refuse("variables with different names whose bits fill up whole bytes", found)
    })?;
    let integers = packed.iter().filter(|variable| matches!(variable.values, VariableValues::Int(_))).count();
    require_memory(format!("{} variables", packed.len()), states.saturating_mul(4 * integers as u64 + 1))?;
    let Some(mut array) = Array::open(archive, member::VALUATIONS, bits / 8, states)? else {
        return Err(
            at(member::VALUATIONS).refuse("the values of the variables in the index", "no such member")
        );
    };
    for variable in &mut packed {
        if let VariableValues::Int(values) = &mut variable.values {
            values.reserve_exact(states as usize);
        }
    }
    let mut bytes = vec![0; (bits / 8) as usize];
    for state in 0..states as usize {
        array.fill(&mut bytes)?;
        for variable in &mut packed {
            let bits = (0..variable.width).filter(|bit| {
                let at = variable.first + bit;
                bytes[at / 8] >> (at % 8) & 1 == 1
            });
            let raw = bits.fold(0u64, |value, bit| value | 1 << bit);
            match &mut variable.values {
                VariableValues::Bool(set) if raw == 1 => set.grow_and_insert(state),
                VariableValues::Bool(_) => {}
                VariableValues::Int(values) => {
                    let Some(value) = integer(raw, variable.width, variable.is_signed, variable.offset)
                    else {
                        let expected =
                            format!("a value of {} between {} and {}", variable.name, i32::MIN, i32::MAX);
                        return Err(array.refuse(expected, "one beyond"));
                    };
                    values.push(value);
                }
            }
        }
    }
    let mut variables = StateVariables::default();
    for mut variable in packed {
        if let VariableValues::Bool(set) = &mut variable.values {
            set.grow(states as usize);
        }
        variables.push(variable.name, variable.values);
    }
    Ok(variables)
}

/// The variables of a class and the number of its bits.
fn layout(class: ValuationClass, most: u64) -> Result<(Vec<Packed>, u64), String> {
    let mut packed: Vec<Packed> = vec![];
    let mut names = HashSet::new();
    let mut bits = 0u64;
    for field in class.variables {
        let first = bits as usize;
        let width = match field {
            Field::Padding { padding } => padding,
            Field::Variable { name, kind, offset, .. } => {
                if !names.insert(name.clone()) {
                    return Err(format!("{name} twice"));
                }
                let is_bool = kind.name == "bool";
                let width = kind.size.unwrap_or(if is_bool { 1 } else { 64 });
                let values = match is_bool {
                    true => VariableValues::Bool(StateSet::new()),
                    false => VariableValues::Int(vec![]),
                };
                let (is_signed, offset) = (kind.name == "int", offset.unwrap_or(0));
                packed.push(Packed { name, first, width: width as usize, offset, is_signed, values });
                width
            }
        };
        bits = bits.checked_add(width).filter(|&bits| bits <= most).ok_or("too many bits")?;
    }
    match bits {
        0 => Err("no bits".to_owned()),
        bits if bits % 8 != 0 => Err(format!("{bits} bits")),
        bits => Ok((packed, bits)),
    }
}

/// The integer in the lowest `width` bits.
fn integer(raw: u64, width: usize, is_signed: bool, offset: i64) -> Option<i32> {
    let unused = 64 - width;
    let value = if is_signed { i128::from((raw << unused) as i64 >> unused) } else { i128::from(raw) };
    i32::try_from(value + i128::from(offset)).ok()
}
