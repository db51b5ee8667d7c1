//! What is known of the noise of a problem: its distribution, or samples of it.

use super::distribution::DistributionParts;
use super::noise::{GaussianNoise, NoiseSource, SampledNoise};
use super::values::count;
use crate::Diagnostic;
use crate::noise::known::Distribution;
use crate::system::LinearSystem;
use imdp::numeric::Rational;
use num_traits::{One, Zero};

/// What is known of the noise of a problem.
#[derive(Clone, Debug)]
pub enum PlantNoise {
    /// The distributions of its coordinates, which are independent; nothing where there is no noise.
    Known(Vec<Option<Distribution>>),
    /// Samples.
    Sampled(Box<SampledNoise>),
}

impl PlantNoise {
    /// The samples, if that is what is known.
    pub fn samples(&self) -> Option<&SampledNoise> {
        match self {
            Self::Known(_) => None,
            Self::Sampled(samples) => Some(samples),
        }
    }

    /// The mean of the noise of grouped steps: for pictures.
    pub fn mean(&self) -> Vec<f64> {
        match self {
            Self::Known(components) => {
                components.iter().map(|one| one.as_ref().map_or(0.0, Distribution::center)).collect()
            }
            Self::Sampled(noise) => noise.samples.mean(),
        }
    }

    /// About how far the coordinates of the noise of grouped steps are from their means: the standard deviations of samples.
    pub fn spread(&self) -> Vec<f64> {
        match self {
            Self::Known(components) => {
                components.iter().map(|one| one.as_ref().map_or(0.0, Distribution::spread)).collect()
            }
            Self::Sampled(noise) => noise.samples.deviations(),
        }
    }
}

impl NoiseSource {
    /// What is known of the noise of `d` steps of `system`.
    ///
    /// # Errors
    /// A [`Diagnostic`] for the first mistake found.
    pub(super) fn plant_noise(&self, system: &LinearSystem, d: usize) -> Result<PlantNoise, Diagnostic> {
        let known = match self {
            Self::Components(parts) => components(parts, system.state_dimension())?,
            Self::Gaussian(gaussian) => gaussian.components(system.state_dimension())?,
            _ => return Ok(PlantNoise::Sampled(Box::new(self.obtain(system, d)?))),
        };
        if d > 1 {
            let found = format!("a known distribution, and {d} steps that are grouped");
            return Err(Diagnostic::at("/noise", found, "samples, where steps are grouped").remedy(
                "With \"actions\": \"inputs\" steps need not be grouped; or give a \"count\" of samples to draw.",
            ));
        }
        Ok(PlantNoise::Known(known))
    }
}

impl GaussianNoise {
    /// The distributions of its coordinates, if these are independent.
    fn components(&self, n: usize) -> Result<Vec<Option<Distribution>>, Diagnostic> {
        let (mean, covariance) = self.exact(n)?;
        let correlated = |j: usize| (0..j).any(|i| !covariance.get(i, j).is_zero());
        if let Some(j) = (0..n).find(|&j| correlated(j)) {
            let (place, found) =
                (format!("/noise/gaussian/covariance/{j}"), "components that depend on each other");
            return Err(Diagnostic::at(place, found, "a diagonal matrix, for actions that steer to targets")
                .remedy("Give a \"count\" of samples to draw, or take \"actions\": \"inputs\"."));
        }
        let component = |(j, mean): (usize, Rational)| match covariance.get(j, j) {
            variance if !variance.is_zero() => {
                Some(Distribution::Gaussian { mean, variance: variance.clone() })
            }
            _ if mean.is_zero() => None,
            _ => Some(Distribution::Atoms(vec![(mean, Rational::one())])),
        };
        Ok(mean.into_iter().enumerate().map(component).collect())
    }
}

/// The distributions of the coordinates of an `n`-dimensional noise.
pub(super) fn components(
    parts: &[Option<DistributionParts>],
    n: usize,
) -> Result<Vec<Option<Distribution>>, Diagnostic> {
    if parts.len() != n {
        let expected = format!("{n}, one per dimension of the state (null for none)");
        return Err(Diagnostic::at("/noise/components", count(parts.len(), "component"), expected));
    }
    let component = |(j, noise): (usize, &Option<DistributionParts>)| {
        noise.as_ref().map(|noise| noise.distribution(&format!("/noise/components/{j}"))).transpose()
    };
    parts.iter().enumerate().map(component).collect()
}
