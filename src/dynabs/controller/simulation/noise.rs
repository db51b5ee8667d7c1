//! The noise of a simulated run.

use crate::noise::known::Distribution;
use crate::noise::{Gaussian, NoiseSamples};
use crate::problem::{InputNoise, PlantNoise, SampledNoise, StepNoise};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha12Rng;

/// Where the noise of the closed loop comes from.
#[derive(Clone, Debug)]
pub enum Noise {
    /// Distributions of the coordinates of the noise of one step; nothing where there is no noise.
    Components(Vec<Option<Distribution>>),
    /// A normal distribution of the noise of one step.
    Gaussian(Gaussian),
    /// Samples of the noise of one step, drawn with replacement.
    StepSamples(NoiseSamples),
    /// Samples of the noise of `d` steps together, drawn with replacement.
    GroupedSamples(NoiseSamples),
}

impl Noise {
    /// The noise of a problem, as truly as it is known.
    pub fn of_plant(noise: &PlantNoise) -> Self {
        match noise {
            PlantNoise::Known(components) => Self::Components(components.clone()),
            PlantNoise::Sampled(source) => Self::of(source),
        }
    }

    /// The noise of a problem whose actions are inputs, as truly as it is known.
    pub fn of_inputs(noise: &InputNoise) -> Self {
        match noise {
            InputNoise::Components(components) => Self::Components(components.clone()),
            InputNoise::Gaussian(joint) => Self::Gaussian(joint.draws.clone()),
            InputNoise::Sampled(samples) => Self::of(&samples.noise),
        }
    }

    /// The noise that a source describes, and as truly as it is known: step by step if it can be.
    pub fn of(source: &SampledNoise) -> Self {
        match &source.of_one_step {
            StepNoise::Gaussian(gaussian) => Self::Gaussian(gaussian.clone()),
            StepNoise::Samples(samples) => Self::StepSamples(samples.clone()),
            StepNoise::Unknown => Self::GroupedSamples(source.samples.clone()),
        }
    }

    /// The dimension of the noise.
    pub fn dimension(&self) -> usize {
        match self {
            Self::Components(components) => components.len(),
            Self::Gaussian(gaussian) => gaussian.dimension(),
            Self::StepSamples(samples) | Self::GroupedSamples(samples) => samples.dimension(),
        }
    }

    /// Whether every step has its own noise; otherwise that of a group comes with its last step.
    pub fn is_stepwise(&self) -> bool {
        !matches!(self, Self::GroupedSamples(_))
    }

    /// Draws `count` times the noise of one step, or of a group if only that is known.
    pub fn sample(&self, count: usize, seed: u64) -> Vec<Vec<f64>> {
        let mut rng = ChaCha12Rng::seed_from_u64(seed);
        let draw = |_| {
            let mut noise = vec![0.0; self.dimension()];
            self.draw(&mut rng, &mut noise);
            noise
        };
        (0..count).map(draw).collect()
    }

    /// Draws the noise of a group of steps, step after step.
    pub(super) fn draw(&self, rng: &mut impl Rng, steps: &mut [f64]) {
        let n = self.dimension();
        match self {
            Self::Components(components) => {
                for noise in steps.chunks_exact_mut(n) {
                    let drawn = components.iter().map(|one| one.as_ref().map_or(0.0, |one| one.draw(rng)));
                    noise.iter_mut().zip(drawn).for_each(|(noise, drawn)| *noise = drawn);
                }
            }
            Self::Gaussian(gaussian) => {
                steps.chunks_exact_mut(n).for_each(|noise| gaussian.draw(rng, noise));
            }
            Self::StepSamples(samples) => {
                steps.chunks_exact_mut(n).for_each(|noise| pick(samples, rng, noise))
            }
            Self::GroupedSamples(samples) => {
                // x⁺ = Â x + B̂ u + q̂ + η̂: with the noise of the last step weighted by the identity.
                let last = steps.len() - n;
                steps[..last].fill(0.0);
                pick(samples, rng, &mut steps[last..]);
            }
        }
    }
}

fn pick(samples: &NoiseSamples, rng: &mut impl Rng, noise: &mut [f64]) {
    noise.copy_from_slice(samples.sample(rng.random_range(0..samples.len())));
}
