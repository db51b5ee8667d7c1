//! What the solver answers.

use super::{Policy, Status};
use crate::certificate::Evidence;
use crate::numeric::{one_minus_down, one_minus_up};

/// The answer to a query.
#[derive(Clone, Debug, PartialEq)]
pub struct Solution {
    /// Bounds on the value of every state.
    pub values: ValueBounds,
    /// How the computation ended.
    pub status: Status,
    /// The number of iterations, or of steps taken until nothing changed any more.
    pub iterations: u64,
    /// What the policy does, if that was asked.
    pub policy: Option<Policy>,
    /// Of bounded queries, as far as asked for: the bounds that the policy guarantees, lower ones if it maximises and upper
    /// ones if it minimises, with one step less, with two steps less, and so on.
    pub history: Vec<Vec<f64>>,
    /// What proves the values, if that was asked.
    pub evidence: Option<Evidence>,
}

/// Bounds on the exact value of every state: `0 ≤ lower ≤ value ≤ upper ≤ 1`.
#[derive(Clone, Debug, PartialEq)]
pub struct ValueBounds {
    /// The lower bounds, by state.
    pub lower: Vec<f64>,
    /// The upper bounds, by state.
    pub upper: Vec<f64>,
}

impl ValueBounds {
    /// Bounds on `1 − value`, rounded outwards.
    ///
    /// `G φ` has the value `1 − F ¬φ` with the resolutions of both players flipped.
    pub fn complement(&self) -> Self {
        Self {
            lower: self.upper.iter().map(|&x| one_minus_down(x)).collect(),
            upper: self.lower.iter().map(|&x| one_minus_up(x)).collect(),
        }
    }

    /// The largest `upper − lower`.
    pub fn gap(&self) -> f64 {
        self.lower.iter().zip(&self.upper).map(|(l, u)| u - l).fold(0.0, f64::max)
    }
}
