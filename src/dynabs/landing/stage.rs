//! One coordinate's noise: a convolution along one axis of an array.

use super::arrays::Arrays;
use super::axis::Axis;
use super::kernel::Run;
use super::side::Side;
use super::weights::Weights;
use imdp::ranks::Share;
use rayon::prelude::*;
use std::ops::Range;

/// How many numbers of a row are summed at a time: they stay in the first-level cache.
const BLOCK: usize = 1024;

/// Turns an array over cells into one over sub-cells along one axis: `outer × cells × inner` to `outer × len × inner`.
///
/// `G(i) = Σ_k p_k opt(V(i+k), V(i+k+1))`, the mass that the lower bounds `p_k` leave lost or won.
#[derive(Clone, Debug)]
pub(super) struct Stage {
    axis: Axis,
    /// By sub-cell that is looked at: what it leads to. Without noise a single cell, if it is in the partition.
    sources: Vec<Sources>,
    /// What the lower bounds leave of the mass.
    slack: f64,
}

/// Rows of an array over cells and rows of the array of its pairs, with their weights.
#[derive(Clone, Debug)]
struct Sources {
    rows: Vec<Run>,
    pairs: Vec<Run>,
    terms: usize,
}

impl Stage {
    pub(super) fn new(axis: &Axis) -> Self {
        let weights = axis.noise.as_ref().map(|taps| Weights::of(axis, taps));
        let sub_cells = axis.first..axis.first + axis.len as i64;
        let sources = sub_cells.map(|sub_cell| match &weights {
            None => Sources::cell(axis.cell(sub_cell)),
            Some(weights) => Sources::new(axis, weights, sub_cell),
        });
        let slack = axis.noise.as_ref().map_or(0.0, |taps| taps.slack());
        Self { sources: sources.collect(), slack, axis: axis.clone() }
    }

    pub(super) fn axis(&self) -> &Axis {
        &self.axis
    }

    /// How much longer the axis becomes.
    pub(super) fn growth(&self) -> f64 {
        self.axis.len as f64 / self.axis.cells as f64
    }

    /// The landing values, none too small to be multiplied, of an array with `inner` numbers for each cell of the axis.
    pub(super) fn apply<S: Side>(&self, values: &[f64], inner: usize, arrays: &Arrays) -> Vec<f64> {
        let Axis { cells, len, .. } = self.axis;
        let noisy = self.axis.noise.is_some();
        let mut out = arrays.take(values.len() / cells * len);
        let mut pairs = arrays.take(if noisy { values.len() / cells * (cells + 1) } else { 0 });
        let share = Share::new(out.len() / inner, out.len());
        if noisy {
            let blocks = share.own().start / len..share.own().end.div_ceil(len);
            self.pairs::<S>(values, inner, &mut pairs, blocks);
        }
        rows(&mut out, inner, share.own()).for_each(|(row, out)| {
            let (block, sources) = (row / len, &self.sources[row % len]);
            let values = &values[block * cells * inner..(block + 1) * cells * inner];
            if noisy {
                let pairs = &pairs[block * (cells + 1) * inner..(block + 1) * (cells + 1) * inner];
                out.fill(0.0);
                sources.sum::<S>((values, pairs), inner, out);
                let slack = self.slack * S::UNLISTED;
                out.iter_mut().for_each(|x| *x = S::above_underflow(S::add(*x, slack).min(1.0)));
            } else if let Some(run) = sources.rows.first() {
                out.copy_from_slice(&values[run.first * inner..(run.first + 1) * inner]);
            } else {
                out.fill(S::above_underflow(0.0));
            }
        });
        arrays.keep(pairs);
        share.complete(&mut out);
        out
    }

    /// Writes `pairs[c + 1] = opt(V(c), V(c + 1))` for `c = −1 … cells − 1`, with failure outside, in some of the outer blocks.
    fn pairs<S: Side>(&self, values: &[f64], inner: usize, pairs: &mut [f64], blocks: Range<usize>) {
        let Axis { cells, periodic, .. } = self.axis;
        rows(pairs, inner, blocks.start * (cells + 1)..blocks.end * (cells + 1)).for_each(|(row, out)| {
            let (block, c) = (row / (cells + 1), row % (cells + 1));
            let cell = |c: usize| &values[(block * cells + c) * inner..(block * cells + c + 1) * inner];
            let (below, above) = match (periodic, c) {
                (true, c) => (cell((c + cells - 1) % cells), cell(c % cells)),
                (false, 0) => return edge::<S>(cell(0), out),
                (false, c) if c == cells => return edge::<S>(cell(c - 1), out),
                (false, c) => (cell(c - 1), cell(c)),
            };
            out.iter_mut().zip(below.iter().zip(above)).for_each(|(out, (a, b))| *out = S::of(*a, *b));
        });
    }
}

impl Sources {
    fn cell(cell: Option<usize>) -> Self {
        Self { rows: Run::join(cell.map(|cell| (cell, 1.0))), pairs: vec![], terms: 0 }
    }

    fn new(axis: &Axis, weights: &[Weights], sub_cell: i64) -> Self {
        let (r, n) = (axis.resolution as i64, axis.cells as i64);
        let (q, place) = (sub_cell.div_euclid(r), sub_cell.rem_euclid(r) as usize);
        let Weights { single, pair } = &weights[place];
        let position = |offset: i64| if axis.periodic { (q + offset).rem_euclid(n) } else { q + offset };
        let of = |weights: &[(i64, f64)], range: Range<i64>| {
            let places = weights.iter().map(|&(offset, mass)| (position(offset), mass));
            let inside = places.filter(|(place, _)| range.contains(place));
            let mut rows: Vec<_> =
                inside.map(|(place, mass)| ((place - range.start) as usize, mass)).collect();
            rows.sort_by_key(|&(row, _)| row);
            Run::join(rows)
        };
        let (rows, pairs) = (of(single, 0..n), of(pair, -1..n));
        Self { rows, pairs, terms: single.len() + pair.len() }
    }

    fn sum<S: Side>(&self, (values, pairs): (&[f64], &[f64]), inner: usize, out: &mut [f64]) {
        let outward = S::outward(self.terms);
        for (block, out) in out.chunks_mut(BLOCK).enumerate() {
            let start = block * BLOCK;
            self.rows.iter().for_each(|run| run.add_to(out, values, inner, start));
            self.pairs.iter().for_each(|run| run.add_to(out, pairs, inner, start));
            out.iter_mut().for_each(|x| *x *= outward);
        }
    }
}

/// Some of the rows of an array with their numbers, in parallel.
fn rows(
    array: &mut [f64],
    inner: usize,
    which: Range<usize>,
) -> impl IndexedParallelIterator<Item = (usize, &mut [f64])> {
    let rows = array[which.start * inner..which.end * inner].par_chunks_mut(inner);
    rows.enumerate().map(move |(i, row)| (which.start + i, row)).with_min_len((8 * BLOCK / inner).max(1))
}

fn edge<S: Side>(cell: &[f64], out: &mut [f64]) {
    out.iter_mut().zip(cell).for_each(|(out, value)| *out = S::of(*value, 0.0));
}
