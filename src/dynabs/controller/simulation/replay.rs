//! Runs with samples that were kept for them.

use super::{Simulation, Tally};
use crate::noise::NoiseSamples;
use crate::problem::{Problem, SampleKind};

/// How many samples every run is given: as many as the horizon takes, whether it needs them or not.
///
/// Were the next run to go on where the last one stopped, how many runs there are would depend on how they
/// went. `None` without a horizon.
pub fn samples_per_run(problem: &Problem, of: SampleKind) -> Option<u64> {
    let steps = problem.horizon()?;
    Some(match of {
        SampleKind::Grouped => steps,
        SampleKind::Step => steps * problem.group_steps() as u64,
    })
}

impl Simulation<'_> {
    /// Runs from `start`, each with its own `per_run` samples in order, as many as there are samples for.
    ///
    /// For independent samples with the law of the noise, and a controller and a start that were fixed without looking at
    /// them, the runs are independent and succeed with the probability that is asked for.
    pub fn replay(&self, start: &[f64], samples: &NoiseSamples, of: SampleKind, per_run: u64) -> Tally {
        let n = samples.dimension();
        let mut tally = Tally::default();
        let runs = (samples.len() as u64).checked_div(per_run).unwrap_or(0);
        for run in 0..runs {
            let mut next = (run * per_run) as usize;
            let outcome = self.with_noise(start, run, |noise| match of {
                SampleKind::Step => {
                    for noise in noise.chunks_exact_mut(n) {
                        noise.copy_from_slice(samples.sample(next));
                        next += 1;
                    }
                }
                SampleKind::Grouped => {
                    let last = noise.len() - n;
                    noise[..last].fill(0.0);
                    noise[last..].copy_from_slice(samples.sample(next));
                    next += 1;
                }
            });
            tally.add(outcome);
        }
        tally
    }
}
