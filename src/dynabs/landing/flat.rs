//! The classical abstraction: a choice leads to the cells at once, each with an interval of its own.
//!
//! For programs that want plain abstractions. The interval of a place is what an adversary (a helper) who wants
//! nothing but that place would make of it on the lattice: the bounds of all places at once say less than the lattice does.
//!
//! # Why it is sound
//!
//! Let `p` be what the lattice's noise leads to under some choices of nature. Then `p(place)` is at least the least and at most
//! the greatest expected value of the place's indicator, and what fails is 1 less what does not: `p` is a distribution of the
//! row. A cell that no listed noise can lead to is left out: other noise has failed, or is where it is best, in `reached`
//! or, without that, in `lost`. So the lower bound of this model is at most, and its upper bound at least, that of
//! the lattice.

use super::arrivals::{FAILED, LOST, REACHED};
use super::model::{LandingModel, Ranges, Skeleton};
use super::side::{Listed, Lower, Upper};
use super::solve::Question;
use imdp::model::{GrowingMemory, ImdpError, MemoryError, StateId};
use imdp::numeric::{one_minus_down, one_minus_up};
use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

/// Why there is no flat model.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FlatModelError {
    /// It does not fit into memory.
    #[error(transparent)]
    Memory(#[from] MemoryError),
    /// The parts do not make a model.
    #[error(transparent)]
    Model(#[from] ImdpError),
}

/// Bounds on the probability of one outcome, by range; those in which it is impossible are left out.
type Column = Vec<(u32, f64, f64)>;

/// By range: its row.
type FlatRows = Vec<Vec<(StateId, f64, f64)>>;

/// What an entry takes in a column, and in the row that is made of it.
const BYTES_OF_ENTRY: u64 = 24 + 40;

impl Question<'_> {
    /// The model in which a choice leads to cells, with `initial` cells.
    ///
    /// # Errors
    /// [`FlatModelError`] if it is too large.
    pub fn flat_model(&self, initial: &[u32]) -> Result<LandingModel, FlatModelError> {
        self.with_clock(|question| question.flat_model_of_memories(initial))
    }

    fn flat_model_of_memories(&self, initial: &[u32]) -> Result<LandingModel, FlatModelError> {
        let skeleton = Skeleton::new(self);
        let mut columns = Columns::new(self, &skeleton);
        let mut rows = skeleton.first_row();
        for of_cell in &skeleton.arrivals.of_cell {
            for row in columns.rows(of_cell)? {
                row.into_iter().for_each(|(state, lower, upper)| rows.push_entry(state, lower, upper));
                rows.finish_row();
            }
        }
        skeleton.arrivals.push_picks(&mut rows);
        let micro_steps = 1 + u64::from(self.task.is_ambiguous());
        Ok(skeleton.finish(rows, skeleton.arrivals.end, initial, micro_steps)?)
    }
}

/// The outcomes looked at so far.
struct Columns<'a> {
    question: &'a Question<'a>,
    ranges: &'a Ranges,
    can_be_done: bool,
    /// By the cells of the outcome.
    known: HashMap<Vec<u32>, Arc<Column>>,
    memory: GrowingMemory,
    entries: u64,
}

impl<'a> Columns<'a> {
    fn new(question: &'a Question<'a>, skeleton: &'a Skeleton) -> Self {
        let memory = GrowingMemory::new("the intervals of the flat encoding");
        let Skeleton { ranges, can_be_done, .. } = skeleton;
        Self { question, ranges, can_be_done: *can_be_done, known: HashMap::new(), memory, entries: 0 }
    }

    /// The rows of all ranges, for the states in which runs arrive, by cell.
    fn rows(&mut self, of_cell: &[StateId]) -> Result<FlatRows, FlatModelError> {
        let mut cells: BTreeMap<StateId, Vec<u32>> = BTreeMap::new();
        (0..).zip(of_cell).for_each(|(cell, &state)| cells.entry(state).or_default().push(cell));
        let failing = cells.remove(&FAILED).unwrap_or_default();
        let mut rows: FlatRows = vec![vec![]; self.ranges.images.len()];
        let mut put = |state: StateId, column: &Column| {
            column.iter().for_each(|&(range, lower, upper)| rows[range as usize].push((state, lower, upper)));
        };
        put(FAILED, &self.failure(&failing));
        // Unlisted mass is won or lost at once: a step later it may be too late.
        if self.can_be_done {
            put(REACHED, &self.reached(&cells.remove(&REACHED).unwrap_or_default()));
        } else {
            put(LOST, &self.reached(&[]));
        }
        for (&state, cells) in &cells {
            put(state, &*self.column(cells)?);
        }
        Ok(rows)
    }

    /// The extremum over every range of the probability of some cells.
    fn extrema<S: super::Side>(&self, indicator: &[f64]) -> Vec<f64> {
        let Question { landing, images, .. } = self.question;
        landing.extrema::<S>(images, &self.ranges.images, indicator)
    }

    fn column(&mut self, cells: &[u32]) -> Result<Arc<Column>, FlatModelError> {
        if let Some(known) = self.known.get(cells).cloned() {
            self.grow(known.len())?;
            return Ok(known);
        }
        let indicator = self.indicator(cells);
        let (lower, mut upper) = (self.extrema::<Lower>(&indicator), self.extrema::<Upper>(&indicator));
        let possible = self.extrema::<Listed>(&indicator);
        upper.iter_mut().zip(possible).filter(|(_, p)| *p == 0.0).for_each(|(upper, _)| *upper = 0.0);
        let column = column(&lower, &upper);
        self.grow(column.len())?;
        let column = Arc::new(column);
        self.known.insert(cells.to_vec(), column.clone());
        Ok(column)
    }

    fn grow(&mut self, entries: usize) -> Result<(), MemoryError> {
        self.memory.make_room(BYTES_OF_ENTRY * self.entries, BYTES_OF_ENTRY * entries as u64)?;
        self.entries += entries as u64;
        Ok(())
    }

    /// What leads outside or into cells that have failed.
    fn failure(&self, failing: &[u32]) -> Column {
        let mut survives = vec![1.0; self.question.task.num_cells()];
        failing.iter().for_each(|&cell| survives[cell as usize] = 0.0);
        let (least, most) = (self.extrema::<Lower>(&survives), self.extrema::<Upper>(&survives));
        let lower: Vec<f64> = most.iter().map(|&p| one_minus_down(p.min(1.0)).max(0.0)).collect();
        let upper: Vec<f64> = least.iter().map(|&p| one_minus_up(p.max(0.0)).min(1.0)).collect();
        column(&lower, &upper)
    }

    /// What leads into some cells, and noise that is not listed.
    fn reached(&self, cells: &[u32]) -> Column {
        let indicator = self.indicator(cells);
        column(&self.extrema::<Lower>(&indicator), &self.extrema::<Upper>(&indicator))
    }

    fn indicator(&self, cells: &[u32]) -> Vec<f64> {
        let mut indicator = vec![0.0; self.question.task.num_cells()];
        cells.iter().for_each(|&cell| indicator[cell as usize] = 1.0);
        indicator
    }
}

fn column(lower: &[f64], upper: &[f64]) -> Column {
    let ends = (0..).zip(lower.iter().zip(upper));
    ends.filter(|(_, (_, upper))| **upper > 0.0)
        .map(|(range, (&lower, &upper))| (range, lower, upper.min(1.0)))
        .collect()
}
