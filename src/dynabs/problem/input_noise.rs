//! The noise of a problem whose actions are inputs.

use super::noise::{GaussianNoise, NoiseSource, SampledNoise};
use super::plant_noise::components;
use super::probabilities::Probabilities;
use crate::Diagnostic;
use crate::linear_algebra::{ExactMatrix, LdlFactors};
use crate::noise::Gaussian;
use crate::noise::known::Distribution;
use crate::system::LinearSystem;
use imdp::numeric::Rational;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The noise of one step, not yet checked.
#[derive(Clone, Debug)]
pub struct InputNoiseParts {
    /// What is known, or where samples come from.
    pub source: NoiseSource,
    /// What is assumed of the coordinates of samples.
    pub components: Components,
    /// The confidence, if there are samples.
    pub probabilities: Probabilities,
}

/// What is assumed of the coordinates of sampled noise, and what samples are asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Components {
    /// Nothing is assumed: the probabilities of boxes.
    #[default]
    Joint,
    /// They are independent of each other: the probabilities of intervals.
    Intervals,
    /// They are independent of each other: bands for their distribution functions.
    Bands,
}

/// The noise of one step.
#[derive(Clone, Debug)]
pub enum InputNoise {
    /// Known distributions of the coordinates, which are independent.
    Components(Vec<Option<Distribution>>),
    /// A known normal distribution.
    Gaussian(Box<JointGaussian>),
    /// Samples of an unknown distribution.
    Sampled(Box<StepSamples>),
}

/// `N(μ, Σ)` as `μ + L ζ`, the entries of `ζ` independent with variances `D`: `Σ = L D Lᵀ`, all of it exact.
#[derive(Clone, Debug)]
pub struct JointGaussian {
    /// `L⁻¹ μ`, the means of `ζ`.
    pub means: Vec<Rational>,
    /// `L` and `D`.
    pub factors: LdlFactors,
    /// For drawing.
    pub draws: Gaussian,
}

/// Samples, and what is to be proved from them.
#[derive(Clone, Debug)]
pub struct StepSamples {
    /// The samples.
    pub noise: SampledNoise,
    /// What is assumed.
    pub components: Components,
    /// What all settings of a sweep may fail with together.
    pub beta: Rational,
    /// How many settings there are.
    pub sweep: u64,
    /// How many of the farthest samples windows leave out.
    pub discard: u64,
}

impl InputNoiseParts {
    /// Checks that it is the noise of an `n`-dimensional state.
    ///
    /// # Errors
    /// A [`Diagnostic`] for the first mistake found.
    pub(super) fn noise(&self, n: usize) -> Result<InputNoise, Diagnostic> {
        match &self.source {
            NoiseSource::Components(parts) => components(parts, n).map(InputNoise::Components),
            NoiseSource::Gaussian(parts) => {
                joint(parts, n).map(|noise| InputNoise::Gaussian(Box::new(noise)))
            }
            sampled => {
                let Probabilities::Pac { beta, sweep, discard } = self.probabilities.clone() else {
                    let expected = "\"pac\" for actions \"inputs\"";
                    return Err(Diagnostic::at("/probabilities/mode", "\"reference\"", expected));
                };
                let nothing = ExactMatrix::zeros(n, 1);
                let one_step = LinearSystem::new(ExactMatrix::identity(n), nothing.clone(), nothing);
                let noise = sampled.obtain(&one_step, 1)?;
                let samples = StepSamples { noise, components: self.components, beta, sweep, discard };
                Ok(InputNoise::Sampled(Box::new(samples)))
            }
        }
    }
}

impl InputNoise {
    /// By coordinate, whether there is noise.
    pub fn noisy(&self, n: usize) -> Vec<bool> {
        match self {
            Self::Components(components) => components.iter().map(Option::is_some).collect(),
            Self::Gaussian(gaussian) => (0..n).map(|i| (0..=i).any(|j| gaussian.is_moved(i, j))).collect(),
            Self::Sampled(_) => vec![true; n],
        }
    }

    /// The samples, if it is not known otherwise.
    pub fn samples(&self) -> Option<&StepSamples> {
        match self {
            Self::Sampled(samples) => Some(samples),
            Self::Components(_) | Self::Gaussian(_) => None,
        }
    }
}

impl JointGaussian {
    /// Whether `ζ_j` is ever other than 0.
    pub fn is_active(&self, j: usize) -> bool {
        use num_traits::Zero;
        !self.factors.diagonal[j].is_zero() || !self.means[j].is_zero()
    }

    /// Whether `ζ_j` moves coordinate `i`.
    pub fn is_moved(&self, i: usize, j: usize) -> bool {
        use num_traits::Zero;
        self.is_active(j) && !self.factors.lower.get(i, j).is_zero()
    }
}

fn joint(parts: &GaussianNoise, n: usize) -> Result<JointGaussian, Diagnostic> {
    let (mean, covariance) = parts.exact(n)?;
    let draws = parts.distribution(n)?;
    let factors = covariance.ldl().ok_or_else(|| {
        let place = "/noise/gaussian/covariance";
        Diagnostic::at(place, "a matrix without a factor", "a positive semidefinite matrix")
    })?;
    let mut means: Vec<Rational> = Vec::with_capacity(n);
    for (i, mean) in mean.iter().enumerate() {
        let known = (0..i).map(|j| factors.lower.get(i, j) * &means[j]);
        let mean = known.fold(mean.clone(), |rest, known| rest - known);
        means.push(mean);
    }
    Ok(JointGaussian { means, factors, draws })
}
