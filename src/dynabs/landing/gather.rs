//! Extrema over ranges along one axis of an array.

use super::arrays::Arrays;
use super::side::Side;
use imdp::ranks::Share;
use rayon::prelude::*;

/// How many numbers of a row are compared at a time: they stay in the first-level cache.
const BLOCK: usize = 1024;

/// Rows that are shorter are not worth to be compared one by one.
const SHORT: usize = 64;

/// How many numbers one task writes, at least.
const LEAST: usize = 1 << 13;

/// Turns `outer × len × inner` numbers into `outer × ranges × inner`: the extrema over ranges of the middle axis.
#[derive(Clone, Debug)]
pub(crate) struct Gather {
    len: usize,
    inner: usize,
    periodic: bool,
    /// Where ranges begin and how long they are; beyond the end of a periodic axis they go on at its beginning.
    ranges: Vec<(u32, u32)>,
    /// By power of two: the ranges that are at least as long and less than twice as long.
    by_level: Vec<Vec<u32>>,
}

impl Gather {
    /// Ranges of axis `j` of an array of some shape, none of them empty.
    pub(crate) fn new(j: usize, shape: &[usize], periodic: bool, ranges: Vec<(u32, u32)>) -> Self {
        let mut by_level: Vec<Vec<u32>> = vec![];
        for (index, (_, size)) in (0..).zip(&ranges) {
            let level = size.max(&1).ilog2() as usize;
            by_level.resize(by_level.len().max(level + 1), vec![]);
            by_level[level].push(index);
        }
        Self { len: shape[j], inner: shape[j + 1..].iter().product(), periodic, ranges, by_level }
    }

    /// The extrema.
    pub(crate) fn apply<S: Side>(&self, values: &[f64], arrays: &Arrays) -> Vec<f64> {
        let Self { len, inner, .. } = *self;
        let count = self.ranges.len();
        let mut out = arrays.take(values.len() / len * count);
        if inner >= SHORT {
            let share = Share::new(out.len() / inner, out.len());
            let own = share.own();
            let rows = out[own.start * inner..own.end * inner].par_chunks_mut(inner);
            rows.enumerate().with_min_len((LEAST / inner).max(1)).for_each(|(i, out)| {
                let row = own.start + i;
                let block = &values[row / count * len * inner..(row / count + 1) * len * inner];
                self.compare::<S>(block, self.ranges[row % count], out);
            });
            share.complete(&mut out);
        } else if count > 0 {
            let (from, to) = (len * inner, count * inner);
            let share = Share::new(values.len() / from, out.len());
            let own = share.own();
            let blocks = out[own.start * to..own.end * to].par_chunks_mut(to);
            blocks
                .zip(values[own.start * from..own.end * from].par_chunks(from))
                .with_min_len((LEAST / to).max(1))
                .for_each_init(Vec::new, |level, (out, values)| self.double::<S>(values, level, out));
            share.complete(&mut out);
        }
        out
    }

    /// The extremum over one range, row by row.
    fn compare<S: Side>(&self, values: &[f64], (first, size): (u32, u32), out: &mut [f64]) {
        let row = |k: u32| {
            let row = (first + k) as usize % self.len;
            &values[row * self.inner..(row + 1) * self.inner]
        };
        for (block, out) in out.chunks_mut(BLOCK).enumerate() {
            let columns = block * BLOCK..block * BLOCK + out.len();
            out.copy_from_slice(&row(0)[columns.clone()]);
            for k in 1..size {
                out.iter_mut().zip(&row(k)[columns.clone()]).for_each(|(out, v)| *out = S::of(*out, *v));
            }
        }
    }

    /// The extrema over all ranges, from those over ranges of `1, 2, 4, …` rows, of which two make any length between.
    fn double<S: Side>(&self, values: &[f64], level: &mut Vec<f64>, out: &mut [f64]) {
        let inner = self.inner;
        level.clear();
        level.extend_from_slice(values);
        if self.periodic {
            level.extend_from_slice(values);
        }
        let all = level.len();
        for (power, ranges) in self.by_level.iter().enumerate() {
            if power > 0 {
                let shift = inner << (power - 1);
                for i in 0..all.saturating_sub(shift) {
                    level[i] = S::of(level[i], level[i + shift]);
                }
            }
            for &range in ranges {
                let (first, size) = self.ranges[range as usize];
                let (a, b) = (first as usize * inner, (first + size - (1 << power)) as usize * inner);
                let out = &mut out[range as usize * inner..(range as usize + 1) * inner];
                let pairs = level[a..a + inner].iter().zip(&level[b..b + inner]);
                out.iter_mut().zip(pairs).for_each(|(out, (a, b))| *out = S::of(*a, *b));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::side::{Lower, Upper};
    use super::*;

    /// Against the definition, with short rows and long ones, periodic axes and not.
    #[test]
    fn ranges_are_searched_through() {
        for (shape, periodic) in
            [([3, 7, 1], false), ([2, 9, 5], true), ([1, 6, 1100], false), ([2, 5, 70], true)]
        {
            let [outer, len, inner] = shape;
            let numbers = outer * len * inner;
            let values: Vec<f64> = (0..numbers).map(|i| ((i * 83 + i * i * 31) % 211) as f64).collect();
            let fits = |&(first, size): &(usize, usize)| periodic || first + size <= len;
            let all = (0..len).flat_map(|first| (1..=len).map(move |size| (first, size)));
            let ranges: Vec<(usize, usize)> = all.filter(fits).collect();
            let short = ranges.iter().map(|&(first, size)| (first as u32, size as u32)).collect();
            let gather = Gather::new(1, &shape, periodic, short);
            let arrays = Arrays::default();
            let (least, most) =
                (gather.apply::<Lower>(&values, &arrays), gather.apply::<Upper>(&values, &arrays));
            for (o, (r, &(first, size)), i) in (0..outer)
                .flat_map(|o| ranges.iter().enumerate().map(move |r| (o, r)))
                .flat_map(|(o, r)| (0..inner).map(move |i| (o, r, i)))
            {
                let seen = (first..first + size).map(|k| values[(o * len + k % len) * inner + i]);
                let at = (o * ranges.len() + r) * inner + i;
                assert_eq!(least[at], seen.clone().fold(f64::INFINITY, f64::min));
                assert_eq!(most[at], seen.fold(0.0, f64::max));
            }
        }
    }
}
