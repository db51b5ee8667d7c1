//! A [`Stencil`] applied to an array of landing values.

use super::masses::Masses;
use super::side::Side;
use super::stencil::{Band, Stencil, Tap};
use imdp::ranks::Share;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// The positions of one coordinate that an array has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Span {
    pub(super) first: i64,
    pub(super) len: usize,
    /// Whether the first position follows the last; otherwise what is beyond an end is like the end.
    pub(super) periodic: bool,
}

/// One noise between two arrays: from where it begins to where it leads.
#[derive(Clone, Debug)]
pub(super) struct Move {
    pub(super) taps: Vec<Tap>,
    masses: Masses,
    /// What is listed, by tap, as rows of the model: lower and upper bounds, and the mass of none.
    pub(super) elsewhere: f64,
    pub(super) uppers: Vec<f64>,
    band: Option<Band>,
    pub(super) from: Vec<Span>,
    pub(super) to: Vec<Span>,
}

impl Span {
    /// The index of a position.
    pub(super) fn index(self, position: i64) -> usize {
        let len = self.len as i64;
        if self.periodic {
            (position - self.first).rem_euclid(len) as usize
        } else {
            (position - self.first).clamp(0, len - 1) as usize
        }
    }

    /// The indices of `size` positions from `first` on: the first, and how many.
    pub(super) fn part(self, first: i64, size: u32) -> (usize, usize) {
        if self.periodic {
            if size as usize >= self.len { (0, self.len) } else { (self.index(first), size as usize) }
        } else {
            let start = self.index(first);
            (start, self.index(first + i64::from(size) - 1) - start + 1)
        }
    }
}

/// Positions farther away than this are as good as infinite.
const FAR: i64 = 1 << 40;

impl Move {
    /// The moves of `noise`, one after the other, from images at positions `images` to the sub-cells of the partition,
    /// `lengths` of them in every coordinate; with the positions of the arrays before and after them.
    ///
    /// Positions from which nothing that follows leads back to the partition are all alike, so arrays end there.
    pub(super) fn chain(
        noise: &[Stencil],
        lengths: &[usize],
        periodic: &[bool],
        images: &[(i64, i64)],
    ) -> Vec<Self> {
        let widest = |j: usize| {
            noise.iter().flat_map(|noise| &noise.taps).map(|tap| i64::from(tap.size[j])).max().unwrap_or(1)
        };
        let span = |after: usize, j: usize| {
            if periodic[j] {
                return Span { first: 0, len: lengths[j], periodic: true };
            }
            let add = |(a, b): (i64, i64), (c, d): (i64, i64)| (a + c, b + d);
            let extents = |noise: &[Stencil]| noise.iter().map(|n| n.extent(j)).fold((0, 0), add);
            let (done, to_come) = (extents(&noise[..after]), extents(&noise[after..]));
            let image = (images[j].0.clamp(-FAR, FAR), images[j].1.clamp(-FAR, FAR));
            // One box more below: a box that begins before the array then lies where all is alike.
            let (lowest, highest) = (-1 - to_come.1 - widest(j), lengths[j] as i64 - to_come.0);
            let first = (image.0 + done.0).clamp(lowest, highest);
            let last = (image.1 + done.1).clamp(first, highest);
            Span { first, len: (last - first) as usize + 1, periodic: false }
        };
        let spans = |after: usize| (0..lengths.len()).map(|j| span(after, j)).collect::<Vec<_>>();
        let one = |(index, noise): (usize, &Stencil)| {
            let lower: Vec<f64> = noise.taps.iter().map(|tap| tap.lower).collect();
            let uppers: Vec<f64> = noise.taps.iter().map(|tap| tap.upper).collect();
            Self {
                taps: noise.taps.clone(),
                masses: Masses::new(lower, &uppers, noise.elsewhere),
                elsewhere: noise.elsewhere,
                uppers,
                band: noise.band.clone(),
                from: spans(index),
                to: spans(index + 1),
            }
        };
        noise.iter().enumerate().map(one).collect()
    }

    /// Bytes of the arrays that [`apply`](Self::apply) has at the same time: what it is given, what it returns, and the extrema over
    /// boxes of every size, with two more while they are made.
    pub(super) fn bytes(&self) -> u64 {
        let numbers = |spans: &[Span]| spans.iter().fold(1u64, |n, span| n.saturating_mul(span.len as u64));
        let sizes: BTreeSet<&[u32]> = self.taps.iter().map(|tap| &tap.size[..]).collect();
        let after = numbers(&self.to).saturating_mul(sizes.len() as u64 + 3);
        after.saturating_add(numbers(&self.from)).saturating_mul(size_of::<f64>() as u64)
    }

    /// The values before the noise, for those after it.
    pub(super) fn apply<S: Side>(&self, after: &[f64]) -> Vec<f64> {
        let mut sizes: BTreeMap<&[u32], usize> = BTreeMap::new();
        let mut minima = vec![];
        let kinds: Vec<usize> = (self.taps.iter())
            .map(|tap| {
                *sizes.entry(&tap.size).or_insert_with(|| {
                    minima.push(over_boxes::<S>(after, &self.to, &tap.size));
                    minima.len() - 1
                })
            })
            .collect();
        let n = self.from.len();
        let line = self.from[n - 1].len;
        let mut out = vec![0.0; self.from.iter().map(|span| span.len).product()];
        let share = Share::new(out.len() / line, out.len());
        let own = share.own();
        let lines = out[own.start * line..own.end * line].par_chunks_mut(line).enumerate();
        lines.for_each_init(Scratch::default, |scratch, (index, out)| {
            let mut place = vec![0; n];
            let mut rest = own.start + index;
            for j in (0..n - 1).rev() {
                place[j] = self.from[j].first + (rest % self.from[j].len) as i64;
                rest /= self.from[j].len;
            }
            let sources = self.taps.iter().zip(&kinds).map(|(tap, &kind)| {
                let begin = (0..n - 1)
                    .fold(0, |at, j| at * self.to[j].len + self.to[j].index(place[j] + tap.first[j]))
                    * self.to[n - 1].len;
                (&minima[kind][begin..begin + self.to[n - 1].len], tap.first[n - 1])
            });
            self.line::<S>(sources, out, scratch);
        });
        share.complete(&mut out);
        out
    }

    /// The values of a line of places, from the line of boxes that each tap leads to and its shift.
    fn line<'a, S: Side>(
        &self,
        sources: impl Iterator<Item = (&'a [f64], i64)>,
        out: &mut [f64],
        scratch: &mut Scratch,
    ) {
        let (from, to) = (self.from[self.from.len() - 1], self.to[self.to.len() - 1]);
        let taps = self.taps.len();
        let unlisted = if self.band.is_some() { None } else { self.masses.unlisted() };
        scratch.values.resize(out.len() * taps, 0.0);
        for (tap, (source, shift)) in sources.enumerate() {
            let value = |x: usize| source[to.index(from.first + x as i64 + shift)];
            match unlisted {
                // Whatever the values, what the lower bounds leave is of no tap.
                Some(_) => {
                    let mass = self.masses.lower()[tap];
                    out.iter_mut().enumerate().for_each(|(x, out)| *out += mass * value(x));
                }
                None => (0..out.len()).for_each(|x| scratch.values[x * taps + tap] = value(x)),
            }
        }
        let outward = S::outward(2 * taps);
        for (x, out) in out.iter_mut().enumerate() {
            let values = &scratch.values[x * taps..(x + 1) * taps];
            *out = match (&self.band, unlisted) {
                (Some(band), _) => band.extremum::<S>(values),
                (None, Some(unlisted)) => S::add(*out * outward, unlisted * S::UNLISTED).min(1.0),
                (None, None) => self.masses.extremum::<S>(values, &mut scratch.pairs),
            };
            *out = S::above_underflow(*out);
        }
    }
}

#[derive(Default)]
struct Scratch {
    /// By place, then by tap.
    values: Vec<f64>,
    pairs: Vec<(f64, f64)>,
}

/// The extremum over the box of this size that begins at each position.
fn over_boxes<S: Side>(values: &[f64], spans: &[Span], size: &[u32]) -> Vec<f64> {
    let mut values = values.to_vec();
    let mut stride = values.len();
    for (span, &size) in spans.iter().zip(size) {
        stride /= span.len;
        let source = values.clone();
        // Farther is round again, or beyond the end, where all places are the last one.
        let last = (size as usize).min(span.len);
        for shift in 1..last {
            values.par_chunks_mut(stride).enumerate().for_each(|(row, out)| {
                let place = row % span.len;
                let other = span.index(span.first + (place + shift) as i64);
                let from = (row - place + other) * stride;
                out.iter_mut().zip(&source[from..from + stride]).for_each(|(a, b)| *a = S::of(*a, *b));
            });
        }
    }
    values
}
