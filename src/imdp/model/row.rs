//! One interval distribution.

use super::StateId;
use super::exact_bounds::{End, ExactBound};
use crate::numeric::{Exact, Rational, from_decimal, shortest_decimal};

/// One row: `lower[i] ≤ p(successors[i]) ≤ upper[i]`.
///
/// A double stands for the shortest decimal that gives it. Where a bound is another number, the double is the one
/// nearest to it, and the number itself is in `exact`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<'a> {
    /// The successor states, ascending.
    pub successors: &'a [StateId],
    /// The lower bounds.
    pub lower: &'a [f64],
    /// The upper bounds.
    pub upper: &'a [f64],
    /// The bounds that are not the shortest decimals of their doubles, by position.
    pub exact: &'a [ExactBound],
}

impl Row<'_> {
    /// The number of successors.
    pub fn len(&self) -> usize {
        self.successors.len()
    }

    /// Whether there are no successors.
    pub fn is_empty(&self) -> bool {
        self.successors.is_empty()
    }
}

impl<'a> Row<'a> {
    /// The bounds at one end, as doubles.
    pub fn bounds(&self, end: End) -> &'a [f64] {
        match end {
            End::Lower => self.lower,
            End::Upper => self.upper,
        }
    }

    /// What a bound is exactly, if it is not the shortest decimal of its double.
    pub fn exact_bound(&self, end: End, position: usize) -> Option<&'a Exact> {
        let found = |bound: &&ExactBound| bound.position as usize == position && bound.end == end;
        let from = self.exact.partition_point(|bound| (bound.position as usize) < position);
        self.exact[from..].iter().take(2).find(found).map(|bound| &bound.value)
    }

    /// What a bound is exactly; 0 if its double is not finite.
    pub fn rational(&self, end: End, position: usize) -> Rational {
        match self.exact_bound(end, position) {
            Some(exact) => exact.to_rational(),
            None => from_decimal(self.bounds(end)[position]).unwrap_or_default(),
        }
    }

    /// A bound as it is written: the shortest decimal of its double, or the number that it is instead.
    pub fn text(&self, end: End, position: usize) -> String {
        match self.exact_bound(end, position) {
            Some(exact) => exact.to_string(),
            // The sum turns −0 into 0.
            None => shortest_decimal(self.bounds(end)[position] + 0.0),
        }
    }
}
