//! Finding the row that was read before.

use hashbrown::HashTable;

use crate::model::{Row, RowId, Rows};

/// The rows of a model by content.
///
/// A slot is a hash and a row id, 9 bytes; the content stays in [`Rows`] and decides in the end.
#[derive(Debug, Default)]
pub(crate) struct RowTable {
    slots: HashTable<(u32, RowId)>,
}

impl RowTable {
    /// The row with this content, if there is one.
    pub(super) fn find(&self, hash: u32, row: Row<'_>, rows: &Rows) -> Option<RowId> {
        let found = self.slots.find(spread(hash), |&(h, id)| h == hash && rows.row(id) == row);
        found.map(|&(_, id)| id)
    }

    /// Notes a row that was not found.
    pub(super) fn insert(&mut self, hash: u32, id: RowId) {
        self.slots.insert_unique(spread(hash), (hash, id), |&(hash, _)| spread(hash));
    }
}

/// The table wants good bits at both ends of a word.
fn spread(hash: u32) -> u64 {
    u64::from(hash).wrapping_mul(MULTIPLIER)
}

const MULTIPLIER: u64 = 0x9e37_79b9_7f4a_7c15;

/// A hash of the content of a row.
pub(crate) fn hash_row(row: Row<'_>) -> u32 {
    let mut hash = row.len() as u64;
    for ((&successor, lower), upper) in row.successors.iter().zip(row.lower).zip(row.upper) {
        let word = lower.to_bits().rotate_left(23) ^ upper.to_bits().wrapping_mul(MULTIPLIER);
        hash = (hash.rotate_left(5) ^ word ^ u64::from(successor)).wrapping_mul(MULTIPLIER);
    }
    ((hash ^ (hash >> 29)).wrapping_mul(MULTIPLIER) >> 32) as u32
}
