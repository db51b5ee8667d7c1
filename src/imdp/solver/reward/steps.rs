//! Expected rewards of a number of steps, and discounted ones.

use super::super::bounded::indicator;
use super::super::expectation::Bound;
use super::super::options::Control;
use super::super::query::Players;
use super::super::{Policy, Solution, SolveError, SolverOptions, Status, ValueBounds};
use super::costs;
use super::operator::{Operator, discounted};
use crate::model::{IntervalMdp, RewardStructure, StateId};

/// The value of the rewards of so many steps, or of all.
pub(super) fn cumulative(
    model: &IntervalMdp,
    rewards: &RewardStructure,
    (steps, discount): (Option<u64>, f64),
    players: Players,
    options: &SolverOptions<'_>,
) -> Result<Solution, SolveError> {
    // Written so that NaN fails.
    if !(0.0..=1.0).contains(&discount) || (steps.is_none() && discount == 1.0) {
        return Err(SolveError::Undiscounted);
    }
    let mut iteration = Iteration::new(model, Some(rewards), players);
    let mut upper = iteration.zero();
    let mut lower = upper.clone();
    if steps.is_none() {
        // What is left from some time on is at most this; the factor is below 1 however it was written.
        let most = iteration.largest() / (1.0 - discount.next_up()).max(f64::MIN_POSITIVE);
        upper.fill(most.next_up().next_up().min(f64::MAX));
    }
    let mut control = Control::new(options);
    let mut changes = vec![];
    let mut current = vec![u32::MAX; model.num_states()];
    let status = loop {
        if steps.is_some_and(|steps| control.iterations >= steps) {
            break Status::HorizonReached;
        }
        if let Some(reason) = control.stop() {
            if steps.is_some() {
                upper.fill(f64::INFINITY);
            }
            break reason;
        }
        let chosen = iteration.step(&mut lower, discount, Bound::Lower);
        iteration.step(&mut upper, discount, Bound::Upper);
        for (&s, choice) in iteration.operator.states.iter().zip(chosen) {
            if current[s.index()] != choice {
                current[s.index()] = choice;
                changes.push((s, control.iterations + 1, choice));
            }
        }
        let gap = lower.iter().zip(&upper).map(|(l, u)| (u - l) / l.max(1.0)).fold(0.0, f64::max);
        control.done(gap);
        if steps.is_none() && gap <= options.epsilon {
            break Status::Converged;
        }
    };
    let policy = match steps {
        _ if !options.policy => None,
        Some(steps) => Some(Policy::time_varying(steps, model.num_states(), &changes)),
        None => Some(Policy::stationary(&current)),
    };
    Ok(Solution {
        values: ValueBounds { lower, upper },
        status,
        iterations: control.iterations,
        policy,
        evidence: None,
        history: vec![],
    })
}

/// The value of the reward of the state after so many steps.
pub(super) fn instantaneous(
    model: &IntervalMdp,
    rewards: &RewardStructure,
    step: u64,
    players: Players,
    options: &SolverOptions<'_>,
) -> Solution {
    let mut iteration = Iteration::new(model, None, players);
    let values = |side| (0..model.num_states()).map(|s| costs::written(rewards.of_state(s), side)).collect();
    let (mut lower, mut upper): (Vec<f64>, Vec<f64>) = (values(Bound::Lower), values(Bound::Upper));
    let mut control = Control::new(options);
    let mut status = Status::HorizonReached;
    while control.iterations < step {
        if let Some(reason) = control.stop() {
            status = reason;
            lower.fill(0.0);
            upper.fill(f64::INFINITY);
            break;
        }
        iteration.step(&mut lower, 1.0, Bound::Lower);
        iteration.step(&mut upper, 1.0, Bound::Upper);
        control.done(0.0);
    }
    Solution {
        values: ValueBounds { lower, upper },
        status,
        iterations: control.iterations,
        policy: None,
        evidence: None,
        history: vec![],
    }
}

struct Iteration<'a> {
    model: &'a IntervalMdp,
    operator: Operator,
    /// States that stay where they are, and what they earn in every step, from below and from above.
    staying: Vec<(StateId, [f64; 2])>,
}

impl<'a> Iteration<'a> {
    fn new(model: &'a IntervalMdp, rewards: Option<&'a RewardStructure>, players: Players) -> Self {
        let moves = |s: &StateId| !model.choices().ranges(*s).is_empty();
        let all = StateId::first(model.num_states());
        let (states, staying): (Vec<StateId>, Vec<StateId>) = all.partition(moves);
        let nothing = RewardStructure::default();
        let operator =
            Operator::new(model, Some(rewards.unwrap_or(&nothing)), players, states, (&|_| true, &|_| true));
        let first_choices = model.choices().first_choices();
        let of_state = |s: StateId| {
            let earned = |side| match (rewards, model.choices().is_absorbing(s)) {
                (None, _) => 0.0,
                (Some(rewards), true) => costs::of_choice(rewards, s, first_choices[s.index()], side),
                // Without a choice only the state earns something.
                (Some(rewards), false) => costs::written(rewards.of_state(s.index()), side),
            };
            (s, [Bound::Lower, Bound::Upper].map(earned))
        };
        let staying = staying.into_iter().map(of_state).collect();
        Self { model, operator, staying }
    }

    fn zero(&self) -> Vec<f64> {
        let none = crate::model::StateSet::with_capacity(self.model.num_states());
        indicator(&none)
    }

    fn largest(&self) -> f64 {
        let of_staying = self.staying.iter().map(|(_, earned)| earned[1]).fold(0.0, f64::max);
        self.operator.largest_cost().max(of_staying)
    }

    /// One step; returns the choices made.
    fn step(&mut self, values: &mut [f64], discount: f64, side: Bound) -> Vec<u32> {
        let (results, chosen) = self.operator.apply(values, discount, side);
        for (s, earned) in &self.staying {
            let value = &mut values[s.index()];
            *value = costs::sum(
                earned[usize::from(side == Bound::Upper)],
                discounted(*value, discount, side),
                side,
            );
        }
        self.operator.states.iter().zip(results).for_each(|(&s, value)| values[s.index()] = value);
        chosen
    }
}
