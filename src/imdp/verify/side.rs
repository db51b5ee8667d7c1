//! What the two bounds have in common, as mirror images.

use crate::numeric::{Rational, to_f64_down, to_f64_up};

/// Which of the two bounds is proved.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The lower bound.
    Lower,
    /// The upper bound.
    Upper,
}

impl Side {
    /// The double next to an exact expectation on this side.
    ///
    /// Bounds are doubles, so a bound is on the right side of the expectation if and only if it is on the
    /// right side of this.
    pub(super) fn round(self, exact: &Rational) -> f64 {
        match self {
            Self::Lower => to_f64_down(exact),
            Self::Upper => to_f64_up(exact),
        }
    }

    /// Whether a bound follows from an expectation.
    pub(super) fn follows(self, bound: f64, expectation: f64) -> bool {
        match self {
            Self::Lower => bound <= expectation,
            Self::Upper => bound >= expectation,
        }
    }

    /// How a bound on this side relates to what it bounds, in words.
    pub(super) fn limit(self) -> &'static str {
        match self {
            Self::Lower => "at most",
            Self::Upper => "at least",
        }
    }

    /// What bounds every probability.
    pub(super) fn trivial(self) -> f64 {
        match self {
            Self::Lower => 0.0,
            Self::Upper => 1.0,
        }
    }

    /// An expectation from which every bound follows.
    pub(super) fn best(self) -> f64 {
        match self {
            Self::Lower => f64::INFINITY,
            Self::Upper => f64::NEG_INFINITY,
        }
    }

    /// The expectation from which fewer bounds follow.
    pub(super) fn worse(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Lower => a.min(b),
            Self::Upper => a.max(b),
        }
    }
}

impl std::fmt::Display for Side {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Lower => "lower",
            Self::Upper => "upper",
        })
    }
}
