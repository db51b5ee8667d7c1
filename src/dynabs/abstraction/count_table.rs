//! One value for every count that occurs.

use rayon::prelude::*;
use std::collections::BTreeSet;

/// A function of sample counts, computed once for every count that occurs.
pub(super) struct CountTable<T> {
    values: Vec<Option<T>>,
}

impl<T: Copy + Send> CountTable<T> {
    /// Computes `value` for the counts, in parallel.
    pub(super) fn new(counts: impl Iterator<Item = u32>, value: impl Fn(u64) -> T + Sync) -> Self {
        let counts: Vec<u32> = counts.collect::<BTreeSet<_>>().into_iter().collect();
        let mut values = vec![None; counts.last().map_or(0, |&last| last as usize + 1)];
        let computed: Vec<T> = counts.par_iter().map(|&count| value(count.into())).collect();
        for (count, value) in counts.into_iter().zip(computed) {
            values[count as usize] = Some(value);
        }
        Self { values }
    }

    /// The value for a count that the table was made for.
    pub(super) fn get(&self, count: u32) -> T {
        match self.values.get(count as usize) {
            Some(Some(value)) => *value,
            _ => unreachable!("count {count} was not announced"),
        }
    }
}
