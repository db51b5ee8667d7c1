//! Writing IntervalMDP.jl's files.

use crate::formats::bmdp::padded_choices;
use crate::model::{IntervalMdp, ModelKind, RowBuffer, RowId, StateId, StateSet};
use hdf5_pure::{AttrValue, FileBuilder};
use serde_json::{Value, json};
use std::io::{self, Write};

/// Writes a model in IntervalMDP.jl's format.
///
/// Every state gets as many actions as the state with the most, the last of its own repeated: that changes no value.
#[derive(Debug)]
pub struct NetcdfWriter<'a> {
    model: &'a IntervalMdp,
    actions: usize,
}

/// A model that is too large for the format.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "found {entries} transitions with {actions} actions in every state; expected at most 2147483647, which is what IntervalMDP.jl reads"
)]
pub struct NetcdfError {
    /// The number of transitions.
    pub entries: u64,
    /// The number of actions of every state.
    pub actions: usize,
}

impl<'a> NetcdfWriter<'a> {
    /// Prepares to write `model`.
    ///
    /// # Errors
    /// [`NetcdfError`] if it is too large.
    pub fn new(model: &'a IntervalMdp) -> Result<Self, NetcdfError> {
        let states = StateId::first(model.num_states());
        let actions = states.map(|state| model.choices().num_choices_of(state)).max().unwrap_or(0).max(1);
        let writer = Self { model, actions };
        let entries =
            writer.columns().map(|row| row.map_or(1, |row| model.rows().row_len(row)) as u64).sum::<u64>();
        match i32::try_from(entries) {
            Ok(_) => Ok(writer),
            Err(_) => Err(NetcdfError { entries, actions }),
        }
    }

    fn columns(&self) -> impl Iterator<Item = Option<RowId>> + '_ {
        StateId::first(self.model.num_states())
            .flat_map(|state| padded_choices(self.model, state, self.actions))
    }

    /// Writes the model.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let model = self.model;
        let is_chain = model.kind() == ModelKind::Idtmc;
        let (mut starts, mut successors, mut lower, mut upper) = (vec![1], vec![], vec![], vec![]);
        let mut buffer = RowBuffer::default();
        for state in StateId::first(model.num_states()) {
            for row in padded_choices(model, state, self.actions) {
                match row.map(|row| model.rows().row(row, &mut buffer)) {
                    Some(row) => {
                        successors.extend(row.successors.iter().map(|&s| s.0 as i32 + 1));
                        lower.extend_from_slice(row.lower);
                        upper.extend_from_slice(row.upper);
                    }
                    None => {
                        successors.push(state.0 as i32 + 1);
                        lower.push(1.0);
                        upper.push(1.0);
                    }
                }
                starts.push(successors.len() as i32 + 1);
            }
        }
        let initial: Vec<i32> = model.initial().ones().map(|state| state as i32 + 1).collect();
        let owners: Vec<i32> =
            (0..=model.num_states()).map(|state| (state * self.actions) as i32 + 1).collect();
        let mut file = FileBuilder::new();
        let text = |text: &str| AttrValue::AsciiString(text.to_owned());
        file.set_attr("model", text(if is_chain { "imc" } else { "imdp" }));
        file.set_attr("format", text("sparse_csc"));
        file.set_attr("num_states", AttrValue::I32(model.num_states() as i32));
        file.set_attr("rows", text("to"));
        file.set_attr("cols", text(if is_chain { "from" } else { "from/action" }));
        let mut integers = |name: &str, values: &[i32]| {
            file.create_dataset(name).with_i32_data(values).with_shape(&[values.len() as u64]);
        };
        integers("initial_states", &initial);
        if !is_chain {
            integers("stateptr", &owners);
        }
        for name in ["lower", "upper"] {
            integers(&format!("{name}_colptr"), &starts);
            integers(&format!("{name}_rowval"), &successors);
        }
        for (name, values) in [("lower_nzval", &lower), ("upper_nzval", &upper)] {
            file.create_dataset(name).with_f64_data(values).with_shape(&[values.len() as u64]);
        }
        let content = file.finish().map_err(|error| io::Error::other(error.to_string()))?;
        out.write_all(&content)
    }
}

/// The specification of a reachability question: `reach` without ever meeting `avoid`, within so many steps if bounded.
pub fn specification(
    (policy_maximises, nature_maximises): (bool, bool),
    reach: &StateSet,
    avoid: Option<&StateSet>,
    steps: Option<u64>,
) -> Value {
    let list = |set: &StateSet| set.ones().map(|state| state + 1).collect::<Vec<_>>();
    let mut property = json!({
        "type": if avoid.is_some() { "reach-avoid" } else { "reachability" },
        "infinite_time": steps.is_none(),
        "reach": list(reach),
    });
    if let Some(avoid) = avoid {
        property["avoid"] = json!(list(avoid));
    }
    match steps {
        Some(steps) => property["time_horizon"] = json!(steps),
        None => property["eps"] = json!(1e-6),
    }
    // Nature is pessimistic if it works against the policy.
    let pessimistic = policy_maximises != nature_maximises;
    json!({
        "property": property,
        "satisfaction_mode": if pessimistic { "pessimistic" } else { "optimistic" },
        "strategy_mode": if policy_maximises { "maximize" } else { "minimize" },
    })
}
