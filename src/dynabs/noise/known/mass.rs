//! The mass of an interval.

use super::Distribution;
use super::tail::upper_tail;
use crate::system::Interval;
use imdp::numeric::Rational;
use num_traits::{One, Signed, Zero};

/// All masses are in here.
fn unit() -> Interval {
    Interval::new(0.0, 1.0)
}

impl Distribution {
    /// Bounds on the mass of `[from, to)`; an end that is missing is infinite.
    pub fn mass(&self, from: Option<&Rational>, to: Option<&Rational>) -> Interval {
        if let (Some(from), Some(to)) = (from, to)
            && from >= to
        {
            return Interval::ZERO;
        }
        match self {
            Self::Mixture(parts) => {
                let weighted =
                    parts.iter().map(|(weight, of)| Interval::enclosing(weight, weight) * of.mass(from, to));
                weighted.fold(Interval::ZERO, |sum, mass| sum + mass).meet(unit())
            }
            Self::Truncated { of, lower, upper } => {
                let from = from.map_or(lower, |from| from.max(lower));
                let to = to.map_or(upper, |to| to.min(upper));
                let all = of.mass(Some(lower), Some(upper));
                (of.mass(Some(from), Some(to)) / all).meet(unit())
            }
            Self::Gaussian { mean, .. }
            | Self::Laplace { mean, .. }
            | Self::Logistic { mean, .. }
            | Self::StudentT { mean, .. } => self.symmetric_mass(mean, from, to).meet(unit()),
            Self::Uniform { .. } | Self::Triangular { .. } | Self::Atoms(_) | Self::Table(_) => {
                let below = |x: Option<&Rational>, infinite| x.map_or(infinite, |x| self.exact_below(x));
                let mass = below(to, Rational::one()) - below(from, Rational::zero());
                Interval::enclosing(&mass, &mass)
            }
        }
    }

    /// From the tails on either side, so that no mass is the difference of numbers near 1.
    fn symmetric_mass(&self, mean: &Rational, from: Option<&Rational>, to: Option<&Rational>) -> Interval {
        let tail = |distance: Option<Rational>| match distance {
            None => Interval::ZERO,
            Some(distance) => upper_tail(self, &distance).unwrap_or(unit()),
        };
        let (from, to) = (from.map(|x| x - mean), to.map(|x| x - mean));
        if from.as_ref().is_some_and(|x| !x.is_negative()) {
            return tail(from) - tail(to);
        }
        if to.as_ref().is_some_and(|x| !x.is_positive()) {
            return tail(to.map(|x| -x)) - tail(from.map(|x| -x));
        }
        Interval::point(1.0) - tail(from.map(|x| -x)) - tail(to)
    }

    /// `P(η < x)` where that is rational; 0 elsewhere.
    fn exact_below(&self, x: &Rational) -> Rational {
        match self {
            Self::Uniform { lower, upper } => {
                ((x - lower) / (upper - lower)).clamp(Rational::zero(), Rational::one())
            }
            Self::Triangular { lower, mode, upper } => {
                if x <= lower {
                    Rational::zero()
                } else if x >= upper {
                    Rational::one()
                } else if x <= mode {
                    (x - lower) * (x - lower) / ((upper - lower) * (mode - lower))
                } else {
                    Rational::one() - (upper - x) * (upper - x) / ((upper - lower) * (upper - mode))
                }
            }
            Self::Atoms(atoms) => atoms.iter().filter(|(value, _)| value < x).map(|(_, weight)| weight).sum(),
            Self::Table(points) => {
                let after = points.partition_point(|(at, _)| at <= x);
                match (after.checked_sub(1).and_then(|i| points.get(i)), points.get(after)) {
                    (None, _) => Rational::zero(),
                    (Some(_), None) => Rational::one(),
                    (Some((a, p)), Some((b, q))) => p + (q - p) * (x - a) / (b - a),
                }
            }
            _ => Rational::zero(),
        }
    }

    /// The smallest interval that is known to have all mass; an end that is missing is infinite.
    pub fn support(&self) -> (Option<Rational>, Option<Rational>) {
        match self {
            Self::Uniform { lower, upper } | Self::Triangular { lower, upper, .. } => {
                (Some(lower.clone()), Some(upper.clone()))
            }
            Self::Truncated { of, lower, upper } => {
                let (least, most) = of.support();
                (
                    Some(least.map_or(lower.clone(), |x| x.max(lower.clone()))),
                    Some(most.map_or(upper.clone(), |x| x.min(upper.clone()))),
                )
            }
            Self::Atoms(points) | Self::Table(points) => {
                (points.first().map(|(x, _)| x.clone()), points.last().map(|(x, _)| x.clone()))
            }
            Self::Mixture(parts) => {
                let supports =
                    || parts.iter().filter(|(weight, _)| !weight.is_zero()).map(|(_, of)| of.support());
                let least = supports().map(|(lower, _)| lower).reduce(|a, b| a.zip(b).map(|(a, b)| a.min(b)));
                let most = supports().map(|(_, upper)| upper).reduce(|a, b| a.zip(b).map(|(a, b)| a.max(b)));
                (least.flatten(), most.flatten())
            }
            _ => (None, None),
        }
    }
}
