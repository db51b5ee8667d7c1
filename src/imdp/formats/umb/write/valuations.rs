//! The values of variables, packed bit by bit.

use super::archive::TarStream;
use super::{UmbWriter, member};
use crate::model::{IntervalMdp, VariableValues};
use serde_json::{Value, json};
use std::io;

/// The number of bits of a variable.
fn bits(values: &VariableValues) -> u64 {
    match values {
        VariableValues::Int(_) => 32,
        VariableValues::Bool(_) => 1,
    }
}

/// The number of bytes of the variables of one state.
fn bytes_per_state(model: &IntervalMdp) -> u64 {
    model.variables().iter().map(|variable| bits(&variable.values)).sum::<u64>().div_ceil(8)
}

/// What the index says of the variables.
pub(super) fn description(model: &IntervalMdp) -> Value {
    let mut variables: Vec<Value> = model
        .variables()
        .iter()
        .map(|variable| {
            let kind = match variable.values {
                VariableValues::Int(_) => "int",
                VariableValues::Bool(_) => "bool",
            };
            json!({ "name": variable.name, "type": { "type": kind, "size": bits(&variable.values) } })
        })
        .collect();
    let used: u64 = model.variables().iter().map(|variable| bits(&variable.values)).sum();
    let padding = 8 * bytes_per_state(model) - used;
    if padding > 0 {
        variables.push(json!({ "padding": padding }));
    }
    json!({ "states": { "unique": false, "classes": [{ "variables": variables }] } })
}

impl UmbWriter<'_> {
    /// Writes the values, if there are variables.
    pub(super) fn valuations(&self, tar: &mut TarStream<'_>) -> io::Result<()> {
        let variables = self.model.variables();
        if variables.is_empty() {
            return Ok(());
        }
        let per_state = bytes_per_state(self.model);
        let states = self.model.num_states();
        tar.member(member::VALUATIONS, per_state * states as u64, |out| {
            let mut packed = vec![0u8; per_state as usize];
            for state in 0..states {
                packed.fill(0);
                let mut at = 0;
                for variable in variables.iter() {
                    let value = match &variable.values {
                        VariableValues::Int(values) => values[state] as u32,
                        VariableValues::Bool(set) => u32::from(set.contains(state)),
                    };
                    let width = bits(&variable.values) as usize;
                    for bit in (0..width).filter(|bit| value >> bit & 1 == 1) {
                        packed[(at + bit) / 8] |= 1 << ((at + bit) % 8);
                    }
                    at += width;
                }
                out.write_all(&packed)?;
            }
            Ok(())
        })
    }
}
