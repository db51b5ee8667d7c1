//! Bounds by state: doubles, and fractions where doubles do not do.

use super::Side;
use crate::exact::{ExactValues, Replaced};
use crate::model::StateId;
use crate::numeric::{Rational, from_dyadic};
use num_traits::Zero;

/// One of the two bounds of every state.
#[derive(Clone, Debug)]
pub(super) struct Bounds {
    side: Side,
    /// Where a bound is a fraction, the double next to it on the safe side.
    doubles: Vec<f64>,
    exact: Replaced,
}

impl Bounds {
    pub(super) fn new(side: Side, doubles: Vec<f64>) -> Self {
        Self { side, doubles, exact: Replaced::new() }
    }

    /// Replaces a bound by a double.
    pub(super) fn set(&mut self, state: usize, value: f64) {
        self.doubles[state] = value;
        self.exact.remove(&StateId::from_index(state));
    }

    /// Replaces a bound by a fraction.
    pub(super) fn set_exact(&mut self, state: usize, value: Rational) {
        self.doubles[state] = self.side.round(&value);
        self.exact.insert(StateId::from_index(state), value);
    }

    /// The bound as a double, rounded to the safe side.
    pub(super) fn double(&self, state: usize) -> f64 {
        self.doubles[state]
    }

    /// All bounds as doubles, rounded to the safe side.
    pub(super) fn into_doubles(self) -> Vec<f64> {
        self.doubles
    }

    /// The bound if it is a fraction.
    pub(super) fn fraction(&self, state: usize) -> Option<&Rational> {
        self.exact.get(&StateId::from_index(state))
    }

    /// The states whose bounds are fractions.
    pub(super) fn fractions(&self) -> impl Iterator<Item = (usize, &Rational)> {
        self.exact.iter().map(|(&state, bound)| (state.index(), bound))
    }

    /// The bound itself.
    pub(super) fn rational(&self, state: usize) -> Rational {
        self.fraction(state).cloned().or_else(|| from_dyadic(self.doubles[state])).unwrap_or_default()
    }

    /// Whether the bound is above 0.
    pub(super) fn is_positive(&self, state: usize) -> bool {
        self.fraction(state).map_or(self.doubles[state] > 0.0, |bound| !bound.is_zero())
    }

    /// Whether a bound is the same in both.
    pub(super) fn agrees(&self, other: &Self, state: usize) -> bool {
        self.doubles[state] == other.doubles[state] && self.fraction(state) == other.fraction(state)
    }

    /// The bounds as exact numbers.
    pub(super) fn to_exact(&self) -> ExactValues<'_> {
        ExactValues::with(&self.doubles, &self.exact)
    }

    /// The bounds as exact numbers that are compared only.
    pub(super) fn to_compare(&self) -> ExactValues<'_> {
        ExactValues::to_compare(&self.doubles, &self.exact)
    }
}
