//! What many runs came to.

use super::{End, RunOutcome, Violation};
use crate::statistics::{lower_bound, upper_bound};
use crate::task::Safety;
use serde::Serialize;

/// How often what happened.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Tally {
    /// The number of runs.
    pub runs: u64,
    /// Runs that met the goal region at a grouped instant and nothing unsafe at any original step before.
    pub satisfied: u64,
    /// Runs that met the goal region at a grouped instant and the unsafe region at no such instant before.
    pub satisfied_at_instants: u64,
    /// Runs that ended in a goal cell.
    pub reached: u64,
    /// Those of them that met nothing unsafe at any original step.
    pub reached_safely: u64,
    /// Runs that ended in a cell that meets the unsafe region.
    pub r#unsafe: u64,
    /// Runs that left the partition.
    pub outside: u64,
    /// Runs that ended in a cell without an enabled action.
    pub no_action: u64,
    /// Runs whose horizon passed.
    pub over: u64,
    /// Runs of an unbounded task that were given up.
    pub unfinished: u64,
    /// Unfinished runs that had not met the goal region before.
    pub open: u64,
    /// Runs that met something unsafe between grouped instants, before the goal.
    pub unsafe_between: u64,
    /// The number of grouped steps of all runs: as often the controller was asked.
    pub steps: u64,
    /// Inputs of one step that were outside `U`: 0, or there is a mistake in this program.
    pub violations: u64,
    /// The first of them.
    pub first_violation: Option<Violation>,
}

/// A relative frequency and the probabilities that it is compatible with.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Frequency {
    /// The relative frequency.
    pub frequency: f64,
    /// The lower end of the Clopper–Pearson interval.
    pub lower: f64,
    /// The upper end.
    pub upper: f64,
    /// The probability with which such an interval contains the true probability, at least.
    pub confidence: f64,
}

impl Tally {
    pub(super) fn add(&mut self, outcome: RunOutcome) {
        self.runs += 1;
        self.satisfied += u64::from(outcome.satisfied);
        self.satisfied_at_instants += u64::from(outcome.satisfied_at_instants);
        self.reached_safely += u64::from(outcome.end == End::Reached && !outcome.unsafe_between);
        let counter = match outcome.end {
            End::Reached => &mut self.reached,
            End::Unsafe => &mut self.r#unsafe,
            End::Outside => &mut self.outside,
            End::NoAction => &mut self.no_action,
            End::Over => &mut self.over,
            End::Unfinished => &mut self.unfinished,
        };
        *counter += 1;
        self.open += u64::from(outcome.end == End::Unfinished && !outcome.satisfied_at_instants);
        self.unsafe_between += u64::from(outcome.unsafe_between);
        self.steps += outcome.steps;
        self.violations += outcome.violations;
        if self.first_violation.is_none() {
            self.first_violation = outcome.first_violation;
        }
    }

    /// The runs of both, in any order.
    pub(super) fn merge(self, other: Self) -> Self {
        let first = [self.first_violation, other.first_violation].into_iter().flatten();
        Self {
            runs: self.runs + other.runs,
            satisfied: self.satisfied + other.satisfied,
            satisfied_at_instants: self.satisfied_at_instants + other.satisfied_at_instants,
            reached: self.reached + other.reached,
            reached_safely: self.reached_safely + other.reached_safely,
            r#unsafe: self.r#unsafe + other.r#unsafe,
            outside: self.outside + other.outside,
            no_action: self.no_action + other.no_action,
            over: self.over + other.over,
            unfinished: self.unfinished + other.unfinished,
            open: self.open + other.open,
            unsafe_between: self.unsafe_between + other.unsafe_between,
            steps: self.steps + other.steps,
            violations: self.violations + other.violations,
            first_violation: first.min_by_key(|violation| violation.run),
        }
    }

    /// How often the task was satisfied, in the true sets, safety being looked at as `safety` says.
    ///
    /// The two-sided Clopper–Pearson interval with confidence `1 − alpha`; a run that was given up may yet
    /// have succeeded, so it counts for the upper end.
    pub fn satisfaction(&self, safety: Safety, alpha: f64) -> Frequency {
        let satisfied = match safety {
            Safety::EveryStep => self.satisfied,
            Safety::GroupedInstants => self.satisfied_at_instants,
        };
        self.frequency(satisfied, self.open, alpha)
    }

    /// How often a goal cell was reached, as the abstraction counts.
    pub fn reaching(&self, safety: Safety, alpha: f64) -> Frequency {
        let reached = match safety {
            Safety::EveryStep => self.reached_safely,
            Safety::GroupedInstants => self.reached,
        };
        self.frequency(reached, self.unfinished, alpha)
    }

    fn frequency(&self, successes: u64, open: u64, alpha: f64) -> Frequency {
        Frequency {
            frequency: successes as f64 / self.runs as f64,
            lower: lower_bound(successes, self.runs, alpha / 2.0),
            upper: upper_bound(successes + open, self.runs, alpha / 2.0),
            confidence: 1.0 - alpha,
        }
    }
}

impl Frequency {
    /// Whether no probability of at least `bound` is compatible with what was seen.
    pub fn contradicts(&self, bound: f64) -> bool {
        self.upper < bound
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outcome(end: End, satisfied: bool) -> RunOutcome {
        RunOutcome {
            end,
            satisfied,
            satisfied_at_instants: satisfied,
            unsafe_between: false,
            steps: 3,
            violations: 0,
            first_violation: None,
        }
    }

    #[test]
    fn a_contradiction_needs_evidence() {
        let tally = |good: u64, bad: u64| {
            let mut tally = Tally::default();
            (0..good).for_each(|_| tally.add(outcome(End::Reached, true)));
            (0..bad).for_each(|_| tally.add(outcome(End::Over, false)));
            tally
        };
        assert!(!tally(89, 11).satisfaction(Safety::EveryStep, 0.01).contradicts(0.95));
        assert!(tally(890, 110).satisfaction(Safety::EveryStep, 0.01).contradicts(0.95));
        assert!(!tally(890, 110).satisfaction(Safety::EveryStep, 0.01).contradicts(0.90));
    }

    #[test]
    fn runs_that_were_given_up_contradict_nothing() {
        let mut tally = Tally::default();
        (0..1000).for_each(|_| tally.add(outcome(End::Unfinished, false)));
        let frequency = tally.satisfaction(Safety::EveryStep, 0.01);
        assert_eq!((frequency.frequency, frequency.lower, frequency.upper), (0.0, 0.0, 1.0));
        assert!(!frequency.contradicts(1.0));
    }
}
