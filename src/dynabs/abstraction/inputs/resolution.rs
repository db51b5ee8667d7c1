//! How fine the lattice is.

use crate::noise::known::Distribution;
use crate::problem::InputProblem;
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
    let wanted = |(j, noise): (usize, &Option<Distribution>)| match noise {
        None => 1,
        Some(noise) => {
            let ratio = PER_SPREAD * to_f64(axes[j].width()) / noise.spread();
            if ratio.is_finite() { (ratio.ceil() as u32).clamp(1, FINEST) } else { 1 }
        }
    };
    let mut resolution: Vec<u32> = problem.noise().iter().enumerate().map(wanted).collect();
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
