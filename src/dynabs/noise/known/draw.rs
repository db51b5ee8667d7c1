//! Drawing from a known distribution, for simulations.

use super::Distribution;
use imdp::numeric::{Rational, to_f64};
use rand::{Rng, RngExt};
use rand_distr::{Distribution as _, StandardNormal, StudentT};

/// After so many draws outside an interval that a distribution is truncated to, its middle is taken.
const MOST_REJECTED: usize = 1_000_000;

impl Distribution {
    /// A number with this distribution, up to the rounding of doubles.
    pub fn draw(&self, rng: &mut impl Rng) -> f64 {
        match self {
            Self::Gaussian { mean, variance } => {
                let z: f64 = StandardNormal.sample(rng);
                to_f64(mean) + to_f64(variance).sqrt() * z
            }
            Self::Laplace { mean, scale } => {
                let u: f64 = rng.random::<f64>() - 0.5;
                to_f64(mean) - to_f64(scale) * u.signum() * (-2.0 * u.abs()).ln_1p()
            }
            Self::Logistic { mean, scale } => {
                let u = open_unit(rng);
                to_f64(mean) + to_f64(scale) * (u / (1.0 - u)).ln()
            }
            Self::StudentT { mean, scale, degrees } => {
                let t = StudentT::new(f64::from(*degrees)).map_or(0.0, |t| t.sample(rng));
                to_f64(mean) + to_f64(scale) * t
            }
            Self::Uniform { lower, upper } => between(lower, upper, rng.random()),
            Self::Triangular { lower, mode, upper } => {
                let (a, c, b) = (to_f64(lower), to_f64(mode), to_f64(upper));
                let u: f64 = rng.random();
                if u * (b - a) < c - a {
                    a + (u * (b - a) * (c - a)).sqrt()
                } else {
                    b - ((1.0 - u) * (b - a) * (b - c)).sqrt()
                }
            }
            Self::Atoms(atoms) => {
                pick(atoms.iter().map(|(value, weight)| (weight, value)), rng).map_or(0.0, to_f64)
            }
            Self::Table(points) => {
                let u: f64 = rng.random();
                let after = points.partition_point(|(_, p)| to_f64(p) <= u).clamp(1, points.len() - 1);
                let ((a, p), (b, q)) = (&points[after - 1], &points[after]);
                between(a, b, (u - to_f64(p)) / to_f64(&(q - p)))
            }
            Self::Mixture(parts) => {
                pick(parts.iter().map(|(weight, of)| (weight, of)), rng).map_or(0.0, |of| of.draw(rng))
            }
            Self::Truncated { of, lower, upper } => {
                let (low, high) = (to_f64(lower), to_f64(upper));
                let draws = (0..MOST_REJECTED).map(|_| of.draw(rng));
                draws.into_iter().find(|x| (low..high).contains(x)).unwrap_or(0.5 * (low + high))
            }
        }
    }
}

fn between(lower: &Rational, upper: &Rational, share: f64) -> f64 {
    let low = to_f64(lower);
    low + share * (to_f64(upper) - low)
}

fn open_unit(rng: &mut impl Rng) -> f64 {
    let u: f64 = rng.random();
    if u == 0.0 { f64::EPSILON } else { u }
}

/// One of several, by weight.
fn pick<'a, T>(parts: impl Iterator<Item = (&'a Rational, T)>, rng: &mut impl Rng) -> Option<T> {
    let mut rest: f64 = rng.random();
    let mut last = None;
    for (weight, part) in parts {
        rest -= to_f64(weight);
        last = Some(part);
        if rest < 0.0 {
            break;
        }
    }
    last
}
