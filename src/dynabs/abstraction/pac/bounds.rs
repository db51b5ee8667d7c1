//! Clopper–Pearson bounds for every count and level that occur, each computed once.

use super::super::cell_counts::Count;
use super::super::windows::WINDOWS;
use super::levels::EventLevels;
use crate::statistics::{lower_bound, upper_bound};
use imdp::numeric::{round_decimal_down, round_decimal_up};
use rayon::prelude::*;
use std::collections::{BTreeSet, HashMap};
use std::hash::Hash;

/// Written bounds have this many significant digits, rounded outwards: files stay short, and the loss is
/// far below what the statistics leave open.
pub(in super::super) const DIGITS: usize = 10;

/// A lower and an upper bound for a probability.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    /// Per window that a row may be made with.
    pub(super) lower: [f64; WINDOWS],
    pub(super) upper: f64,
}

/// How many samples there are, and what lower bounds are about.
pub(super) struct SampleSize {
    /// All samples.
    pub(super) number: u64,
    /// If lower bounds are for the noise inside of windows: per window, the samples there, and how much of the noise is
    /// there at least.
    pub(super) inside: Option<Vec<(u64, f64)>>,
}

impl SampleSize {
    /// Both bounds, rounded outwards to short decimals.
    fn interval(&self, count: Count, levels: &EventLevels) -> Interval {
        let lower = match &self.inside {
            None => {
                let bound = lower_bound(count.certain[0].into(), self.number, levels.lower[0]);
                [round_decimal_down(bound, DIGITS); WINDOWS]
            }
            Some(inside) => std::array::from_fn(|window| {
                let Some(&(number, kept)) = inside.get(window) else { return 0.0 };
                let conditional = lower_bound(count.certain[window].into(), number, levels.lower[window]);
                round_decimal_down((kept * conditional).next_down().max(0.0), DIGITS)
            }),
        };
        let upper = upper_bound(count.possible.into(), self.number, levels.upper);
        Interval { lower, upper: round_decimal_up(upper, DIGITS).min(1.0) }
    }
}

/// Intervals by count and by what decides about the levels.
pub(super) struct BoundTable<K> {
    intervals: HashMap<(Count, K), Interval>,
}

impl<K: Copy + Eq + Ord + Hash + Send + Sync> BoundTable<K> {
    /// Both bounds for all `events`.
    pub(super) fn new(
        events: impl Iterator<Item = (Count, K)>,
        size: &SampleSize,
        levels: impl Fn(K) -> EventLevels + Sync,
    ) -> Self {
        let events: Vec<_> = events.collect::<BTreeSet<_>>().into_iter().collect();
        let interval = |&(count, key): &(Count, K)| ((count, key), size.interval(count, &levels(key)));
        Self { intervals: events.par_iter().map(interval).collect() }
    }

    /// All intervals, in no order.
    pub(super) fn intervals(&self) -> impl Iterator<Item = &Interval> {
        self.intervals.values()
    }

    /// The interval of an event that the table was made for.
    pub(super) fn get(&self, count: Count, key: K) -> Interval {
        match self.intervals.get(&(count, key)) {
            Some(&interval) => interval,
            None => unreachable!("{count:?} was not announced"),
        }
    }
}
