//! Sets of inputs: boxes and polytopes.

use super::values::{matrix, vector};
use crate::Diagnostic;
use crate::geometry::Polytope;

/// A set of inputs, not empty.
#[derive(Clone, Debug, PartialEq)]
pub enum InputSet {
    /// `{u : lower ≤ u ≤ upper}`.
    Box {
        /// The lower corner.
        lower: Vec<f64>,
        /// The upper corner.
        upper: Vec<f64>,
    },
    /// `{u : G u ≤ g}`.
    Polytope {
        /// `G`, one row per half-space.
        normals: Vec<Vec<f64>>,
        /// `g`, one number per half-space.
        offsets: Vec<f64>,
    },
}

impl InputSet {
    /// The set as a polytope in `dimension` inputs, if it is not empty.
    pub(super) fn polytope(&self, place: &str, dimension: usize) -> Result<Polytope, Diagnostic> {
        let what = "one per input";
        let set = match self {
            Self::Box { lower, upper } => {
                let lower_exact = vector(&format!("{place}/lower"), lower, dimension, what)?;
                let upper_exact = vector(&format!("{place}/upper"), upper, dimension, what)?;
                if let Some(j) = (0..dimension).find(|&j| lower_exact[j] > upper_exact[j]) {
                    let found = format!("lower {} above upper {} for input {}", lower[j], upper[j], j + 1);
                    return Err(Diagnostic::at(place, found, "lower ≤ upper: this box is empty"));
                }
                Polytope::from_box(&lower_exact, &upper_exact)
            }
            Self::Polytope { normals, offsets } => {
                let g = matrix(&format!("{place}/G"), normals, None, Some(dimension), what)?;
                let offsets = vector(&format!("{place}/g"), offsets, g.rows(), "one per row of G")?;
                Polytope::new(g, offsets)
            }
        };
        if set.is_empty() {
            let found = "half-spaces that have no point in common";
            return Err(Diagnostic::at(place, found, "a set with at least one input")
                .remedy("Check the signs: every row means G u ≤ g."));
        }
        Ok(set)
    }

    /// The set as a polytope, if it contains 0: what is left to the abstraction by a lower layer.
    pub(super) fn around_zero(
        &self,
        place: &str,
        dimension: usize,
        remedy: &str,
    ) -> Result<Polytope, Diagnostic> {
        let set = self.polytope(place, dimension)?;
        if !set.contains_origin() {
            return Err(Diagnostic::at(place, "a set without 0", "a set U′ that contains 0").remedy(remedy));
        }
        Ok(set)
    }
}
