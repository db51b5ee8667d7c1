//! Rows in which nature picks.

use imdp::model::{Rows, StateId};

/// A row in which nature picks any of some states.
pub(super) fn push_any(rows: &mut Rows, mut states: Vec<StateId>) {
    states.sort_unstable();
    states.dedup();
    let lower = if states.len() == 1 { 1.0 } else { 0.0 };
    states.iter().for_each(|&state| rows.push_entry(state, lower, 1.0));
    rows.finish_row();
}
