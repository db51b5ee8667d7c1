//! The noise of one coordinate, cut at the pitch of the lattice.

use super::side::{LEAST_MASS, Slack};

/// Bounds on the masses of `[kδ, (k+1)δ)` for `k = first, first + 1, …`.
#[derive(Clone, Debug, PartialEq)]
pub struct Taps {
    /// The first interval.
    pub first: i64,
    /// Lower bounds on the masses.
    pub lower: Vec<f64>,
    /// Upper bounds on the masses.
    pub upper: Vec<f64>,
    /// A bound on the mass that may be in none of these intervals; 0 if the noise is known to have none elsewhere.
    pub elsewhere: f64,
}

impl Taps {
    /// The last interval.
    pub fn last(&self) -> i64 {
        self.first + self.lower.len() as i64 - 1
    }

    /// What the lower bounds leave: at most this much mass is unaccounted for.
    pub fn slack(&self) -> f64 {
        Slack::beside(&self.lower).most
    }

    /// Equal masses for all intervals that may have mass, unless there may be mass elsewhere.
    pub(super) fn possible(&self) -> Option<Self> {
        let count = self.upper.iter().filter(|&&p| p > 0.0).count();
        let share = |p: &f64| if *p > 0.0 { 1.0 / count as f64 } else { 0.0 };
        let lower: Vec<f64> = self.upper.iter().map(share).collect();
        (self.elsewhere == 0.0 && count > 0).then(|| Self {
            first: self.first,
            upper: lower.clone(),
            lower,
            elsewhere: 0.0,
        })
    }

    /// Masses too small to matter become 0: what they were is slack.
    pub(super) fn mass(&self, k: usize) -> f64 {
        let p = self.lower[k];
        if p < LEAST_MASS { 0.0 } else { p }
    }
}
