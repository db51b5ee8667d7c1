//! Interval distributions, stored one after the other.

use super::exact_bounds::{End, ExactBound};
use super::{Row, RowId, StateId};
use crate::numeric::Exact;
use std::collections::BTreeMap;

/// Interval distributions over successor states, in compressed sparse row form.
#[derive(Clone, Debug, PartialEq)]
pub struct Rows {
    /// Where each row starts; one more entry than rows.
    starts: Vec<usize>,
    successors: Vec<StateId>,
    lower: Vec<f64>,
    upper: Vec<f64>,
    /// The bounds that are not the shortest decimals of their doubles: rare.
    exact: BTreeMap<RowId, Vec<ExactBound>>,
    /// Those of the row under construction.
    pending: Vec<ExactBound>,
}

impl Rows {
    /// No rows yet.
    pub fn new() -> Self {
        Self::with_capacity(0, 0)
    }

    /// No rows yet, with room for this many rows and entries.
    pub fn with_capacity(rows: usize, entries: usize) -> Self {
        let mut starts = Vec::with_capacity(rows + 1);
        starts.push(0);
        Self {
            starts,
            successors: Vec::with_capacity(entries),
            lower: Vec::with_capacity(entries),
            upper: Vec::with_capacity(entries),
            exact: BTreeMap::new(),
            pending: vec![],
        }
    }

    /// The rows of these lengths, their entries one after the other.
    ///
    /// `None` unless the lengths sum to the length of each column.
    pub fn from_columns(
        lengths: impl ExactSizeIterator<Item = u32>,
        successors: Vec<StateId>,
        lower: Vec<f64>,
        upper: Vec<f64>,
    ) -> Option<Self> {
        let mut starts = Vec::with_capacity(lengths.len() + 1);
        let mut end = 0usize;
        starts.push(end);
        for length in lengths {
            end = end.checked_add(length as usize)?;
            starts.push(end);
        }
        let consistent = [successors.len(), lower.len(), upper.len()] == [end; 3];
        consistent.then(|| Self { starts, successors, lower, upper, ..Self::new() })
    }

    /// Adds `lower ≤ p(successor) ≤ upper` to the row under construction.
    pub fn push_entry(&mut self, successor: StateId, lower: f64, upper: f64) {
        self.successors.push(successor);
        self.lower.push(lower);
        self.upper.push(upper);
    }

    /// Adds an entry with the bounds of another row's, to the last digit.
    pub fn push_entry_of(&mut self, successor: StateId, row: Row<'_>, position: usize) {
        self.push_entry(successor, row.lower[position], row.upper[position]);
        for end in [End::Lower, End::Upper] {
            if let Some(value) = row.exact_bound(end, position) {
                self.set_exact(end, value.clone());
            }
        }
    }

    /// Says what one of the bounds of the entry added last is exactly; its double is the nearest one.
    pub fn set_exact(&mut self, end: End, value: Exact) {
        let start = self.starts.last().copied().unwrap_or_default();
        if let Some(position) = (self.successors.len() - start).checked_sub(1) {
            self.pending.push(ExactBound { position: position as u32, end, value });
        }
    }

    /// Ends the row under construction and returns its id.
    pub fn finish_row(&mut self) -> RowId {
        self.starts.push(self.successors.len());
        let id = RowId::from_index(self.starts.len() - 2);
        if !self.pending.is_empty() {
            self.pending.shrink_to_fit();
            self.exact.insert(id, std::mem::take(&mut self.pending));
        }
        id
    }

    /// Adds a copy of a row and returns its id.
    pub fn push_row(&mut self, row: Row<'_>) -> RowId {
        self.successors.extend_from_slice(row.successors);
        self.lower.extend_from_slice(row.lower);
        self.upper.extend_from_slice(row.upper);
        self.pending.extend_from_slice(row.exact);
        self.finish_row()
    }

    /// Makes room for this many more entries, without room to spare.
    pub fn reserve_exact(&mut self, entries: usize) {
        self.successors.reserve_exact(entries);
        self.lower.reserve_exact(entries);
        self.upper.reserve_exact(entries);
    }

    /// Forgets all rows and keeps their room.
    pub fn clear(&mut self) {
        self.starts.truncate(1);
        self.successors.clear();
        self.lower.clear();
        self.upper.clear();
        self.exact.clear();
        self.pending.clear();
    }

    /// Gives back the room that is not used.
    pub fn shrink_to_fit(&mut self) {
        self.starts.shrink_to_fit();
        self.successors.shrink_to_fit();
        self.lower.shrink_to_fit();
        self.upper.shrink_to_fit();
    }

    /// Appends the rows of `other`, renumbered to follow these.
    pub fn append(&mut self, other: &Self) {
        let shift = self.successors.len();
        let first = self.len() as u32;
        self.exact.extend(other.exact.iter().map(|(id, bounds)| (RowId(first + id.0), bounds.clone())));
        self.starts.extend(other.starts[1..].iter().map(|start| start + shift));
        self.successors.extend_from_slice(&other.successors);
        self.lower.extend_from_slice(&other.lower);
        self.upper.extend_from_slice(&other.upper);
    }

    /// The number of rows.
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number of entries of all rows together.
    pub fn num_entries(&self) -> usize {
        self.successors.len()
    }

    /// The row with this id.
    pub fn row(&self, id: RowId) -> Row<'_> {
        let range = self.starts[id.index()]..self.starts[id.index() + 1];
        Row {
            successors: &self.successors[range.clone()],
            lower: &self.lower[range.clone()],
            upper: &self.upper[range],
            exact: self.exact.get(&id).map_or(&[], Vec::as_slice),
        }
    }

    /// The rows with bounds that are not the shortest decimals of their doubles.
    pub fn inexact_rows(&self) -> impl Iterator<Item = RowId> + '_ {
        self.exact.keys().copied()
    }

    /// The number of entries of a row.
    pub fn row_len(&self, id: RowId) -> usize {
        self.starts[id.index() + 1] - self.starts[id.index()]
    }

    /// All rows, by id.
    pub fn iter(&self) -> impl Iterator<Item = Row<'_>> {
        (0..self.len()).map(|id| self.row(RowId::from_index(id)))
    }
}

impl Default for Rows {
    fn default() -> Self {
        Self::new()
    }
}
