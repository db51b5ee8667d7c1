//! Bounds that no double stands for.

use super::Row;
use crate::numeric::{Exact, Rational, from_decimal, shortest_decimal};

/// One of the two ends of an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum End {
    /// The lower bound.
    Lower,
    /// The upper bound.
    Upper,
}

/// A bound of a row that is not the shortest decimal of its double.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ExactBound {
    /// The position of its successor in the row.
    pub position: u32,
    /// Which bound it is.
    pub end: End,
    /// What it is.
    pub value: Exact,
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
