//! The distinct rows that some state uses.

use crate::model::{End, IntervalMdp, Row, RowBuffer, RowId, StateId};
use sha2::{Digest, Sha256};
use std::collections::HashMap;

/// The distinct rows that some state uses, in the order of their first use.
///
/// Unlike a model's own rows these do not depend on how it was stored: readers of explicit files merge
/// equal rows and never see unused ones.
pub(super) struct UsedRows {
    /// One row of the model for each.
    pub rows: Vec<RowId>,
    /// The state and the index of the choice in which each is used first.
    pub first_use: Vec<(StateId, u32)>,
    /// For every row of the model, which of these it is; `u32::MAX` if it is not used.
    pub index: Vec<u32>,
}

impl UsedRows {
    pub(super) fn new(model: &IntervalMdp) -> Self {
        let mut used = Self { rows: vec![], first_use: vec![], index: vec![u32::MAX; model.rows().len()] };
        let mut known: HashMap<[u8; 32], u32> = HashMap::new();
        let mut buffer = RowBuffer::default();
        for state in StateId::first(model.num_states()) {
            for (choice, row) in (0..).zip(model.choices().rows(state)) {
                if used.index[row.index()] != u32::MAX {
                    continue;
                }
                let content = content(model.rows().row(row, &mut buffer));
                used.index[row.index()] = *known.entry(content).or_insert_with(|| {
                    used.rows.push(row);
                    used.first_use.push((state, choice));
                    used.rows.len() as u32 - 1
                });
            }
        }
        used
    }

    /// The number of entries of these rows.
    pub(super) fn entries(&self, model: &IntervalMdp) -> u64 {
        self.rows.iter().map(|&row| model.rows().row_len(row) as u64).sum()
    }
}

fn content(row: Row<'_>) -> [u8; 32] {
    let mut hash = Sha256::new();
    for ((successor, lower), upper) in row.successors.iter().zip(row.lower).zip(row.upper) {
        hash.update(successor.0.to_le_bytes());
        hash.update(lower.to_le_bytes());
        hash.update(upper.to_le_bytes());
    }
    for bound in row.exact {
        hash.update([u8::from(bound.end == End::Upper)]);
        hash.update(bound.position.to_le_bytes());
        hash.update(bound.value.to_string());
    }
    hash.finalize().into()
}
