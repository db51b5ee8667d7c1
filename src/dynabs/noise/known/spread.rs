//! How wide a distribution is, roughly.

use super::Distribution;
use imdp::numeric::{Rational, to_f64};

impl Distribution {
    /// About the half-width of the interval with the middle two thirds of the mass: no bound, for choosing a lattice.
    pub fn spread(&self) -> f64 {
        let third = |lower: &Rational, upper: &Rational| to_f64(&(upper - lower)) / 3.0;
        match self {
            Self::Gaussian { variance, .. } => to_f64(variance).sqrt(),
            Self::Laplace { scale, .. } | Self::StudentT { scale, .. } => to_f64(scale),
            Self::Logistic { scale, .. } => 1.6 * to_f64(scale),
            Self::Uniform { lower, upper } | Self::Triangular { lower, upper, .. } => third(lower, upper),
            Self::Atoms(points) | Self::Table(points) => match (points.first(), points.last()) {
                (Some((first, _)), Some((last, _))) => third(first, last),
                _ => 0.0,
            },
            Self::Truncated { of, lower, upper } => of.spread().min(third(lower, upper)),
            Self::Mixture(parts) => parts.iter().map(|(_, of)| of.spread()).fold(f64::INFINITY, f64::min),
        }
    }
}
