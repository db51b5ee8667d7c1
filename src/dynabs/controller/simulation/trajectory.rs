//! Runs written down step by step.

use super::RunOutcome;
use super::runs::{Moment, Simulation};
use crate::controller::Decision;
use imdp::progress::Progress;

/// One simulated run.
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    /// The number of the run.
    pub run: u64,
    /// Every original step, and the state at the end.
    pub steps: Vec<TrajectoryStep>,
    /// What it came to.
    pub outcome: RunOutcome,
}

/// One original step of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct TrajectoryStep {
    /// The number of original steps before it.
    pub step: u64,
    /// The state, `n` numbers.
    pub state: Vec<f64>,
    /// The input applied there, `p` numbers; none at the end.
    pub input: Option<Vec<f64>>,
    /// What the controller decided; none between grouped instants.
    pub decision: Option<Decision>,
}

impl Simulation<'_> {
    /// Run number `run` from `start`, step by step: the one that [`run`](Self::run) and
    /// [`tally`](Self::tally) count under this number and seed.
    pub fn trajectory(&self, start: &[f64], seed: u64, run: u64) -> Trajectory {
        self.trajectory_until(start, (seed, run), &())
    }

    /// The same for a seed and the number of a run; it ends early, unfinished, when `progress` is interrupted.
    pub fn trajectory_until(
        &self,
        start: &[f64],
        (seed, run): (u64, u64),
        progress: &dyn Progress,
    ) -> Trajectory {
        let mut steps = Vec::new();
        let outcome = self.watch_until(start, (seed, run), progress, |Moment { step, x, u, decision }| {
            let (state, input) = (x.to_vec(), u.map(<[f64]>::to_vec));
            steps.push(TrajectoryStep { step, state, input, decision });
        });
        Trajectory { run, steps, outcome }
    }
}
