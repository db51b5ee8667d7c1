//! What choices earn, rounded in a known direction.

use super::super::expectation::Bound;
use crate::model::{RewardStructure, StateId};

/// Sums are integers below this: no rounding is needed.
const EXACT: f64 = (1u64 << 53) as f64;

/// The sum of two numbers of at least 0, at most or at least the exact one, whichever decimals the doubles stand for.
pub(super) fn sum(a: f64, b: f64, side: Bound) -> f64 {
    match (a, b) {
        (0.0, x) | (x, 0.0) => x,
        _ => {
            let sum = a + b;
            match side {
                Bound::Lower => sum.next_down(),
                Bound::Upper => sum.next_up(),
            }
        }
    }
}

/// A reward as it was written: the double nearest to it, or the next one.
pub(super) fn written(value: f64, side: Bound) -> f64 {
    match side {
        _ if value.fract() == 0.0 && value < EXACT => value,
        Bound::Lower => value.next_down().max(0.0),
        Bound::Upper => value.next_up(),
    }
}

/// What a choice earns in a state, whatever comes of it.
pub(super) fn of_choice(rewards: &RewardStructure, state: StateId, choice: u64, side: Bound) -> f64 {
    let (state, choice) = (rewards.of_state(state.index()), rewards.of_choice(choice));
    let exact = state.fract() == 0.0 && choice.fract() == 0.0 && state + choice < EXACT;
    if exact { state + choice } else { sum(written(state, side), written(choice, side), side) }
}
