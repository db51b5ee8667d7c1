//! How much memory a solution takes, known before it takes it.

use crate::model::{IntervalMdp, MemoryError, StateId, require_memory};

/// What is kept per state: bounds, results, a component's copies of them, choices, marks, what searches the graph.
const STATE_BYTES: u64 = 120;

/// What is kept per row besides its optima: its slack, marks, two nodes of a tree, what searches the graph.
const ROW_BYTES: u64 = 96;

/// Fails if a solution for `model` may not fit into memory, policies and certificates apart, which grow step by step.
///
/// # Errors
/// [`MemoryError`] with the estimate.
pub(super) fn require_working_memory(model: &IntervalMdp) -> Result<(), MemoryError> {
    let states = model.num_states();
    let ranges = StateId::first(states).flat_map(|state| model.choices().ranges(state));
    // Two tables of the optima of neighbouring rows, see `range_optimum`.
    let levels = u64::from(ranges.map(|range| range.len()).max().unwrap_or(1).ilog2()) + 1;
    let rows = model.rows();
    let bytes = STATE_BYTES * states as u64 + (ROW_BYTES + 16 * levels) * rows.len() as u64;
    require_memory("solving", bytes)
}
