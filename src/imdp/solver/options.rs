//! When to stop, and how it was stopped.

use crate::progress::Progress;
use crate::ranks;
use std::fmt;
use std::time::{Duration, Instant};

/// When a computation stops and what it reports meanwhile; threads are those of the ambient rayon pool.
#[derive(Clone, Copy)]
pub struct SolverOptions<'a> {
    /// Unbounded queries stop when `upper − lower ≤ epsilon` in every state.
    pub epsilon: f64,
    /// The number of iterations allowed, all parts of the model together.
    pub max_iterations: u64,
    /// The time allowed, if limited.
    pub time_limit: Option<Duration>,
    /// Stops the computation when it is interrupted, and is told after every iteration how far the bounds are apart (for
    /// unbounded queries: in the part of the model being solved, 1 before its first upper bound).
    pub progress: &'a dyn Progress,
    /// Whether a policy is wanted.
    pub policy: bool,
    /// Bounded queries: whether bounds from above are wanted; without them, they are 1.
    pub upper: bool,
    /// Bounded queries: of how many earlier numbers of steps the bounds that the policy guarantees are wanted too.
    pub history: usize,
    /// Whether what a certificate needs is wanted, which includes the policy.
    pub evidence: bool,
    /// How much work may be spent on exact arithmetic where a threshold lies between the bounds, in multiplications of
    /// 64 binary digits.
    pub exact_work: u64,
}

impl Default for SolverOptions<'_> {
    fn default() -> Self {
        Self {
            epsilon: 1e-6,
            max_iterations: u64::MAX,
            time_limit: None,
            progress: &(),
            policy: false,
            upper: true,
            history: 0,
            evidence: false,
            // About a second.
            exact_work: 1 << 28,
        }
    }
}

/// How a computation ended. The bounds are sound in every case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    /// All steps of a bounded query were taken, or no further step changes anything.
    HorizonReached,
    /// `upper − lower ≤ epsilon` in every state.
    Converged,
    /// Doubles are too coarse for this model and epsilon: the bounds no longer move.
    PrecisionLimit,
    /// The allowed number of iterations was used up.
    IterationLimit,
    /// The allowed time was used up.
    TimeLimit,
    /// The user wanted it to end.
    Interrupted,
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::HorizonReached => "horizon reached",
            Self::Converged => "converged",
            Self::PrecisionLimit => "precision limit",
            Self::IterationLimit => "iteration limit",
            Self::TimeLimit => "time limit",
            Self::Interrupted => "interrupted",
        })
    }
}

/// Why a computation may be told to stop, the strongest reason last.
const REASONS: [Status; 3] = [Status::TimeLimit, Status::IterationLimit, Status::Interrupted];

/// Counts iterations and says when to stop.
pub struct Control<'a> {
    options: &'a SolverOptions<'a>,
    start: Instant,
    /// The number of iterations there will be at most, if that is known.
    of: Option<u64>,
    /// The number of iterations done.
    pub iterations: u64,
}

impl<'a> Control<'a> {
    /// The clock starts now.
    pub fn new(options: &'a SolverOptions<'a>) -> Self {
        Self { options, start: Instant::now(), of: None, iterations: 0 }
    }

    /// The same, for a computation of so many iterations if that is known.
    pub fn of(options: &'a SolverOptions<'a>, iterations: Option<u64>) -> Self {
        Self { of: iterations, ..Self::new(options) }
    }

    /// What is asked for.
    pub fn options(&self) -> &'a SolverOptions<'a> {
        self.options
    }

    /// Why to stop now, if so; processes that share their work stop together.
    pub fn stop(&self) -> Option<Status> {
        let own = self.own_reason();
        let number =
            |reason: Status| REASONS.iter().position(|&other| other == reason).map_or(0, |place| place + 1);
        let agreed = ranks::greatest(own.map_or(0, number) as u8);
        REASONS.get(usize::from(agreed).wrapping_sub(1)).copied()
    }

    fn own_reason(&self) -> Option<Status> {
        if self.options.progress.is_interrupted() {
            Some(Status::Interrupted)
        } else if self.iterations >= self.options.max_iterations {
            Some(Status::IterationLimit)
        } else if self.options.time_limit.is_some_and(|limit| self.start.elapsed() >= limit) {
            Some(Status::TimeLimit)
        } else {
            None
        }
    }

    /// Notes that an iteration is done.
    pub fn done(&mut self, gap: f64) {
        self.iterations += 1;
        self.options.progress.iterate(self.iterations, self.of, gap);
    }
}
