//! The rows of a model: stored, or computed when they are needed.

use super::{Row, RowId, Rows, StateId};
use std::borrow::Cow;
use std::fmt::Debug;
use std::sync::Arc;

/// Rows that are computed when somebody needs them.
///
/// They are rows in the sense of [`Row::validate`], and their bounds are the shortest decimals of their doubles.
pub trait ComputedRows: Debug + Send + Sync {
    /// The number of rows.
    fn len(&self) -> usize;

    /// Whether there are no rows.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number of entries of all rows together.
    fn num_entries(&self) -> usize;

    /// The number of entries of a row.
    fn row_len(&self, id: RowId) -> usize;

    /// The row with this id, in the buffer as far as it is not at hand.
    fn row<'a>(&'a self, id: RowId, buffer: &'a mut RowBuffer) -> Row<'a>;

    /// Per row, at least the largest of these numbers `≥ 0` of states among its successors.
    fn most_of_successors(&self, of_states: &[f64]) -> Vec<f64>;
}

/// Where rows are computed: whatever it held before is lost.
#[derive(Clone, Debug, Default)]
pub struct RowBuffer {
    /// The entries of a row.
    pub entries: RowEntries,
    /// Room for whoever computes it.
    pub coordinates: Vec<i32>,
}

/// The entries of one row.
#[derive(Clone, Debug, Default)]
pub struct RowEntries {
    /// The successor states.
    pub successors: Vec<StateId>,
    /// The lower bounds.
    pub lower: Vec<f64>,
    /// The upper bounds.
    pub upper: Vec<f64>,
}

/// The interval distributions of a model.
#[derive(Clone, Debug)]
pub enum RowSet {
    /// One after the other in memory.
    Stored(Rows),
    /// One at a time, when it is asked for.
    Computed(Arc<dyn ComputedRows>),
}

impl RowSet {
    /// The number of rows.
    pub fn len(&self) -> usize {
        match self {
            Self::Stored(rows) => rows.len(),
            Self::Computed(rows) => rows.len(),
        }
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The number of entries of all rows together.
    pub fn num_entries(&self) -> usize {
        match self {
            Self::Stored(rows) => rows.num_entries(),
            Self::Computed(rows) => rows.num_entries(),
        }
    }

    /// How many entries are in memory.
    pub fn stored_entries(&self) -> usize {
        match self {
            Self::Stored(rows) => rows.num_entries(),
            Self::Computed(_) => 0,
        }
    }

    /// The number of entries of a row.
    pub fn row_len(&self, id: RowId) -> usize {
        match self {
            Self::Stored(rows) => rows.row_len(id),
            Self::Computed(rows) => rows.row_len(id),
        }
    }

    /// The number of entries of the longest row.
    pub fn longest(&self) -> usize {
        RowId::first(self.len()).map(|id| self.row_len(id)).max().unwrap_or(0)
    }

    /// The row with this id, in the buffer if it is computed.
    #[inline]
    pub fn row<'a>(&'a self, id: RowId, buffer: &'a mut RowBuffer) -> Row<'a> {
        match self {
            Self::Stored(rows) => rows.row(id),
            Self::Computed(rows) => rows.row(id, buffer),
        }
    }

    /// Per row, at least the largest of these numbers `≥ 0` of states among its successors; how much more depends on what is
    /// known without looking at rows.
    pub fn most_of_successors(&self, of_states: &[f64]) -> Vec<f64> {
        match self {
            Self::Stored(rows) => vec![of_states.iter().copied().fold(0.0, f64::max); rows.len()],
            Self::Computed(rows) => rows.most_of_successors(of_states),
        }
    }

    /// The rows with bounds that are not the shortest decimals of their doubles.
    pub fn inexact_rows(&self) -> impl Iterator<Item = RowId> + '_ {
        self.as_stored().into_iter().flat_map(Rows::inexact_rows)
    }

    /// Visits the rows by id until one fails.
    ///
    /// # Errors
    /// The first that `visit` returns.
    pub fn try_for_each<E>(&self, mut visit: impl FnMut(RowId, Row<'_>) -> Result<(), E>) -> Result<(), E> {
        let mut buffer = RowBuffer::default();
        RowId::first(self.len()).try_for_each(|id| visit(id, self.row(id, &mut buffer)))
    }

    /// Visits all rows by id.
    pub fn for_each(&self, mut visit: impl FnMut(RowId, Row<'_>)) {
        let mut buffer = RowBuffer::default();
        RowId::first(self.len()).for_each(|id| visit(id, self.row(id, &mut buffer)));
    }

    /// Whether some row `is_one`.
    pub fn any(&self, mut is_one: impl FnMut(Row<'_>) -> bool) -> bool {
        let mut buffer = RowBuffer::default();
        RowId::first(self.len()).any(|id| is_one(self.row(id, &mut buffer)))
    }

    /// The rows, if they are in memory.
    pub fn as_stored(&self) -> Option<&Rows> {
        match self {
            Self::Stored(rows) => Some(rows),
            Self::Computed(_) => None,
        }
    }

    /// All rows in memory.
    pub fn to_stored(&self) -> Cow<'_, Rows> {
        match self {
            Self::Stored(rows) => Cow::Borrowed(rows),
            Self::Computed(_) => {
                let mut rows = Rows::with_capacity(self.len(), self.num_entries());
                self.for_each(|_, row| {
                    rows.push_row(row);
                });
                Cow::Owned(rows)
            }
        }
    }
}

impl From<Rows> for RowSet {
    fn from(rows: Rows) -> Self {
        Self::Stored(rows)
    }
}

impl PartialEq for RowSet {
    fn eq(&self, other: &Self) -> bool {
        if let (Self::Stored(rows), Self::Stored(others)) = (self, other) {
            return rows == others;
        }
        let mut buffers = [RowBuffer::default(), RowBuffer::default()];
        let [buffer, other_buffer] = &mut buffers;
        let mut equal = |id| self.row(id, buffer) == other.row(id, other_buffer);
        self.len() == other.len() && RowId::first(self.len()).all(&mut equal)
    }
}
