//! How probability intervals are computed: the mode of an abstraction.

use crate::Diagnostic;
use imdp::numeric::{Rational, from_decimal};
use num_traits::{One, Zero};

/// How probability intervals are computed from the samples.
#[derive(Clone, Debug, PartialEq)]
pub enum Probabilities {
    /// Jointly valid with probability at least `1 − beta`.
    Pac {
        /// The failure probability, exactly.
        beta: Rational,
        /// How many settings are compiled with these samples: each may spend `beta / sweep`.
        sweep: u64,
        /// How many of the farthest samples are left out of the cells that rows list.
        discard: u64,
    },
    /// The published tool's intervals.
    Reference {
        /// The failure probability of one interval.
        beta_per_interval: f64,
    },
}

impl Default for Probabilities {
    /// Jointly valid with probability 0.99.
    fn default() -> Self {
        Self::Pac { beta: Rational::new(1.into(), 100.into()), sweep: 1, discard: 0 }
    }
}

impl Probabilities {
    /// Intervals that hold together with probability at least `confidence`.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it is not strictly between 0 and 1.
    pub fn with_confidence(confidence: f64) -> Result<Self, Diagnostic> {
        let beta = Rational::one() - in_unit("confidence", confidence)?;
        Ok(Self::Pac { beta, sweep: 1, discard: 0 })
    }

    /// Intervals that fail to hold together with probability at most `beta`.
    ///
    /// # Errors
    /// A [`Diagnostic`] if it is not strictly between 0 and 1.
    pub fn with_beta(beta: f64) -> Result<Self, Diagnostic> {
        Ok(Self::Pac { beta: in_unit("beta", beta)?, sweep: 1, discard: 0 })
    }

    /// The published tool's intervals; not a guarantee.
    ///
    /// # Errors
    /// A [`Diagnostic`] if `beta_per_interval` is not strictly between 0 and 1.
    pub fn reference(beta_per_interval: f64) -> Result<Self, Diagnostic> {
        in_unit("beta_per_interval", beta_per_interval)?;
        Ok(Self::Reference { beta_per_interval })
    }

    /// Leaves the cells of this many farthest samples out of the rows, if samples prove anything here.
    ///
    /// Choose the number before looking at the samples.
    #[must_use]
    pub fn discarding(self, count: u64) -> Self {
        match self {
            Self::Pac { beta, sweep, .. } => Self::Pac { beta, sweep, discard: count },
            Self::Reference { .. } => self,
        }
    }

    /// Shares the failure probability among this many settings that are compiled with the same samples.
    ///
    /// # Errors
    /// A [`Diagnostic`] if there are none.
    pub fn among(self, settings: u64) -> Result<Self, Diagnostic> {
        match self {
            Self::Pac { .. } if settings == 0 => Err(Diagnostic::at(
                "/probabilities/sweep",
                "0",
                "the number of settings that are compiled with these samples, at least 1",
            )),
            Self::Pac { beta, discard, .. } => Ok(Self::Pac { beta, sweep: settings, discard }),
            Self::Reference { .. } => Ok(self),
        }
    }
}

fn in_unit(field: &str, x: f64) -> Result<Rational, Diagnostic> {
    match from_decimal(x) {
        Some(exact) if !exact.is_zero() && x > 0.0 && x < 1.0 => Ok(exact),
        _ => Err(Diagnostic::at(
            format!("/probabilities/{field}"),
            x.to_string(),
            "a number strictly between 0 and 1",
        )),
    }
}
