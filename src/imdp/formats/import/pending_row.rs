//! The row of the choice that is being read.

use super::bounds::{self, Judgement, NoDistribution};
use super::interval::Interval;
use crate::model::{End, Rows, StateId};
use crate::numeric::Exact;

#[derive(Clone, Copy, Debug)]
struct Entry {
    successor: StateId,
    /// Which transition of the choice it is; orders equal successors.
    nth: u32,
    lower: f64,
    upper: f64,
}

/// Collects the transitions of one choice, in any order.
#[derive(Debug, Default)]
pub(crate) struct PendingRow {
    entries: Vec<Entry>,
    ascending: bool,
    /// Whether all bounds are the shortest decimals of their doubles.
    shortest: bool,
    lower_sum: f64,
    upper_sum: f64,
}

impl PendingRow {
    /// Forgets the transitions.
    pub(crate) fn clear(&mut self) {
        self.entries.clear();
        (self.ascending, self.shortest, self.lower_sum, self.upper_sum) = (true, true, 0.0, 0.0);
    }

    /// Whether there is no transition.
    pub(crate) fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Adds a transition.
    #[inline]
    pub(crate) fn push(&mut self, successor: StateId, interval: Interval) {
        let Interval { lower, upper, shortest } = interval;
        self.shortest &= shortest;
        self.ascending &= self.entries.last().is_none_or(|last| last.successor < successor);
        self.entries.push(Entry { successor, nth: self.entries.len() as u32, lower, upper });
        self.lower_sum += lower;
        self.upper_sum += upper;
    }

    /// Whether the sums are far enough from 1 to judge them without looking at what was written.
    #[inline]
    pub(crate) fn is_clear(&self) -> bool {
        bounds::is_clear(self.entries.len(), self.lower_sum, self.upper_sum)
    }

    /// The bounds in their original order.
    pub(crate) fn bounds(&self) -> Vec<(f64, f64)> {
        let mut entries: Vec<_> =
            self.entries.iter().map(|entry| (entry.nth, entry.lower, entry.upper)).collect();
        entries.sort_unstable_by_key(|entry| entry.0);
        entries.into_iter().map(|(_, lower, upper)| (lower, upper)).collect()
    }

    /// Checks the transitions together and appends them to `rows`.
    ///
    /// `written` gives the texts of the bounds; they decide unless the sums are clear, and bounds that are not the
    /// shortest decimals of their doubles are what they say.
    pub(crate) fn finish<'t, I: Iterator<Item = (&'t [u8], &'t [u8])>>(
        &mut self,
        written: impl Fn() -> I,
        rows: &mut Rows,
    ) -> Result<Judgement, RowFault> {
        if !self.ascending {
            self.sort()?;
        }
        let mut judgement = Judgement::FINE;
        if !self.is_clear() {
            let bounds = self.entries.iter_mut().map(|entry| (&mut entry.lower, &mut entry.upper));
            judgement = bounds::judge(&written, bounds).map_err(RowFault::NoDistribution)?;
        }
        // A row is read once, so this is no loss where all is shortest.
        let texts: Vec<_> = if self.shortest { vec![] } else { written().collect() };
        for entry in &self.entries {
            rows.push_entry(entry.successor, entry.lower, entry.upper);
            if let Some(&(lower, upper)) = texts.get(entry.nth as usize) {
                let bounds = [(End::Lower, lower, entry.lower), (End::Upper, upper, entry.upper)];
                for (end, text, nearest) in bounds.into_iter().filter(|bound| !judgement.changed(bound.0)) {
                    Exact::of(text, nearest).into_iter().for_each(|exact| rows.set_exact(end, exact));
                }
            }
        }
        rows.finish_row();
        Ok(judgement)
    }

    fn sort(&mut self) -> Result<(), RowFault> {
        self.entries.sort_unstable_by_key(|entry| (entry.successor, entry.nth));
        let twice = self.entries.windows(2).filter(|pair| pair[0].successor == pair[1].successor);
        let second = twice.map(|pair| pair[1]).min_by_key(|entry| entry.nth);
        match second {
            Some(Entry { successor, nth, .. }) => Err(RowFault::Twice { successor, nth }),
            None => Ok(()),
        }
    }
}

/// What makes transitions not a row.
#[derive(Debug)]
pub(crate) enum RowFault {
    /// A destination is listed a second time.
    Twice {
        /// The destination.
        successor: StateId,
        /// Which transition of the choice it is, from 0.
        nth: u32,
    },
    /// No distribution fits the bounds.
    NoDistribution(NoDistribution),
}

impl RowFault {
    /// What was expected instead of [`Twice`](Self::Twice).
    pub(crate) const ONCE: &'static str = "every destination of a choice once";
}
