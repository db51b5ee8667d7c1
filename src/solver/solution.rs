//! What the solver answers.

use super::{Policy, Status};

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

/// The largest double that is at most `1 − x`, for `0 ≤ x ≤ 1`.
fn one_minus_down(x: f64) -> f64 {
    let difference = 1.0 - x;
    // Fast two-sum: with |1| ≥ |x| the second difference is the rounding error itself.
    if (1.0 - difference) - x < 0.0 { difference.next_down() } else { difference }
}

/// The smallest double that is at least `1 − x`, for `0 ≤ x ≤ 1`.
fn one_minus_up(x: f64) -> f64 {
    let difference = 1.0 - x;
    if (1.0 - difference) - x > 0.0 { difference.next_up() } else { difference }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numeric::{from_dyadic, to_f64_down, to_f64_up};

    #[test]
    fn complements_are_the_tightest_doubles() {
        for x in [0.0, 1.0, 0.5, 0.1, 0.3, 0.7, 1e-17, 1e-300, 5e-324, 1.0 - 1e-16, 1.0 / 3.0] {
            let exact = from_dyadic(1.0).unwrap() - from_dyadic(x).unwrap();
            assert_eq!(one_minus_down(x), to_f64_down(&exact), "{x}");
            assert_eq!(one_minus_up(x), to_f64_up(&exact), "{x}");
        }
    }
}
