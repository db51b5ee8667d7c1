//! Writing UMB: streamed from shared rows.

mod actions;
mod archive;
mod index;
mod rewards;
mod valuations;

use super::member;
use crate::formats::names::{NameError, NameRule};
use crate::formats::prism::RAISED_LOWER_BOUND;
use crate::model::{IntervalMdp, RowId, StateId, StateSet};
use crate::progress::Progress;
use actions::Actions;
use archive::{PIECE, TarStream};
use flate2::GzBuilder;
use std::collections::HashSet;
use std::io::{self, BufWriter, Write};

/// Fast: a higher level makes files a little smaller and takes several times as long.
const LEVEL: u32 = 1;

const NAMES: NameRule =
    NameRule { format: "UMB", expected: "a name that is not empty", accepts: |name| !name.is_empty() };

/// Whether an archive is compressed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Compression {
    /// By gzip, as PRISM and Storm write it.
    #[default]
    Gzip,
    /// Not at all: larger, and faster to write and to read.
    None,
}

/// Writes a model in the UMB format.
#[derive(Debug)]
pub struct UmbWriter<'a> {
    model: &'a IntervalMdp,
    actions: Actions<'a>,
    /// The states without choices.
    deadlocks: StateSet,
    choices: u64,
    branches: u64,
    /// What lower bounds of 0 are written as, if there are any.
    raised: Option<f64>,
    rows: RowBytes,
}

/// Per row, the bytes of its destinations and bounds.
#[derive(Debug)]
struct RowBytes {
    targets: Vec<u8>,
    bounds: Vec<u8>,
    /// Where the entries of each row start.
    starts: Vec<usize>,
}

impl RowBytes {
    fn render(model: &IntervalMdp, raised: Option<f64>) -> Self {
        let entries = model.rows().num_entries();
        let (mut targets, mut bounds) = (Vec::with_capacity(8 * entries), Vec::with_capacity(16 * entries));
        let mut starts = vec![0];
        model.rows().for_each(|_, row| {
            for ((&successor, &lower), &upper) in row.successors.iter().zip(row.lower).zip(row.upper) {
                let lower = raised.filter(|_| lower == 0.0).unwrap_or(lower);
                targets.extend(u64::from(successor).to_le_bytes());
                bounds.extend(lower.to_le_bytes());
                bounds.extend(upper.max(lower).to_le_bytes());
            }
            starts.push(targets.len() / 8);
        });
        Self { targets, bounds, starts }
    }

    fn targets(&self, row: RowId) -> &[u8] {
        let row = row.index();
        &self.targets[8 * self.starts[row]..8 * self.starts[row + 1]]
    }

    fn bounds(&self, row: RowId) -> &[u8] {
        let row = row.index();
        &self.bounds[16 * self.starts[row]..16 * self.starts[row + 1]]
    }
}

impl<'a> UmbWriter<'a> {
    /// Prepares to write `model`: renders its rows.
    ///
    /// # Errors
    /// [`NameError`] if a label, an action or a variable has no name.
    pub fn new(model: &'a IntervalMdp) -> Result<Self, NameError> {
        NAMES.check_labels(model)?;
        NAMES.check_actions(model)?;
        NAMES.check_variables(model)?;
        let mut deadlocks = StateSet::with_capacity(model.num_states());
        let states = 0..model.num_states();
        deadlocks.extend(states.filter(|&state| model.choices().is_deadlock(StateId::from_index(state))));
        let loops = deadlocks.count_ones(..) as u64;
        let raised = raised_lower_bound(model);
        Ok(Self {
            model,
            actions: Actions::new(model, loops > 0),
            deadlocks,
            choices: model.size().choices + loops,
            branches: model.size().transitions + loops,
            raised,
            rows: RowBytes::render(model, raised),
        })
    }

    /// The size of the archive in bytes, uncompressed.
    pub fn bytes(&self) -> u64 {
        let mut count = TarStream::counting();
        // Counting cannot fail.
        let _ = self.members(&mut count);
        count.bytes()
    }

    /// Writes the archive.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(
        &self,
        out: &mut impl Write,
        compression: Compression,
        progress: &dyn Progress,
    ) -> io::Result<()> {
        match compression {
            Compression::None => self.write_archive(out, progress),
            Compression::Gzip => {
                let buffered = BufWriter::with_capacity(PIECE, out);
                let mut gzip = GzBuilder::new().mtime(0).write(buffered, flate2::Compression::new(LEVEL));
                self.write_archive(&mut gzip, progress)?;
                gzip.finish()?.flush()
            }
        }
    }

    fn write_archive(&self, out: &mut dyn Write, progress: &dyn Progress) -> io::Result<()> {
        let mut tar = TarStream::new(out, progress);
        self.members(&mut tar)?;
        tar.finish()
    }

    fn members(&self, tar: &mut TarStream<'_>) -> io::Result<()> {
        let states = self.model.num_states() as u64;
        let index = self.index();
        tar.member(member::INDEX, index.len() as u64, |out| out.write_all(index.as_bytes()))?;
        tar.member(member::STATE_TO_CHOICES, 8 * (states + 1), |out| self.state_to_choices(out))?;
        tar.member(member::CHOICE_TO_BRANCHES, 8 * (self.choices + 1), |out| self.choice_to_branches(out))?;
        self.bitset(tar, member::STATE_IS_INITIAL, self.model.initial())?;
        tar.member(member::BRANCH_TO_TARGET, 8 * self.branches, |out| {
            self.for_each_choice(|state, row| match row {
                Some(row) => out.write_all(self.rows.targets(row)),
                None => out.write_all(&u64::from(state).to_le_bytes()),
            })
        })?;
        tar.member(member::BRANCH_TO_PROBABILITY, 16 * self.branches, |out| {
            self.for_each_choice(|_, row| match row {
                Some(row) => out.write_all(self.rows.bounds(row)),
                None => out.write_all(&[1f64.to_le_bytes(), 1f64.to_le_bytes()].concat()),
            })
        })?;
        self.actions.members(self, tar)?;
        for (id, (_, set)) in self.label_ids().iter().zip(self.labels()) {
            self.bitset(tar, &member::state_annotation(member::APS, id), set)?;
        }
        if !self.deadlocks.is_clear() {
            let name = member::state_annotation(member::OWN, member::WITHOUT_CHOICES);
            self.bitset(tar, &name, &self.deadlocks)?;
        }
        self.rewards(tar)?;
        self.valuations(tar)
    }

    /// Calls `take` for every choice with its state and its row, none for self-loops.
    fn for_each_choice(
        &self,
        mut take: impl FnMut(StateId, Option<RowId>) -> io::Result<()>,
    ) -> io::Result<()> {
        let choices = self.model.choices();
        for state in StateId::first(self.model.num_states()) {
            if choices.ranges(state).is_empty() {
                take(state, None)?;
            }
            choices.rows(state).try_for_each(|row| take(state, Some(row)))?;
        }
        Ok(())
    }

    fn state_to_choices(&self, out: &mut dyn Write) -> io::Result<()> {
        let choices = self.model.choices();
        let mut offset = 0u64;
        out.write_all(&offset.to_le_bytes())?;
        for state in StateId::first(self.model.num_states()) {
            let of_ranges: u64 = choices.ranges(state).iter().map(|range| range.len() as u64).sum();
            offset += of_ranges.max(1);
            out.write_all(&offset.to_le_bytes())?;
        }
        Ok(())
    }

    fn choice_to_branches(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut offset = 0u64;
        out.write_all(&offset.to_le_bytes())?;
        self.for_each_choice(|_, row| {
            offset += row.map_or(1, |row| self.model.rows().row_len(row) as u64);
            out.write_all(&offset.to_le_bytes())
        })
    }

    fn bitset(&self, tar: &mut TarStream<'_>, name: &str, set: &StateSet) -> io::Result<()> {
        let bytes = member::bitset_bytes(self.model.num_states() as u64);
        tar.member(name, bytes, |out| {
            let mut words = vec![0u8; bytes as usize];
            for state in set.ones() {
                words[state / 8] |= 1 << (state % 8);
            }
            out.write_all(&words)
        })
    }

    /// The labels but for the initial states, which have a place of their own.
    fn labels(&self) -> impl Iterator<Item = (&'a str, &'a StateSet)> {
        self.model.labels().iter().filter(|(name, _)| *name != "init")
    }
}

/// A tiny positive number that is not a bound of the model, if it has lower bounds of 0.
fn raised_lower_bound(model: &IntervalMdp) -> Option<f64> {
    if !model.rows().any(|row| row.lower.contains(&0.0)) {
        return None;
    }
    // Not above any upper bound, which may be smaller still.
    let (mut taken, mut raised) = (HashSet::new(), RAISED_LOWER_BOUND);
    model.rows().for_each(|_, row| {
        let bounds = row.lower.iter().chain(row.upper);
        taken.extend(bounds.filter(|&&bound| bound <= RAISED_LOWER_BOUND).map(|bound| bound.to_bits()));
        raised = row.upper.iter().copied().filter(|&upper| upper > 0.0).fold(raised, f64::min);
    });
    while taken.contains(&raised.to_bits()) && raised.next_down() > 0.0 {
        raised = raised.next_down();
    }
    Some(raised)
}
