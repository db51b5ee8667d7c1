//! Rewards: `[1, 0.5]` behind the number of a state or the name of an action, one value for each structure.

use crate::formats::import::{Cursor, Fault, RewardValue};
use crate::model::RewardStructure;

/// The rewards of the states and choices so far.
#[derive(Debug, Default)]
pub(super) struct RewardNotes {
    structures: Vec<RewardStructure>,
    /// Structures with intervals: they are left out.
    intervals: Vec<bool>,
}

impl RewardNotes {
    /// Structures of these names.
    pub(super) fn new(names: &[String]) -> Self {
        let structures = names.iter().map(RewardStructure::new).collect();
        Self { structures, intervals: vec![false; names.len()] }
    }

    /// Reads the rewards of a state.
    pub(super) fn of_state(&mut self, cursor: &mut Cursor<'_>, state: usize) -> Result<(), Box<Fault>> {
        if self.structures.is_empty() && state == 0 {
            // PRISM writes the name of a structure that has none as it is: nothing.
            self.structures.push(RewardStructure::new(""));
            self.intervals.push(false);
        }
        for (structure, value) in self.read(cursor)?.into_iter().enumerate() {
            put(&mut self.structures[structure].states, state, value);
        }
        Ok(())
    }

    /// Reads the rewards of a choice, counted over all states.
    pub(super) fn of_choice(&mut self, cursor: &mut Cursor<'_>, choice: u64) -> Result<(), Box<Fault>> {
        for (structure, value) in self.read(cursor)?.into_iter().enumerate() {
            put(&mut self.structures[structure].choices, choice as usize, value);
        }
        Ok(())
    }

    fn read(&mut self, cursor: &mut Cursor<'_>) -> Result<Vec<f64>, Box<Fault>> {
        let start = cursor.offset();
        cursor.expect(b'[', "`[` and rewards")?;
        let mut values = vec![];
        loop {
            cursor.skip_blanks();
            let at = cursor.offset();
            let mut depth = 0;
            while !cursor.at_line_end() && !cursor.at_end() {
                match cursor.peek() {
                    b'[' => depth += 1,
                    b']' if depth > 0 => depth -= 1,
                    b',' | b']' if depth == 0 => break,
                    _ => {}
                }
                cursor.advance(1);
            }
            match RewardValue::read(cursor.since(at)) {
                Some(RewardValue::Number(value)) => values.push(value),
                Some(RewardValue::Interval) => {
                    if let Some(flag) = self.intervals.get_mut(values.len()) {
                        *flag = true;
                    }
                    values.push(0.0);
                }
                None => return Err(cursor.fault_at(at, "a reward of at least 0, such as 0.5 or 1/3")),
            }
            if cursor.skip(b"]") {
                break;
            }
            cursor.expect(b',', "`,` or `]`")?;
        }
        match values.len() == self.structures.len() {
            true => Ok(values),
            false => {
                Err(cursor.fault_at(start, format!("{} rewards, as the header says", self.structures.len())))
            }
        }
    }

    /// The structures, and the names of those that are left out.
    pub(super) fn finish(self, states: usize, choices: u64) -> (Vec<RewardStructure>, Vec<String>) {
        let (mut kept, mut left_out) = (vec![], vec![]);
        for (mut structure, has_intervals) in self.structures.into_iter().zip(self.intervals) {
            if has_intervals {
                left_out.push(structure.name);
                continue;
            }
            for (values, length) in
                [(&mut structure.states, states), (&mut structure.choices, choices as usize)]
            {
                match values.iter().all(|value| *value == 0.0) {
                    true => values.clear(),
                    false => values.resize(length, 0.0),
                }
            }
            kept.push(structure);
        }
        (kept, left_out)
    }
}

/// Writes into a list that is as long as it has to be.
fn put(values: &mut Vec<f64>, index: usize, value: f64) {
    if value == 0.0 {
        return;
    }
    if values.len() <= index {
        values.resize(index + 1, 0.0);
    }
    values[index] = value;
}
