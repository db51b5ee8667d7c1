//! Rewards: `# Reward structure "name"`, a line of counts, then `state reward` or `state choice destination reward`.

use std::collections::BTreeMap;
use std::io::BufRead;

use crate::formats::import::{Fault, Fields, ImportError, Lines, read_reward};
use crate::model::{IntervalMdp, ModelKind, RewardStructure, RowBuffer, StateId};

/// Reads state rewards into a structure; returns the name that a comment gives.
pub(super) fn read_srew<R: BufRead>(
    lines: &mut Lines<'_, R>,
    model: &IntervalMdp,
    structure: &mut RewardStructure,
) -> Result<(), ImportError> {
    let states = model.num_states();
    structure.states = vec![0.0; states];
    read_lines(lines, structure, 2..=2, |fields, structure| {
        let state = fields.number("a state", states as u64)? as usize;
        structure.states[state] = read_reward(fields)?;
        Ok(())
    })
}

/// Reads transition rewards into a structure.
pub(super) fn read_trew<R: BufRead>(
    lines: &mut Lines<'_, R>,
    model: &IntervalMdp,
    structure: &mut RewardStructure,
) -> Result<(), ImportError> {
    let choices = model.choices();
    let first_choices = choices.first_choices();
    let mut branches: BTreeMap<u64, Vec<f64>> = BTreeMap::new();
    let counts = if model.kind() == ModelKind::Imdp { 3..=3 } else { 2..=2 };
    read_lines(lines, structure, counts, |fields, _| {
        let state = StateId(fields.number("a state", model.num_states() as u64)? as u32);
        let own = choices.num_choices_of(state) as u64;
        let number = match model.kind() {
            ModelKind::Imdp => fields.number("a choice of the state", own)?,
            ModelKind::Idtmc if own == 0 => return Err(fields.fault("a state with transitions")),
            ModelKind::Idtmc => 0,
        };
        let destination = StateId(fields.number("a destination", model.num_states() as u64)? as u32);
        let buffer = &mut RowBuffer::default();
        let row = choices.row_of_choice(state, number as u32).map(|row| model.rows().row(row, buffer));
        let (position, length) = match row {
            Some(row) => (row.successors.binary_search(&destination).ok(), row.len()),
            // A self-loop has no row.
            None => ((destination == state).then_some(0), 1),
        };
        let position = position.ok_or_else(|| fields.fault("a destination of this choice"))?;
        let reward = read_reward(fields)?;
        let of_choice = branches.entry(first_choices[state.index()] + number).or_default();
        of_choice.resize(length, 0.0);
        of_choice[position] = reward;
        Ok(())
    })?;
    structure.set_branches(branches, choices.num_choices());
    Ok(())
}

/// Reads what follows the line of counts.
fn read_lines<R: BufRead>(
    lines: &mut Lines<'_, R>,
    structure: &mut RewardStructure,
    counts: std::ops::RangeInclusive<usize>,
    mut read: impl FnMut(&mut Fields<'_>, &mut RewardStructure) -> Result<(), Box<Fault>>,
) -> Result<(), ImportError> {
    let mut is_header = true;
    while let Some(cursor) = lines.next_or_blank()? {
        if let Some(name) = name(cursor.rest()) {
            structure.name = name.to_owned();
        }
        let Some(mut fields) = Fields::cut(&cursor, b"#") else { continue };
        if is_header {
            is_header = false;
            if !counts.contains(&fields.len()) {
                let found = fields.len();
                let expected = format!("{} counts in the first line", counts.start());
                return Err(lines.refuse(1, expected, found.to_string()));
            }
            continue;
        }
        let outcome =
            read(&mut fields, structure).and_then(|()| fields.last("the end of the line").map(drop));
        outcome.map_err(|fault| lines.place(*fault))?;
    }
    Ok(())
}

/// The name in `# Reward structure "name"`.
fn name(line: &[u8]) -> Option<&str> {
    let line = std::str::from_utf8(line).ok()?.trim_end();
    line.strip_prefix("# Reward structure \"")?.strip_suffix('"')
}
