//! Robust value iteration.
//!
//! The value of `safe U goal` in an interval MDP is the least solution of
//!
//! `V(s) = 1` in goal states, `V(s) = opt_a opt_p p·V` in other safe states, `V(s) = 0` elsewhere,
//!
//! where the policy picks a choice `a` and nature a distribution `p` within the intervals of its row.
//! States without rows stay where they are. [`solve`] brackets it from both sides, for all four ways of
//! resolving the two nondeterminisms, with and without a bound on the number of steps:
//!
//! - with a bound, by that many steps rounded down and up (`bounded`);
//! - without, by deciding exactly where the value is 0 or 1 (`graph`), then part by part from below, and
//!   from above by values that the operator does not raise (`unbounded`), and by linear equations where that is
//!   too slow (`slow`).
//!
//! Where a threshold lies between the bounds, the values that decide it are computed exactly, if they are not too long (`exact`);
//! thresholds 0 and 1 are decided by the graph of the model (`extremes`).
//!
//! Bounds of rows are read as the shortest decimals that give the doubles, or as what stands beside them. Without a step bound the value
//! can jump with the last digit (whether upper bounds sum to 1 decides whether nature can stay for ever),
//! so there the decimals are the model; step-bounded results hold for the doubles taken literally as well.
//!
//! Both bounds hold whenever and however the computation ends; [`Status`] tells how it ended.

mod answer;
mod bounded;
mod component;
mod delay;
mod evidence;
mod exact;
mod expectation;
mod extrapolate;
mod extremes;
mod graph;
mod guess;
mod history;
mod omega;
mod options;
mod policy;
mod prune;
mod query;
mod range_optimum;
mod reward;
mod shared;
mod slow;
mod solution;
mod sweep;
mod unbounded;
mod working_memory;

pub use answer::{Answer, AnswerError};
pub use delay::solve_delayed;
pub use exact::Inexact;
pub(crate) use exact::exact_values;
pub use expectation::worst_expectations;
pub(crate) use extremes::Extremes;
pub(crate) use graph::strong_components;
pub(crate) use omega::{Acceptance, accepting_states};
pub use options::{Control, SolverOptions, Status};
pub use policy::{NO_CHOICE, Policy};
pub use prune::{PruneError, Pruned};
pub use query::{Event, SolveError};
pub use reward::{RewardQuery, solve_rewards};
pub use solution::{Solution, ValueBounds};

use crate::model::IntervalMdp;
use crate::property::Resolution;

/// Bounds on the value of a query in every state.
///
/// # Errors
/// [`SolveError`] if a set does not fit the model, `epsilon` is not positive or memory is short. How a computation ended
/// is not an error but the [`Status`] of the solution.
pub fn solve(
    model: &IntervalMdp,
    query: &Event<'_>,
    resolution: Resolution,
    options: &SolverOptions<'_>,
) -> Result<Solution, SolveError> {
    solve_for(model, query, resolution.into(), options)
}

fn solve_for(
    model: &IntervalMdp,
    query: &Event<'_>,
    players: query::Players,
    options: &SolverOptions<'_>,
) -> Result<Solution, SolveError> {
    query.check(model)?;
    let epsilon = options.epsilon;
    if epsilon.is_nan() || epsilon <= 0.0 {
        return Err(SolveError::Epsilon { epsilon });
    }
    working_memory::require_working_memory(model)?;
    match *query {
        Event::Next { goal } => bounded::next(model, goal, players, options),
        Event::Until { safe, goal, steps: Some(steps) } => {
            bounded::until(model, (safe, goal, steps), players, options)
        }
        Event::Until { safe, goal, steps: None } => unbounded::until(model, safe, goal, players, options),
    }
}
