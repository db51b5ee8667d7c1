//! How fine the lattice is.

use crate::noise::known::Distribution;
use crate::problem::{InputNoise, InputProblem};
use imdp::numeric::to_f64;

/// How many sub-cells a standard deviation or what comes closest to it should have.
const PER_SPREAD: f64 = 2.0;

/// More sub-cells a cell are not chosen.
const FINEST: u32 = 8;

/// The number of sub-cells of the partition that is not exceeded by choice.
const BUDGET: u64 = 1 << 22;

/// The resolution that the problem asks for, or one that makes sub-cells small beside the noise within a budget.
pub(super) fn choose(problem: &InputProblem) -> Vec<u32> {
    if let Some(resolution) = problem.resolution() {
        return resolution.to_vec();
    }
    let axes = problem.grid().axes();
    let wanted = |(j, spread): (usize, Option<f64>)| {
        let ratio = spread.map_or(f64::NAN, |spread| PER_SPREAD * to_f64(axes[j].width()) / spread);
        if ratio.is_finite() { (ratio.ceil() as u32).clamp(1, FINEST) } else { 1 }
    };
    let spreads: Vec<Option<f64>> = match problem.noise() {
        InputNoise::Components(components) => {
            components.iter().map(|noise| noise.as_ref().map(Distribution::spread)).collect()
        }
        InputNoise::Gaussian(noise) => {
            noise.factors.diagonal.iter().map(|d| Some(to_f64(d).sqrt())).collect()
        }
        // Every box costs confidence: fine lattices do not pay.
        InputNoise::Sampled(_) => vec![None; axes.len()],
    };
    let mut resolution: Vec<u32> = spreads.into_iter().enumerate().map(wanted).collect();
    let cells = |r: &[u32]| {
        axes.iter().zip(r).map(|(axis, &r)| u64::from(axis.cells()) * u64::from(r)).product::<u64>()
    };
    while cells(&resolution) > BUDGET {
        let finest = resolution.iter_mut().max().filter(|r| **r > 1);
        let Some(finest) = finest else { break };
        *finest -= 1;
    }
    resolution
}
