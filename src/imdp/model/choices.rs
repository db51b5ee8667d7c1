//! Which rows a policy may choose from, state by state.

use super::{RowId, StateId, StateSet};
use std::sync::Arc;

/// The rows `first ..= last`, one choice each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RowRange {
    /// The first row.
    pub first: RowId,
    /// The last row.
    pub last: RowId,
}

impl RowRange {
    /// The number of rows in the range, at least 1.
    pub fn len(self) -> usize {
        self.last.index() - self.first.index() + 1
    }

    /// Never: a range holds at least one row.
    pub fn is_empty(self) -> bool {
        false
    }

    /// The row ids, ascending.
    pub fn rows(self) -> impl Iterator<Item = RowId> + Clone {
        (self.first.0..=self.last.0).map(RowId)
    }
}

/// The choices of every state, as ranges of row ids.
///
/// A state is *absorbing* if its only choice is to stay with probability 1; such self-loops have no row.
/// A state with neither is a *deadlock*: like PRISM, everything here treats it as absorbing, but it has no
/// choice that would be written to a file.
///
/// Copies share the ranges.
#[derive(Clone, Debug, PartialEq)]
pub struct Choices {
    /// Where the ranges of each state start; one more entry than states.
    starts: Arc<[usize]>,
    ranges: Arc<Vec<RowRange>>,
    absorbing: StateSet,
    num_choices: u64,
}

/// Builds [`Choices`] state by state.
#[derive(Debug)]
pub struct ChoicesBuilder {
    starts: Vec<usize>,
    ranges: Vec<RowRange>,
    absorbing: StateSet,
    num_choices: u64,
}

impl Choices {
    /// The choices of states whose ranges stand one after the other, ascending and with a gap between those of one state; per
    /// state how many are its own, none if its only choice is to stay.
    pub fn of_ranges(ranges: Vec<RowRange>, per_state: impl ExactSizeIterator<Item = Option<u32>>) -> Self {
        let mut starts = Vec::with_capacity(per_state.len() + 1);
        let mut absorbing = StateSet::with_capacity(per_state.len());
        let mut end = 0;
        starts.push(end);
        for (state, own) in per_state.enumerate() {
            absorbing.set(state, own.is_none());
            end += own.unwrap_or(0) as usize;
            starts.push(end);
        }
        let of_ranges: u64 = ranges.iter().map(|range| range.len() as u64).sum();
        let num_choices = of_ranges + absorbing.count_ones(..) as u64;
        Self { starts: starts.into(), ranges: Arc::new(ranges), absorbing, num_choices }
    }

    /// The number of states.
    pub fn num_states(&self) -> usize {
        self.starts.len() - 1
    }

    /// The number of choices of all states, self-loops included.
    pub fn num_choices(&self) -> u64 {
        self.num_choices
    }

    /// The ranges of one state; empty for absorbing states and deadlocks.
    pub fn ranges(&self, state: StateId) -> &[RowRange] {
        &self.ranges[self.starts[state.index()]..self.starts[state.index() + 1]]
    }

    /// The number of ranges of all states.
    pub fn num_ranges(&self) -> usize {
        self.ranges.len()
    }

    /// The row ids of one state, in the order of its choices.
    pub fn rows(&self, state: StateId) -> impl Iterator<Item = RowId> + '_ {
        self.ranges(state).iter().flat_map(|range| range.rows())
    }

    /// The row of a state's choice, counted in its own choices from 0.
    pub fn row_of_choice(&self, state: StateId, choice: u32) -> Option<RowId> {
        let mut left = choice as usize;
        for range in self.ranges(state) {
            if left < range.len() {
                return Some(RowId(range.first.0 + left as u32));
            }
            left -= range.len();
        }
        None
    }

    /// The rows, of `rows` in all, that some of the states can choose; ascending.
    pub fn used_rows(&self, rows: usize, states: impl Iterator<Item = StateId>) -> Vec<RowId> {
        // Ranges overlap heavily: a difference array, not a loop over choices.
        let mut depth = vec![0i64; rows + 1];
        for range in states.flat_map(|s| self.ranges(s)) {
            depth[range.first.index()] += 1;
            depth[range.last.index() + 1] -= 1;
        }
        let mut open = 0;
        let used = |row: &RowId| {
            open += depth[row.index()];
            open > 0
        };
        RowId::first(rows).filter(used).collect()
    }

    /// The number of choices of a state: 1 if it is absorbing, 0 if it is a deadlock.
    pub fn num_choices_of(&self, state: StateId) -> usize {
        let of_ranges: usize = self.ranges(state).iter().map(|range| range.len()).sum();
        of_ranges + usize::from(self.is_absorbing(state))
    }

    /// By state, the number of choices of the states before it.
    pub fn first_choices(&self) -> Vec<u64> {
        let mut total = 0;
        let of_state = |state| {
            let first = total;
            total += self.num_choices_of(state) as u64;
            first
        };
        StateId::first(self.num_states()).map(of_state).collect()
    }

    /// Whether the only choice of a state is to stay.
    pub fn is_absorbing(&self, state: StateId) -> bool {
        self.absorbing.contains(state.index())
    }

    /// Whether a state has no choice at all.
    pub fn is_deadlock(&self, state: StateId) -> bool {
        self.ranges(state).is_empty() && !self.is_absorbing(state)
    }

    /// The absorbing states.
    pub fn absorbing(&self) -> &StateSet {
        &self.absorbing
    }
}

impl ChoicesBuilder {
    /// No states yet, with room for `states`.
    pub fn with_capacity(states: usize) -> Self {
        let mut starts = Vec::with_capacity(states + 1);
        starts.push(0);
        Self { starts, ranges: vec![], absorbing: StateSet::with_capacity(states), num_choices: 0 }
    }

    /// Adds the rows `first ..= last` to the state under construction, merged with what they continue.
    pub fn push_range(&mut self, range: RowRange) {
        self.num_choices += range.len() as u64;
        let start = self.starts.last().copied().unwrap_or_default();
        if let Some(previous) = self.ranges[start..].last_mut()
            && previous.last.index() + 1 == range.first.index()
        {
            previous.last = range.last;
        } else {
            self.ranges.push(range);
        }
    }

    /// Ends the state under construction.
    pub fn finish_state(&mut self) {
        self.starts.push(self.ranges.len());
    }

    /// Adds a state whose only choice is to stay.
    pub fn push_absorbing(&mut self) {
        self.absorbing.grow_and_insert(self.starts.len() - 1);
        self.num_choices += 1;
        self.finish_state();
    }

    /// The choices of all states added.
    pub fn finish(mut self) -> Choices {
        self.absorbing.grow(self.starts.len() - 1);
        self.ranges.shrink_to_fit();
        Choices {
            starts: self.starts.into(),
            ranges: Arc::new(self.ranges),
            absorbing: self.absorbing,
            num_choices: self.num_choices,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_merge_within_a_state_only() {
        let mut builder = ChoicesBuilder::with_capacity(3);
        builder.push_range(RowRange { first: RowId(0), last: RowId(2) });
        builder.push_range(RowRange { first: RowId(3), last: RowId(3) });
        builder.push_range(RowRange { first: RowId(5), last: RowId(6) });
        builder.finish_state();
        builder.push_absorbing();
        builder.push_range(RowRange { first: RowId(7), last: RowId(7) });
        builder.finish_state();
        builder.finish_state();
        let choices = builder.finish();
        assert_eq!(choices.num_states(), 4);
        assert_eq!(choices.num_choices(), 8);
        assert_eq!(
            choices.ranges(StateId(0)),
            [RowRange { first: RowId(0), last: RowId(3) }, RowRange { first: RowId(5), last: RowId(6) }]
        );
        assert!(choices.is_absorbing(StateId(1)) && !choices.is_deadlock(StateId(1)));
        assert_eq!(choices.rows(StateId(2)).collect::<Vec<_>>(), [RowId(7)]);
        assert!(choices.is_deadlock(StateId(3)));
    }
}
