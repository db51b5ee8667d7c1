//! How wide a distribution is and where it lies, roughly.

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

    /// The mean, for pictures: roughly where truncation moves it, the center where there is none.
    pub fn center(&self) -> f64 {
        let number = |x: &Rational| to_f64(x);
        match self {
            Self::Gaussian { mean, .. }
            | Self::Laplace { mean, .. }
            | Self::Logistic { mean, .. }
            | Self::StudentT { mean, .. } => number(mean),
            Self::Uniform { lower, upper } => (number(lower) + number(upper)) / 2.0,
            Self::Triangular { lower, mode, upper } => (number(lower) + number(mode) + number(upper)) / 3.0,
            Self::Atoms(points) => points.iter().map(|(x, mass)| number(x) * number(mass)).sum(),
            Self::Table(points) => {
                let part = |pair: &[(Rational, Rational)]| {
                    number(&(&pair[1].1 - &pair[0].1)) * (number(&pair[0].0) + number(&pair[1].0)) / 2.0
                };
                points.windows(2).map(part).sum()
            }
            Self::Mixture(parts) => parts.iter().map(|(weight, of)| number(weight) * of.center()).sum(),
            Self::Truncated { of, lower, upper } => of.center().clamp(number(lower), number(upper)),
        }
    }
}
