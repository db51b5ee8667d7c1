//! The `.srew` and `.trew` files: what is earned in states, and by choices on their branches.

use crate::formats::import::enclose;
use crate::model::{IntervalMdp, ModelKind, RewardStructure, RowBuffer, StateId};
use crate::numeric::{from_decimal, shortest_decimal};
use std::fmt::Write as _;
use std::io::{self, Write};

/// One of the two files of a reward structure.
#[derive(Clone, Debug)]
pub struct RewardFile<'a> {
    /// What its name ends with, behind that of the `.tra` file without its extension: `.srew`, or `1.srew` if there are
    /// several structures.
    pub suffix: String,
    model: &'a IntervalMdp,
    structure: &'a RewardStructure,
    is_of_states: bool,
}

impl<'a> RewardFile<'a> {
    /// The files of all structures of a model.
    pub fn all(model: &'a IntervalMdp) -> Vec<Self> {
        let count = model.rewards().iter().len();
        let number = |index: usize| if count == 1 { String::new() } else { (index + 1).to_string() };
        let of_structure = |(index, structure): (usize, &'a RewardStructure)| {
            [("srew", true), ("trew", false)].map(|(extension, is_of_states)| {
                let suffix = format!("{}.{extension}", number(index));
                Self { suffix, model, structure, is_of_states }
            })
        };
        model.rewards().iter().enumerate().flat_map(of_structure).collect()
    }

    /// Writes the file.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        if !self.structure.name.is_empty() {
            writeln!(out, "# Reward structure \"{}\"", self.structure.name)?;
        }
        match self.is_of_states {
            true => self.write_states(out),
            false => self.write_transitions(out),
        }
    }

    fn write_states(&self, out: &mut impl Write) -> io::Result<()> {
        let states = self.model.num_states();
        let earning =
            || (0..states).map(|s| (s, self.structure.of_state(s))).filter(|(_, reward)| *reward > 0.0);
        writeln!(out, "# State rewards\n{states} {}", earning().count())?;
        earning().try_for_each(|(state, reward)| writeln!(out, "{state} {}", shortest_decimal(reward)))
    }

    fn write_transitions(&self, out: &mut impl Write) -> io::Result<()> {
        let (model, structure) = (self.model, self.structure);
        let is_mdp = model.kind() == ModelKind::Imdp;
        let (mut lines, mut count, mut choice) = (String::new(), 0u64, 0);
        for state in StateId::first(model.num_states()) {
            let mut push = |number: usize, successor: StateId, position: usize, choice: u64| {
                let (of_choice, of_branch) =
                    (structure.of_choice(choice), structure.of_branch(choice, position));
                if of_choice + of_branch > 0.0 {
                    count += 1;
                    let number = if is_mdp { format!("{number} ") } else { String::new() };
                    // Writing to a string cannot fail.
                    let _ = writeln!(lines, "{state} {number}{successor} {}", total(of_choice, of_branch));
                }
            };
            if model.choices().is_absorbing(state) {
                push(0, state, 0, choice);
                choice += 1;
            }
            for (number, row) in model.choices().rows(state).enumerate() {
                let buffer = &mut RowBuffer::default();
                for (position, &successor) in model.rows().row(row, buffer).successors.iter().enumerate() {
                    push(number, successor, position, choice);
                }
                choice += 1;
            }
        }
        let choices = if is_mdp { format!("{} ", model.size().choices) } else { String::new() };
        writeln!(out, "# Transition rewards\n{} {choices}{count}", model.num_states())?;
        out.write_all(lines.as_bytes())
    }
}

/// The sum of two decimals, as a decimal.
fn total(of_choice: f64, of_branch: f64) -> String {
    match (from_decimal(of_choice), from_decimal(of_branch)) {
        (Some(of_choice), Some(of_branch)) => enclose(&(of_choice + of_branch)).lower,
        _ => shortest_decimal(of_choice + of_branch),
    }
}
