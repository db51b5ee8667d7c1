//! Rewards of states, choices and branches.

use super::super::member;
use super::archive::Archive;
use super::array::{Array, Offsets};
use super::index::{Index, RewardEntry};
use crate::formats::import::{ImportError, Position};
use crate::model::{RewardStructure, StateSet, require_memory};
use std::collections::BTreeMap;

/// Reads the reward structures of the index; what is earned by the choices of states without choices is nothing.
///
/// # Errors
/// [`ImportError`] if a member is missing or has another size, or a reward is negative or not finite.
pub(super) fn read_rewards(
    archive: &Archive,
    index: &Index,
    without_choices: Option<&StateSet>,
) -> Result<Vec<RewardStructure>, ImportError> {
    let counts = index.counts;
    let bytes = 8 * (counts.states + 3 * counts.choices + counts.branches);
    require_memory("the rewards", bytes.saturating_mul(index.rewards.len() as u64))?;
    let mut structures = vec![];
    for RewardEntry { id, name, applies_to } in &index.rewards {
        let mut structure = RewardStructure::new(name);
        let read = |entity: &str, count: u64| read_values(archive, id, entity, count);
        for entity in applies_to {
            match entity.as_str() {
                "states" => structure.states = read("states", counts.states)?,
                "choices" => {
                    let values = read("choices", counts.choices)?;
                    for_each_choice(archive, index, without_choices, |choice| {
                        structure.choices.push(values[choice as usize]);
                        Ok(())
                    })?;
                }
                "branches" => {
                    let values = read("branches", counts.branches)?;
                    let branches = read_branches(archive, index, without_choices, &values)?;
                    let kept = branches.len() as u64;
                    structure.set_branches(branches, kept);
                }
                other => {
                    let at = Position::member(archive.path(), member::INDEX, None);
                    let found = format!("{other} in the rewards {id}");
                    return Err(at.refuse("rewards of states, choices and branches", found));
                }
            }
        }
        structures.push(structure);
    }
    Ok(structures)
}

/// Calls `take` for every choice that the model keeps.
fn for_each_choice(
    archive: &Archive,
    index: &Index,
    without_choices: Option<&StateSet>,
    mut take: impl FnMut(u64) -> Result<(), ImportError>,
) -> Result<(), ImportError> {
    let counts = index.counts;
    let mut of_state =
        Offsets::open(archive, member::STATE_TO_CHOICES, counts.states, counts.choices, "states")?;
    for state in 0..counts.states {
        for choice in of_state.next(state + 1 == counts.states)? {
            if !without_choices.is_some_and(|set| set.contains(state as usize)) {
                take(choice)?;
            }
        }
    }
    Ok(())
}

/// What branches earn, by choice of the model and position in its row.
fn read_branches(
    archive: &Archive,
    index: &Index,
    without_choices: Option<&StateSet>,
    values: &[f64],
) -> Result<BTreeMap<u64, Vec<f64>>, ImportError> {
    let counts = index.counts;
    let mut of_choice =
        Offsets::open(archive, member::CHOICE_TO_BRANCHES, counts.choices, counts.branches, "choices")?;
    let Some(mut targets) = Array::open(archive, member::BRANCH_TO_TARGET, 8, counts.branches)? else {
        let at = Position::member(archive.path(), member::BRANCH_TO_TARGET, None);
        return Err(at.refuse("the destinations of all branches", "no such member"));
    };
    let (mut next_choice, mut kept, mut branches) = (0, 0, BTreeMap::new());
    let mut read_choice = |wanted: bool, is_last: bool| -> Result<(), ImportError> {
        let mut row = vec![];
        for branch in of_choice.next(is_last)? {
            row.push((targets.next_u64()?, values[branch as usize]));
        }
        // A row lists its successors in ascending order.
        row.sort_by_key(|(target, _)| *target);
        if wanted {
            branches.insert(kept, row.into_iter().map(|(_, value)| value).collect());
            kept += 1;
        }
        Ok(())
    };
    for_each_choice(archive, index, without_choices, |choice| {
        while next_choice <= choice {
            read_choice(next_choice == choice, next_choice + 1 == counts.choices)?;
            next_choice += 1;
        }
        Ok(())
    })?;
    Ok(branches)
}

fn read_values(archive: &Archive, id: &str, entity: &str, count: u64) -> Result<Vec<f64>, ImportError> {
    let name = format!("annotations/{}/{id}/{entity}/values.bin", member::REWARDS);
    let Some(mut array) = Array::open(archive, &name, 8, count)? else {
        let at = Position::member(archive.path(), &name, None);
        return Err(at.refuse("the rewards in the index", "no such member"));
    };
    let mut values = Vec::with_capacity(count as usize);
    for _ in 0..count {
        let (value, _) = array.next_double()?;
        // Written so that NaN fails.
        if !(0.0..f64::INFINITY).contains(&value) {
            return Err(array.refuse("finite rewards of at least 0", format!("{value:?}")));
        }
        values.push(value);
    }
    Ok(values)
}
