//! What moves the state of a simulated run: the true system, with noise as truly as it is known.

use super::{Noise, Plant};
use crate::controller::Controller;
use crate::problem::InputProblem;
use crate::system::Interval;
use rand::{Rng, RngExt};

/// How parameters are picked at every step, each from its interval.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ParameterChoice {
    /// Uniformly.
    #[default]
    Random,
    /// Either end of each interval, by chance.
    Corners,
    /// The ends that lead, with the noise of the step, to the state with the least bound.
    Adversarial,
}

/// With more parameters an adversary looks at this many of them only.
const MOST_ADVERSARIAL: usize = 8;

/// The true system.
#[derive(Clone, Debug)]
pub(super) enum Motion<'a> {
    /// A linear one.
    Linear { plant: Plant, noise: Noise },
    /// Any.
    Mode { problem: &'a InputProblem, parameters: ParameterChoice, noise: Noise },
}

impl Motion<'_> {
    /// Draws the noise of a group of steps, step after step.
    pub(super) fn draw(&self, rng: &mut impl Rng, noise: &mut [f64]) {
        match self {
            Self::Linear { noise: source, .. } | Self::Mode { noise: source, .. } => source.draw(rng, noise),
        }
    }

    /// One step from `x` with input `u`, written to `next`; an adversary wants what `controller` promises the least for.
    pub(super) fn step(
        &self,
        controller: &Controller,
        (x, u, noise): (&[f64], &[f64], &[f64]),
        rng: &mut impl Rng,
        (numbers, next): (&mut Vec<f64>, &mut [f64]),
    ) {
        let (problem, parameters) = match self {
            Self::Linear { plant, .. } => return plant.step(x, u, noise, next),
            Self::Mode { problem, parameters, .. } => (problem, parameters),
        };
        let boxes = problem.mode().parameters();
        let mut go = |parameters: &[f64], next: &mut [f64]| {
            problem.mode().step(x, u, parameters, numbers, next);
            next.iter_mut().zip(noise).for_each(|(x, noise)| *x += noise);
            controller.wrap(next);
        };
        let corner = |corner: usize| -> Vec<f64> {
            let end = |(i, p): (usize, &Interval)| if corner >> i & 1 == 0 { p.lower() } else { p.upper() };
            boxes.iter().enumerate().map(end).collect()
        };
        match parameters {
            _ if boxes.is_empty() => go(&[], next),
            ParameterChoice::Random => {
                let parameters: Vec<f64> =
                    boxes.iter().map(|p| p.lower() + rng.random::<f64>() * (p.upper() - p.lower())).collect();
                go(&parameters, next);
            }
            ParameterChoice::Corners => {
                let which: u64 = rng.random();
                go(&corner(which as usize & ((1 << boxes.len().min(60)) - 1)), next);
            }
            ParameterChoice::Adversarial => {
                let mut least = f64::INFINITY;
                let mut other = vec![0.0; next.len()];
                for which in 0..1usize << boxes.len().min(MOST_ADVERSARIAL) {
                    go(&corner(which), &mut other);
                    let bound = controller.bound_at(&other);
                    if bound < least {
                        least = bound;
                        next.copy_from_slice(&other);
                    }
                }
            }
        }
    }
}
