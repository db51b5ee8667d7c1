//! The row of the choice that is being read.

use super::bounds::{self, Judgement};
use super::error::Fault;
use super::text::describe;
use crate::imdp::{Rows, StateId};

#[derive(Clone, Copy, Debug)]
struct Entry {
    successor: StateId,
    /// Which line of the choice it is from; orders equal successors.
    nth: u32,
    lower: f64,
    upper: f64,
}

/// Collects the transitions of one choice, in any order.
#[derive(Debug, Default)]
pub(super) struct PendingRow {
    entries: Vec<Entry>,
    ascending: bool,
    lower_sum: f64,
    upper_sum: f64,
}

impl PendingRow {
    /// Forgets the transitions.
    pub fn clear(&mut self) {
        self.entries.clear();
        (self.ascending, self.lower_sum, self.upper_sum) = (true, 0.0, 0.0);
    }

    /// Whether there is no transition.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Adds a transition.
    #[inline]
    pub fn push(&mut self, successor: StateId, lower: f64, upper: f64) {
        self.ascending &= self.entries.last().is_none_or(|last| last.successor < successor);
        self.entries.push(Entry { successor, nth: self.entries.len() as u32, lower, upper });
        self.lower_sum += lower;
        self.upper_sum += upper;
    }

    /// Checks the transitions together and appends them to `rows`.
    ///
    /// `lines` is the text of the choice, which starts at line `first_line`; `field` says where in a line
    /// the bounds are.
    pub fn finish(
        &mut self,
        lines: &[u8],
        first_line: u64,
        field: usize,
        rows: &mut Rows,
    ) -> Result<Judgement, Box<Fault>> {
        if !self.ascending {
            self.sort(lines, first_line, field)?;
        }
        let mut judgement = Judgement::Fine;
        if !bounds::is_clear(self.entries.len(), self.lower_sum, self.upper_sum) {
            let bounds = self.entries.iter_mut().map(|entry| (&mut entry.lower, &mut entry.upper));
            judgement = bounds::judge(lines, field, bounds)
                .map_err(|error| Fault::new(first_line, 1, error.expected, error.sum))?;
        }
        for entry in &self.entries {
            rows.push_entry(entry.successor, entry.lower, entry.upper);
        }
        rows.finish_row();
        Ok(judgement)
    }

    fn sort(&mut self, lines: &[u8], first_line: u64, field: usize) -> Result<(), Box<Fault>> {
        self.entries.sort_unstable_by_key(|entry| (entry.successor, entry.nth));
        let twice = self.entries.windows(2).filter(|pair| pair[0].successor == pair[1].successor);
        let Some(nth) = twice.map(|pair| pair[1].nth).min() else {
            return Ok(());
        };
        let line = lines.split(|&byte| byte == b'\n').nth(nth as usize).unwrap_or_default();
        let column =
            line.split(|&byte| byte == b' ').take(field - 1).map(|text| text.len() + 1).sum::<usize>();
        let expected = "every destination of a choice once";
        Err(Fault::new(first_line + u64::from(nth), column + 1, expected, describe(&line[column..])))
    }
}
