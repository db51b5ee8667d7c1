//! Bounds that no double stands for.

use crate::numeric::Exact;

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
