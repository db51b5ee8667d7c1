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
        self.evaluate_some_rows(values.as_chunks::<1>().0, [side], [table], |_| [true]);
    }

    /// Evaluates the rows at one or two values of every state, each row once, into a table for each; those that are not `wanted`
    /// keep what the table says.
    pub(super) fn evaluate_some_rows<const N: usize>(
        &mut self,
        values: &[[f64; N]],
        sides: [Bound; N],
        mut tables: [&mut RangeOptimum; N],
        wanted: impl Fn(RowId) -> [bool; N] + Sync,
    ) {
        let (all, way) = (self.model.rows(), (self.players.nature, sides));
        let own = self.share.own();
        // Blocks are in the order of their rows, so each has a stretch of the table to itself.
        let starts: Vec<usize> = self.blocks.iter().map(RowBlock::start).collect();
        let evaluate = |workspace: &mut Workspace, (block, out): (&mut RowBlock, [&mut [f64]; N])| {
            block.evaluate(all, values, way, &wanted, out, workspace);
        };
        let mut rests = tables.each_mut().map(|table| {
            let first = starts.get(own.start).copied().unwrap_or(0);
            &mut table.values_mut()[first..]
        });
        let own_blocks = self.blocks[own.clone()].iter_mut().enumerate().map(|(i, block)| {
            let next = own.start + i + 1;
            let length = starts.get(next).map(|next_start| next_start - starts[next - 1]);
            let out = rests.each_mut().map(|rest| {
                let whole = std::mem::take(rest);
                let (out, others) = whole.split_at_mut(length.unwrap_or(whole.len()));
                *rest = others;
                out
            });
            (block, out)
        });
        if own.len() == 1 {
            own_blocks.for_each(|task| evaluate(&mut self.workspace, task));
        } else {
            own_blocks.collect::<Vec<_>>().into_par_iter().for_each_init(Workspace::default, evaluate);
        }
        // What these rows are among: other parts of the model have stretches of their own.
        let first = starts.first().copied().unwrap_or(0);
        let end = self.blocks.last().map_or(first, RowBlock::end);
        for table in tables {
            let start = |block: usize| starts.get(block).copied().unwrap_or(end) - first;
            self.share.complete_with(&mut table.values_mut()[first..end], start);
            table.rebuild();
        }
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
