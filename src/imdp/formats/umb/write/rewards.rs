//! Rewards of states, choices and branches.

use super::{TarStream, UmbWriter, member};
use crate::model::RewardStructure;
use serde_json::{Map, Value, json};
use std::io::{self, Write};

/// What earns something in a structure.
fn entities(structure: &RewardStructure) -> Vec<&'static str> {
    let all = [
        ("states", structure.states.is_empty()),
        ("choices", structure.choices.is_empty()),
        ("branches", structure.branches.is_empty()),
    ];
    let earning: Vec<_> =
        all.into_iter().filter(|(_, is_empty)| !is_empty).map(|(entity, _)| entity).collect();
    // A structure must speak of something.
    if earning.is_empty() { vec!["states"] } else { earning }
}

impl UmbWriter<'_> {
    /// Per structure, its identifier.
    fn reward_ids(&self) -> Vec<String> {
        super::index::unique_ids(self.model.rewards().iter().map(|structure| structure.name.as_str()))
    }

    /// What the index says of the rewards.
    pub(super) fn reward_annotations(&self) -> Map<String, Value> {
        let describe = |structure: &RewardStructure| {
            json!({
                "alias": structure.name,
                "applies-to": entities(structure),
                "type": { "type": "double", "size": 64 },
            })
        };
        self.reward_ids().into_iter().zip(self.model.rewards().iter().map(describe)).collect()
    }

    /// Writes the values.
    pub(super) fn rewards(&self, tar: &mut TarStream<'_>) -> io::Result<()> {
        for (id, structure) in self.reward_ids().iter().zip(self.model.rewards().iter()) {
            for entity in entities(structure) {
                let name = format!("annotations/{}/{id}/{entity}/values.bin", member::REWARDS);
                let count = match entity {
                    "states" => self.model.num_states() as u64,
                    "choices" => self.choices,
                    _ => self.branches,
                };
                tar.member(&name, 8 * count, |out| self.values(structure, entity, out))?;
            }
        }
        Ok(())
    }

    fn values(&self, structure: &RewardStructure, entity: &str, out: &mut dyn Write) -> io::Result<()> {
        if entity == "states" {
            return (0..self.model.num_states())
                .try_for_each(|state| out.write_all(&structure.of_state(state).to_le_bytes()));
        }
        // States without choices have one in the file that the model does not count; it earns nothing.
        let mut next = 0u64;
        self.for_each_choice(|state, row| {
            let is_own = row.is_some() || !self.deadlocks.contains(state.index());
            let length = row.map_or(1, |row| self.model.rows().row_len(row));
            if entity == "choices" {
                let value = if is_own { structure.of_choice(next) } else { 0.0 };
                out.write_all(&value.to_le_bytes())?;
            } else {
                for position in 0..length {
                    let value = if is_own { structure.of_branch(next, position) } else { 0.0 };
                    out.write_all(&value.to_le_bytes())?;
                }
            }
            next += u64::from(is_own);
            Ok(())
        })
    }
}
