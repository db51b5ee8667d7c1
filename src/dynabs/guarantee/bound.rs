//! The number of a claim.

use imdp::numeric::{round_decimal_down, shortest_decimal};
use serde::Serialize;

/// A lower bound on the probability of success.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Bound {
    /// The state it is asked for; without one it is the least of all cells that are not unsafe.
    pub initial_state: Option<Vec<f64>>,
    /// The bound.
    pub bound: f64,
}

/// A lower bound with six digits, rounded down.
pub fn lower_bound_text(bound: f64) -> String {
    shortest_decimal(round_decimal_down(bound, 6))
}
