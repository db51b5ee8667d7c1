//! Rows that may be the best of some state: no others need to be evaluated.
//!
//! A policy maximises, and values only grow from step to step but for rounding. Let `W` be what a row was worth when it was
//! evaluated last, `g_i` the largest growth of a value among its successors in step `i`: a row is worth a mean of its
//! successors' values, so now at most `W + Σ g_i`. Every state is worth what its best row is, at least as much as before,
//! less what rounding took. A row that stays below that in all states that can choose it is the best of none, whatever it
//! is worth exactly; and one with `Σ g_i = 0` is worth what it was. In either case the optimum over its states stays the
//! same if it keeps `W`.
//!
//! **Rounding.** Values are at most 1, so an evaluation is off by less than `μ/2` ([`super::expectation`]), on either side of
//! the comparison.

use super::range_optimum::RangeOptimum;
use crate::model::{IntervalMdp, RowId, StateId};
use crate::numeric::rounding_factor;

/// Entries per row and range from which on it pays to ask.
const WORTHWHILE: usize = 16;

/// What is known about rows that were not evaluated again.
#[derive(Clone, Debug)]
pub(super) struct Contenders {
    /// By row, how much its successors can have grown since it was evaluated.
    growth: Vec<f64>,
    /// The values of the last step.
    before: Vec<f64>,
    wanted: Vec<bool>,
    /// `μ` above.
    margin: f64,
}

/// What is known of the successors of stored rows is how much all values grow: while that is more than this in a step, it is more than
/// rows of a state differ by.
pub(super) const LITTLE_GROWTH: f64 = 1e-3;

impl Contenders {
    /// Whether asking takes less time than evaluating.
    pub(super) fn pay(model: &IntervalMdp) -> bool {
        let rows = model.rows();
        rows.num_entries() >= WORTHWHILE * (rows.len() + model.choices().num_ranges())
    }

    /// All rows have been evaluated at these values, or are about to be: unless they are [looked](Self::look) at, all are wanted.
    pub(super) fn new(model: &IntervalMdp, values: &[f64]) -> Self {
        let rows = model.rows();
        Self {
            growth: vec![0.0; rows.len()],
            before: values.to_vec(),
            wanted: vec![true; rows.len()],
            margin: 4.0 * rounding_factor(3 * rows.longest() + 16),
        }
    }

    /// Looks for the rows that may be the best of one of the `states` at these values; `table` holds what rows were worth.
    pub(super) fn look(
        &mut self,
        model: &IntervalMdp,
        states: &[StateId],
        values: &[f64],
        table: &mut RangeOptimum,
    ) {
        let grown = |(new, old): (&f64, &f64)| if new > old { (new - old).next_up() } else { 0.0 };
        let of_states: Vec<f64> = values.iter().zip(&self.before).map(grown).collect();
        let lost = |(new, old): (&f64, &f64)| if new < old { (old - new).next_up() } else { 0.0 };
        let lost = values.iter().zip(&self.before).map(lost).fold(0.0, f64::max);
        self.before.copy_from_slice(values);
        let of_successors = model.rows().most_of_successors(&of_states);
        let ranges = states.iter().map(|&s| (model.choices().ranges(s), values[s.index()]));
        let least = table.least_around(ranges);
        let worth = table.values();
        for (row, growth) in self.growth.iter_mut().enumerate() {
            if of_successors[row] > 0.0 {
                *growth = (*growth + of_successors[row]).next_up();
            }
            self.wanted[row] = *growth > 0.0 && worth[row] + *growth + self.margin >= least[row] - lost;
            if self.wanted[row] {
                *growth = 0.0;
            }
        }
    }

    /// Whether a row is to be evaluated.
    pub(super) fn wants(&self, row: RowId) -> bool {
        self.wanted[row.index()]
    }
}
