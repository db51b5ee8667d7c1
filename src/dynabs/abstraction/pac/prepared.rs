//! What comes before counting: the budget is spent, windows are laid.

use super::super::AbstractionError;
use super::super::action_counts::TargetPlacements;
use super::super::hazards::Hazards;
use super::super::targets::Targets;
use super::super::windows::{Stack, Windows, shape_samples};
use super::bounds::{DIGITS, SampleSize};
use super::ends::TaskEnds;
use super::levels::{Levels, LowerBounds};
use crate::problem::{Problem, SampledNoise};
use crate::statistics::{ConfidenceBudget, upper_bound};
use imdp::numeric::{Rational, one_minus_down, round_decimal_up, to_f64};

/// The most that may be unseen: beyond it no policy could be shown to succeed more often than not.
const MAX_UNSEEN: f64 = 0.5;

/// Levels and windows: all that is known before it is known where targets can be steered to.
pub(in super::super) struct Prepared {
    /// What all settings of a sweep may fail with together, and how many there are.
    pub(super) beta: f64,
    pub(super) sweep: u64,
    pub(super) budget: ConfidenceBudget,
    pub(super) levels: Levels,
    pub(super) ends: TaskEnds,
    pub(super) windows: Windows,
    /// Per window, a bound on the mass outside.
    pub(super) unseen: Vec<f64>,
}

impl Prepared {
    /// Spends the part of `β` that one of `sweep` settings has, and lays windows; the `discard` farthest samples are left
    /// out of all of them.
    ///
    /// With `hazards` to be avoided at every step, windows are for the noise of all steps.
    pub(in super::super) fn new(
        (problem, noise): (&Problem, &SampledNoise),
        (beta, sweep, discard): (&Rational, u64, usize),
        (targets, ends): (&Targets, TaskEnds),
        placements: &TargetPlacements<'_>,
        hazards: Option<&Hazards>,
    ) -> Result<Self, AbstractionError> {
        let grid = problem.grid();
        let (lower, between, watched): (_, &[_], &[_]) = match hazards {
            None => (LowerBounds::OfNoise, &[], &[]),
            Some(hazards) => (LowerBounds::InsideWindows, &noise.between, hazards.watched()),
        };
        let origins = if placements.shared().is_some() { 1 } else { targets.len() };
        let mut budget = ConfidenceBudget::new(beta / Rational::from_integer(sweep.into()));
        let offsets = placements.offset_ranges(grid);
        let sides = 2 * watched.iter().filter(|&&watched| watched).count();
        let (goal, lost) = (ends.goal_events(), ends.lost_events());
        let levels = Levels::new(&mut budget, lower, sides, &offsets, origins, &goal, lost)?;

        let stack = Stack { last: &noise.samples, between, watched };
        let windows = Windows::new(stack, grid, placements.shared(), discard, &levels.windows);
        let unseen = |&unseen: &f64| round_decimal_up(unseen, DIGITS).min(1.0);
        let unseen: Vec<f64> = windows.unseen().iter().map(unseen).collect();
        let of_largest = unseen.first().copied().unwrap_or(1.0);
        if of_largest > MAX_UNSEEN {
            let samples = noise.samples.len() as u64;
            let needed = enough_samples(discard, levels.windows[0]);
            return Err(AbstractionError::TooFewSamples { samples, needed, unseen: of_largest });
        }
        Ok(Self { beta: to_f64(beta), sweep, budget, levels, ends, windows, unseen })
    }

    /// The windows.
    pub(in super::super) fn windows(&self) -> &Windows {
        &self.windows
    }

    /// How many samples bounds rest on.
    pub(super) fn sample_size(&self, samples: u64) -> SampleSize {
        let kept = self.unseen.iter().map(|&unseen| one_minus_down(unseen));
        let inside = || self.windows.inside().iter().copied().zip(kept).collect();
        let lower = self.levels.lower_bounds();
        SampleSize { number: samples, inside: (lower == LowerBounds::InsideWindows).then(inside) }
    }
}

/// The smallest number of samples with which less than half of the mass may be unseen.
fn enough_samples(discard: usize, level: f64) -> u64 {
    let enough = |samples: u64| {
        let left = samples.saturating_sub(shape_samples(samples as usize) as u64);
        left > discard as u64 && upper_bound(discard as u64, left, level) <= MAX_UNSEEN
    };
    let mut high = discard as u64 + 2;
    // At a level of 0, which doubles make of the tiniest budgets, no number is enough.
    while !enough(high) {
        if high > u64::from(u32::MAX) {
            return u64::MAX;
        }
        high *= 2;
    }
    let mut low = high / 2;
    while high - low > 1 {
        let middle = low + (high - low) / 2;
        if enough(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}
