//! The rows of a model, as stencils.

use super::reach::Reach;
use super::{Ground, Special, Stencil};
use crate::problem::TargetId;
use imdp::model::{ComputedRows, Row, RowBuffer, RowId, RowSet};
use rayon::prelude::*;
use std::collections::HashMap;
use std::sync::Arc;

/// Rows per parallel task; each begins anew, so that nothing depends on the number of threads.
const ROWS_PER_TASK: usize = 512;

/// Tasks whose results are put together at once.
const TASKS: usize = 128;

/// One row per target on each of some grounds that differ in states only, ground after ground.
#[derive(Debug)]
pub(in super::super) struct StencilRows {
    grounds: Arc<[Ground]>,
    /// How many rows there are on each.
    targets: usize,
    stencils: Arc<[Stencil]>,
    /// Per row, its stencil.
    shapes: Vec<u32>,
    /// Per row, the place of its special intervals in `specials`.
    special: Vec<u32>,
    specials: Vec<Special>,
    /// Per row, how many entries it has.
    lengths: Vec<u32>,
    entries: usize,
    reach: Reach,
}

/// What is kept of a row.
pub(in super::super) struct Chosen {
    /// Which stencil it is.
    pub(in super::super) stencil: u32,
    pub(in super::super) special: Special,
    /// How many entries it has.
    pub(in super::super) length: u32,
}

impl StencilRows {
    /// Rows for so many targets, chosen in parallel with what `start` gives each task.
    pub(in super::super) fn new<T>(
        grounds: Arc<[Ground]>,
        stencils: Arc<[Stencil]>,
        targets: usize,
        start: impl Fn() -> T + Sync,
        choose: impl Fn(&mut T, RowId) -> Chosen + Sync,
    ) -> Self {
        let count = grounds.len() * targets;
        let mut rows = Self {
            reach: Reach::new(&grounds[0], &stencils),
            grounds,
            targets,
            stencils,
            shapes: Vec::with_capacity(count),
            special: Vec::with_capacity(count),
            specials: vec![],
            lengths: Vec::with_capacity(count),
            entries: 0,
        };
        let mut known = HashMap::new();
        for first in (0..count).step_by(ROWS_PER_TASK * TASKS) {
            let tasks = (first..count).step_by(ROWS_PER_TASK).take(TASKS).collect::<Vec<_>>();
            let of_task = |from: usize| -> Vec<Chosen> {
                let mut own = start();
                (from..count)
                    .take(ROWS_PER_TASK)
                    .map(|row| choose(&mut own, RowId::from_index(row)))
                    .collect()
            };
            let parts: Vec<Vec<Chosen>> = tasks.into_par_iter().map(of_task).collect();
            parts.into_iter().flatten().for_each(|chosen| rows.push(chosen, &mut known));
        }
        rows.specials.shrink_to_fit();
        rows
    }

    fn push(&mut self, Chosen { stencil, special, length }: Chosen, known: &mut HashMap<[u64; 5], u32>) {
        let reached = special.reached.unwrap_or_default();
        let bounds = [special.first.0, special.first.1, reached.0, reached.1].map(f64::to_bits);
        let key = [bounds[0], bounds[1], bounds[2], bounds[3], u64::from(special.reached.is_some())];
        let specials = &mut self.specials;
        let place = *known.entry(key).or_insert_with(|| {
            specials.push(special);
            specials.len() as u32 - 1
        });
        self.shapes.push(stencil);
        self.special.push(place);
        self.lengths.push(length);
        self.entries += length as usize;
    }
}

impl From<StencilRows> for RowSet {
    fn from(rows: StencilRows) -> Self {
        Self::Computed(Arc::new(rows))
    }
}

impl ComputedRows for StencilRows {
    fn len(&self) -> usize {
        self.lengths.len()
    }

    fn num_entries(&self) -> usize {
        self.entries
    }

    fn row_len(&self, id: RowId) -> usize {
        self.lengths[id.index()] as usize
    }

    fn row<'a>(&'a self, id: RowId, buffer: &'a mut RowBuffer) -> Row<'a> {
        let stencil = &self.stencils[self.shapes[id.index()] as usize];
        let special = self.specials[self.special[id.index()] as usize];
        let RowBuffer { entries, coordinates } = buffer;
        let (layer, target) = (id.index() / self.targets, TargetId::from_index(id.index() % self.targets));
        let ground = &self.grounds[layer];
        ground.origin(target, coordinates);
        stencil.row(ground, coordinates, (special, self.row_len(id)), entries)
    }

    fn most_of_successors(&self, of_states: &[f64]) -> Vec<f64> {
        self.grounds.iter().flat_map(|ground| self.reach.most(ground, of_states)).collect()
    }
}
