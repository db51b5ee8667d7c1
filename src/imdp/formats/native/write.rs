//! Writing a model as it is, section by section.

use std::io::{self, Write};
use std::path::Path;

use sha2::{Digest, Sha256};

use super::{MAGIC, Section, VERSION};
use crate::files::Outputs;
use crate::model::{
    ActionNames, IntervalMdp, Labels, ModelKind, RewardStructure, Rewards, StateId, StateSet, StateVariables,
    VariableValues,
};

/// Writes a model to a file, `model.dynabs` by custom, which appears or is replaced as a whole.
///
/// # Errors
/// What the system says when the file cannot be created or written.
pub fn write_file(model: &IntervalMdp, path: &Path) -> io::Result<()> {
    let mut files = Outputs::default();
    files.write(path, |out| write(model, out))?;
    files.commit()
}

/// Writes a model in the format of [`super`]; equal models give equal bytes.
///
/// Writes are small: give it a buffered writer.
///
/// # Errors
/// Those of the writer, and `InvalidInput` for a model with bounds that are not the shortest decimals of doubles: this
/// format has nothing else.
pub fn write(model: &IntervalMdp, out: &mut impl Write) -> io::Result<()> {
    if let Some(row) = model.rows().inexact_rows().next() {
        let problem = format!("row {row} has a bound that is not the shortest decimal of a double");
        return Err(io::Error::new(io::ErrorKind::InvalidInput, problem));
    }
    let mut out = Hashing { out, hash: Sha256::new() };
    out.write_all(&MAGIC)?;
    out.write_all(&VERSION.to_le_bytes())?;
    let (rows, choices) = (model.rows(), model.choices());
    let (states, entries) = (model.num_states(), rows.num_entries() as u64);
    let every_state = || StateId::first(states);

    out.section(Section::Kind, 1)?;
    out.write_all(&[u8::from(model.kind() == ModelKind::Idtmc)])?;
    out.section(Section::RowLengths, 4 * rows.len() as u64)?;
    out.array(rows.iter().map(|row| (row.len() as u32).to_le_bytes()))?;
    out.section(Section::Successors, 4 * entries)?;
    out.array(rows.iter().flat_map(|row| row.successors).map(|state| state.0.to_le_bytes()))?;
    out.section(Section::Lower, 8 * entries)?;
    out.array(rows.iter().flat_map(|row| row.lower).map(|bound| bound.to_le_bytes()))?;
    out.section(Section::Upper, 8 * entries)?;
    out.array(rows.iter().flat_map(|row| row.upper).map(|bound| bound.to_le_bytes()))?;
    out.section(Section::RangeCounts, 4 * states as u64)?;
    out.array(every_state().map(|state| (choices.ranges(state).len() as u32).to_le_bytes()))?;
    out.section(Section::Ranges, 8 * choices.num_ranges() as u64)?;
    let ranges = every_state().flat_map(|state| choices.ranges(state));
    out.array(ranges.flat_map(|range| [range.first.0.to_le_bytes(), range.last.0.to_le_bytes()]))?;
    out.section(Section::Absorbing, set_bytes(states))?;
    out.set(choices.absorbing(), states)?;
    out.section(Section::Initial, set_bytes(states))?;
    out.set(model.initial(), states)?;
    out.actions(model.actions())?;
    out.labels(model.labels(), states)?;
    out.variables(model.variables(), states)?;
    if !model.rewards().is_empty() {
        out.rewards(model.rewards())?;
    }

    let digest = out.hash.finalize();
    out.out.write_all(&digest)?;
    out.out.flush()
}

/// The length of a set of states.
fn set_bytes(states: usize) -> u64 {
    states.div_ceil(8) as u64
}

/// The length of a name.
fn name_bytes(name: &str) -> u64 {
    4 + name.len() as u64
}

/// A writer that hashes what passes.
struct Hashing<'a, W> {
    out: &'a mut W,
    hash: Sha256,
}

impl<W: Write> Hashing<'_, W> {
    fn write_all(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.hash.update(bytes);
        self.out.write_all(bytes)
    }

    fn section(&mut self, section: Section, length: u64) -> io::Result<()> {
        self.write_all(&(section as u32).to_le_bytes())?;
        self.write_all(&length.to_le_bytes())
    }

    /// Writes small items in larger pieces.
    fn array<const N: usize>(&mut self, items: impl Iterator<Item = [u8; N]>) -> io::Result<()> {
        let mut buffer = Vec::with_capacity(PIECE + N);
        for item in items {
            buffer.extend_from_slice(&item);
            if buffer.len() >= PIECE {
                self.write_all(&buffer)?;
                buffer.clear();
            }
        }
        self.write_all(&buffer)
    }

    fn set(&mut self, set: &StateSet, states: usize) -> io::Result<()> {
        let byte =
            |at: usize| (0..8).fold(0u8, |byte, bit| byte | u8::from(set.contains(8 * at + bit)) << bit);
        self.array((0..states.div_ceil(8)).map(|at| [byte(at)]))
    }

    fn name(&mut self, name: &str) -> io::Result<()> {
        self.write_all(&(name.len() as u32).to_le_bytes())?;
        self.write_all(name.as_bytes())
    }

    fn actions(&mut self, actions: &ActionNames) -> io::Result<()> {
        match actions {
            ActionNames::None | ActionNames::OfRow => {
                self.section(Section::Actions, 1)?;
                self.write_all(&[u8::from(*actions == ActionNames::OfRow)])
            }
            ActionNames::OfChoice { names, ids } => {
                let names_length: u64 = names.iter().map(|name| name_bytes(name)).sum();
                self.section(Section::Actions, 5 + names_length + 4 * ids.len() as u64)?;
                self.write_all(&[2])?;
                self.write_all(&(names.len() as u32).to_le_bytes())?;
                names.iter().try_for_each(|name| self.name(name))?;
                self.array(ids.iter().map(|id| id.to_le_bytes()))
            }
        }
    }

    fn rewards(&mut self, rewards: &Rewards) -> io::Result<()> {
        let branches = |of_branches: &Vec<f64>| 12 + 8 * of_branches.len() as u64;
        let length = |structure: &RewardStructure| {
            let values = (structure.states.len() + structure.choices.len()) as u64;
            name_bytes(&structure.name)
                + 6
                + 8 * values
                + structure.branches.values().map(branches).sum::<u64>()
        };
        self.section(Section::Rewards, 4 + rewards.iter().map(length).sum::<u64>())?;
        self.write_all(&(rewards.iter().len() as u32).to_le_bytes())?;
        for structure in rewards.iter() {
            self.name(&structure.name)?;
            for values in [&structure.states, &structure.choices] {
                self.write_all(&[u8::from(!values.is_empty())])?;
                self.array(values.iter().map(|value| value.to_le_bytes()))?;
            }
            self.write_all(&(structure.branches.len() as u32).to_le_bytes())?;
            for (choice, of_branches) in &structure.branches {
                self.write_all(&choice.to_le_bytes())?;
                self.write_all(&(of_branches.len() as u32).to_le_bytes())?;
                self.array(of_branches.iter().map(|value| value.to_le_bytes()))?;
            }
        }
        Ok(())
    }

    fn labels(&mut self, labels: &Labels, states: usize) -> io::Result<()> {
        let length: u64 = labels.iter().map(|(name, _)| name_bytes(name) + set_bytes(states)).sum();
        self.section(Section::Labels, 4 + length)?;
        self.write_all(&(labels.iter().count() as u32).to_le_bytes())?;
        labels.iter().try_for_each(|(name, set)| {
            self.name(name)?;
            self.set(set, states)
        })
    }

    fn variables(&mut self, variables: &StateVariables, states: usize) -> io::Result<()> {
        let values = |values: &VariableValues| match values {
            VariableValues::Int(values) => 4 * values.len() as u64,
            VariableValues::Bool(_) => set_bytes(states),
        };
        let lengths = variables.iter().map(|v| name_bytes(&v.name) + 1 + values(&v.values));
        self.section(Section::Variables, 4 + lengths.sum::<u64>())?;
        self.write_all(&(variables.iter().count() as u32).to_le_bytes())?;
        variables.iter().try_for_each(|variable| {
            self.name(&variable.name)?;
            match &variable.values {
                VariableValues::Int(values) => {
                    self.write_all(&[0])?;
                    self.array(values.iter().map(|value| value.to_le_bytes()))
                }
                VariableValues::Bool(set) => {
                    self.write_all(&[1])?;
                    self.set(set, states)
                }
            }
        })
    }
}

/// How much is handed to the hash and the writer at once.
const PIECE: usize = 1 << 16;
