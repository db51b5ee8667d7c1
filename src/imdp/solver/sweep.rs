//! One application of the Bellman operator to a set of rows and states.
//!
//! `W(a) = opt_p p·V` for every row, then `V⁺(s) = opt_a W(a)` over the ranges of every state. Each row is
//! evaluated once, however many states share it. The results do not depend on the number of threads or processes:
//! every value is computed from the previous values alone.

use super::expectation::{Bound, RowBlock, Workspace};
use super::query::Players;
use super::range_optimum::RangeOptimum;
use crate::model::{IntervalMdp, RowId, StateId};
use crate::ranks::Share;
use rayon::prelude::*;

/// Entries per block of rows: large enough to outweigh the hand-over to a thread.
const BLOCK_ENTRIES: usize = 8192;

/// Below this many choices, a parallel loop over states costs more than it saves.
const PARALLEL_RANGES: usize = 32768;

/// The rows and states of a part of the model, ready to be iterated.
pub(super) struct Sweep<'a> {
    model: &'a IntervalMdp,
    players: Players,
    pub states: Vec<StateId>,
    blocks: Vec<RowBlock>,
    /// Whose blocks are whose.
    share: Share,
    /// Of a single block.
    workspace: Workspace,
    many_ranges: bool,
}

impl<'a> Sweep<'a> {
    pub(super) fn new(
        model: &'a IntervalMdp,
        players: Players,
        states: Vec<StateId>,
        rows: &[RowId],
    ) -> Self {
        let mut blocks = vec![];
        let (mut block, mut entries) = (vec![], 0);
        for &row in rows {
            block.push(row);
            entries += model.rows().row_len(row);
            if entries >= BLOCK_ENTRIES {
                blocks.push(RowBlock::new(std::mem::take(&mut block)));
                entries = 0;
            }
        }
        if !block.is_empty() {
            blocks.push(RowBlock::new(block));
        }
        let share = Share::new(blocks.len(), blocks.len() * BLOCK_ENTRIES);
        let mut workspace = Workspace::default();
        blocks[share.own()].iter_mut().for_each(|block| block.prepare(model.rows(), &mut workspace));
        let ranges: usize = states.iter().map(|&s| model.choices().ranges(s).len()).sum();
        let many_ranges = ranges >= PARALLEL_RANGES;
        Self { model, players, states, blocks, share, workspace, many_ranges }
    }

    /// The rows, in blocks.
    pub(super) fn rows(&self) -> impl Iterator<Item = RowId> + '_ {
        self.blocks.iter().flat_map(|block| block.rows.iter().copied())
    }

    /// Evaluates the rows at `values` into the table.
    pub(super) fn evaluate_rows(&mut self, values: &[f64], side: Bound, table: &mut RangeOptimum) {
        self.evaluate_some_rows(values, side, table, |_| true);
    }

    /// Evaluates those rows that are `wanted`; the others keep what the table says.
    pub(super) fn evaluate_some_rows(
        &mut self,
        values: &[f64],
        side: Bound,
        table: &mut RangeOptimum,
        wanted: impl Fn(RowId) -> bool + Sync,
    ) {
        let (all, way) = (self.model.rows(), (self.players.nature, side));
        let results: Vec<Vec<f64>> = {
            let known = |row: RowId| (!wanted(row)).then(|| table.values()[row.index()]);
            let evaluate = |workspace: &mut Workspace, block: &mut RowBlock| {
                block.evaluate(all, values, way, known, workspace)
            };
            match &mut self.blocks[self.share.own()] {
                [block] => vec![evaluate(&mut self.workspace, block)],
                blocks => blocks.par_iter_mut().map_init(Workspace::default, evaluate).collect(),
            }
        };
        let weights = table.values_mut();
        let mut note = |row: RowId, w: f64| weights[row.index()] = w;
        if self.share.is_all() {
            let blocks = self.blocks.iter().zip(results);
            blocks.for_each(|(block, results)| block.rows.iter().zip(results).for_each(|(&r, w)| note(r, w)));
        } else {
            self.rows().zip(self.results_of_all(results)).for_each(|(row, w)| note(row, w));
        }
        table.rebuild();
    }

    /// The results of the rows of all processes, from those of the blocks of this one.
    fn results_of_all(&self, own: Vec<Vec<f64>>) -> Vec<f64> {
        let ends = self.blocks.iter().scan(0, |end, block| {
            *end += block.rows.len();
            Some(*end)
        });
        let starts: Vec<usize> = std::iter::once(0).chain(ends).collect();
        let mut all = vec![0.0; starts[self.blocks.len()]];
        let places = all[starts[self.share.own().start]..].iter_mut();
        places.zip(own.into_iter().flatten()).for_each(|(place, w)| *place = w);
        self.share.complete_with(&mut all, |block| starts[block]);
        all
    }

    /// The optimum over the choices of every state, in the order of [`Sweep::states`].
    pub(super) fn evaluate_states(&self, table: &RangeOptimum, out: &mut Vec<f64>) {
        let choices = self.model.choices();
        out.clear();
        if self.many_ranges {
            out.resize(self.states.len(), 0.0);
            let share = Share::new(self.states.len(), choices.num_ranges());
            let (states, own) = (&self.states[share.own()], &mut out[share.own()]);
            let both = states.par_iter().zip(own).with_min_len(256);
            both.for_each(|(&s, best)| *best = table.best(choices.ranges(s)));
            share.complete(out);
        } else {
            out.extend(self.states.iter().map(|&s| table.best(choices.ranges(s))));
        }
    }
}
