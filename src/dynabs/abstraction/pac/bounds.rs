//! Clopper–Pearson bounds for every count and level that occur, each computed once.

use super::super::landing::Count;
use crate::statistics::{lower_bound, upper_bound};
use imdp::numeric::{round_decimal_down, round_decimal_up};
use rayon::prelude::*;
use std::collections::{BTreeSet, HashMap};
use std::hash::Hash;

/// Written bounds have this many significant digits, rounded outwards: files stay short, and the loss is
/// far below what the statistics leave open.
pub(super) const DIGITS: usize = 10;

/// A lower and an upper bound for a probability.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Interval {
    pub(super) lower: f64,
    pub(super) upper: f64,
}

/// Intervals by count and by what decides about the levels.
pub(super) struct BoundTable<K> {
    intervals: HashMap<(Count, K), Interval>,
}

impl<K: Copy + Eq + Ord + Hash + Send + Sync> BoundTable<K> {
    /// Both bounds for all `events`, rounded outwards to short decimals; `levels` gives the lower bound's level and
    /// the upper's.
    pub(super) fn new(
        events: impl Iterator<Item = (Count, K)>,
        samples: u64,
        levels: impl Fn(K) -> (f64, f64) + Sync,
    ) -> Self {
        let events: Vec<_> = events.collect::<BTreeSet<_>>().into_iter().collect();
        let interval = |&(count, key): &(Count, K)| {
            let (of_lower, of_upper) = levels(key);
            let lower = lower_bound(count.certain.into(), samples, of_lower);
            let upper = upper_bound(count.possible.into(), samples, of_upper);
            let lower = round_decimal_down(lower, DIGITS);
            ((count, key), Interval { lower, upper: round_decimal_up(upper, DIGITS).min(1.0) })
        };
        Self { intervals: events.par_iter().map(interval).collect() }
    }

    /// The interval of an event that the table was made for.
    pub(super) fn get(&self, count: Count, key: K) -> Interval {
        match self.intervals.get(&(count, key)) {
            Some(&interval) => interval,
            None => unreachable!("{count:?} was not announced"),
        }
    }
}
