//! Expected rewards.
//!
//! **Until a goal.** The value of a state is `opt_a opt_p E(rewards before the goal)`, runs that never meet the goal counting
//! as infinite. It is finite exactly where those who minimise it can make sure that the goal is met with probability 1, which
//! is decided as for probabilities (`graph`). There, with `r` the rewards of a choice and `T(V)(s) = opt_a opt_p (r + p·V)`:
//!
//! - *lower*: any bounded `L ≤ T(L)` with `L = 0` in the goal is a lower bound. For whatever the minimising players do, either
//!   the goal is missed with positive probability and the value is infinite, or it is met almost surely, `L` plus the
//!   rewards so far is a submartingale, and what is left of `L` vanishes.
//! - *upper*: if `U > T(U)` in every state, then `U` is an upper bound. The players who attain `T(U)` lose at least the
//!   smallest difference of `U` in every step, so the goal is met in finite expected time. (`U ≥ T(U)` is not enough: where
//!   nothing is earned in a cycle, it could go round for ever.) From an upper bound, `T` leads to another.
//!
//! A first upper bound comes from the expected number of steps: let `w` be such that `1 + opt p·w ≤ w`, and `M` the largest
//! reward of a choice; then `M w` is one. From above the values converge to the right ones even where a cycle earns nothing,
//! which those from below may not.
//!
//! **A number of steps, discounted.** `V_0 = 0`, `V_{k+1} = opt_a opt_p (r + γ p·V_k)`; without a last step, iteration from 0
//! and from `M/(1−γ)` encloses the value.

mod costs;
mod operator;
mod reach;
mod steps;

use super::query::Players;
use super::{Solution, SolveError, SolverOptions};
use crate::model::{IntervalMdp, RewardStructure, StateSet};
use crate::property::Resolution;

/// Which rewards count.
#[derive(Clone, Debug)]
pub enum RewardQuery<'a> {
    /// Those before a goal state is met.
    Reach(&'a StateSet),
    /// Those of so many steps, or of all steps if discounted by a factor below 1.
    Cumulative {
        /// The number of steps, if bounded.
        steps: Option<u64>,
        /// What the rewards of the next step are worth today; 1 if nothing is said.
        discount: f64,
    },
    /// That of the state after so many steps.
    Instantaneous(u64),
}

/// Bounds on an expected reward in every state; they may be infinite.
///
/// # Errors
/// [`SolveError`] if the goal does not fit the model, if all rewards are to be summed up undiscounted, or if `epsilon` is not
/// positive.
pub fn solve_rewards(
    model: &IntervalMdp,
    rewards: &RewardStructure,
    query: &RewardQuery<'_>,
    resolution: Resolution,
    options: &SolverOptions<'_>,
) -> Result<Solution, SolveError> {
    let (epsilon, players) = (options.epsilon, Players::from(resolution));
    if epsilon.is_nan() || epsilon <= 0.0 {
        return Err(SolveError::Epsilon { epsilon });
    }
    match *query {
        RewardQuery::Reach(goal) if goal.len() != model.num_states() => {
            Err(SolveError::Length { what: "goal", found: goal.len(), states: model.num_states() })
        }
        RewardQuery::Reach(goal) => reach::reach(model, rewards, goal, players, options),
        RewardQuery::Cumulative { steps, discount } => {
            steps::cumulative(model, rewards, (steps, discount), players, options)
        }
        RewardQuery::Instantaneous(step) => steps::instantaneous(model, rewards, step, players, options),
    }
}
