//! Expected rewards of a number of steps, and discounted ones.

use super::super::bounded::{CHANGE_BYTES, indicator};
use super::super::evidence::{Recorder, unlike};
use super::super::expectation::Bound;
use super::super::options::Control;
use super::super::query::{Direction, Players};
use super::super::{Policy, Solution, SolveError, SolverOptions, Status, ValueBounds};
use super::costs;
use super::operator::{Operator, discounted};
use crate::certificate::{Evidence, RewardInductive};
use crate::model::{GrowingMemory, IntervalMdp, RewardStructure, StateId};

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
    let mut control = Control::of(options, steps);
    let mut recorder = (options.evidence && steps.is_some()).then(|| Recorder::new(model.num_states()));
    let mut changes = vec![];
    let mut memory = GrowingMemory::new("the policy");
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
        let bytes = |changes: usize| CHANGE_BYTES * changes as u64;
        memory.make_room(bytes(changes.len()), bytes(iteration.operator.states.len()))?;
        let chosen = iteration.both(&mut lower, &mut upper, discount, &mut recorder)?;
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
    let evidence = match recorder {
        Some(recorder) if status == Status::HorizonReached => {
            Some(Evidence::RewardSteps(recorder.finish(&changes)))
        }
        Some(_) => None,
        None if options.evidence => iteration.settle(&mut lower, &mut upper, discount),
        None => None,
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
        evidence,
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
) -> Result<Solution, SolveError> {
    let mut iteration = Iteration::new(model, None, players);
    let values = |side| (0..model.num_states()).map(|s| costs::written(rewards.of_state(s), side)).collect();
    let (mut lower, mut upper): (Vec<f64>, Vec<f64>) = (values(Bound::Lower), values(Bound::Upper));
    let mut control = Control::of(options, Some(step));
    let mut status = Status::HorizonReached;
    let mut recorder = options.evidence.then(|| Recorder::new(model.num_states()));
    let mut changes = vec![];
    while control.iterations < step {
        if let Some(reason) = control.stop() {
            status = reason;
            lower.fill(0.0);
            upper.fill(f64::INFINITY);
            break;
        }
        let chosen = iteration.both(&mut lower, &mut upper, 1.0, &mut recorder)?;
        if recorder.is_some() {
            let states = iteration.operator.states.iter().zip(chosen);
            changes.extend(states.map(|(&s, choice)| (s, control.iterations + 1, choice)));
        }
        control.done(0.0);
    }
    let recorder = recorder.filter(|_| status == Status::HorizonReached);
    Ok(Solution {
        values: ValueBounds { lower, upper },
        status,
        iterations: control.iterations,
        policy: None,
        evidence: recorder.map(|recorder| Evidence::RewardSteps(recorder.finish(&changes))),
        history: vec![],
    })
}

/// How often bounds are moved until a step improves them.
const MOVES: usize = 64;

struct Iteration<'a> {
    model: &'a IntervalMdp,
    maximises: bool,
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
        Self { model, maximises: players.policy == Direction::Max, operator, staying }
    }

    fn zero(&self) -> Vec<f64> {
        let none = crate::model::StateSet::with_capacity(self.model.num_states());
        indicator(&none)
    }

    fn largest(&self) -> f64 {
        let of_staying = self.staying.iter().map(|(_, earned)| earned[1]).fold(0.0, f64::max);
        self.operator.largest_cost().max(of_staying)
    }

    /// One step of both bounds, which is recorded; returns the choices of the side that the policy has to make true.
    fn both(
        &mut self,
        lower: &mut [f64],
        upper: &mut [f64],
        discount: f64,
        recorder: &mut Option<Recorder>,
    ) -> Result<Vec<u32>, SolveError> {
        let before = recorder.is_some().then(|| (lower.to_vec(), upper.to_vec()));
        let of_lower = self.step(lower, discount, Bound::Lower);
        let of_upper = self.step(upper, discount, Bound::Upper);
        if let (Some(recorder), Some((old_lower, old_upper))) = (recorder.as_mut(), before) {
            recorder.begin()?;
            for state in StateId::first(lower.len()) {
                let s = state.index();
                if lower[s] != old_lower[s] {
                    recorder.lower(state, lower[s]);
                }
                if upper[s] != old_upper[s] {
                    recorder.upper(state, upper[s]);
                }
            }
            recorder.end();
        }
        Ok(if self.maximises { of_lower } else { of_upper })
    }

    /// Makes bounds for ever such that a step improves them, as a proof of them needs: steps round, and bounds that a step
    /// spoils by `e` are moved by `e/(1 − γ)`.
    fn settle(&mut self, lower: &mut [f64], upper: &mut [f64], discount: f64) -> Option<Evidence> {
        let room = 1.0 - discount.next_up();
        let mut chosen = vec![];
        for side in [Bound::Lower, Bound::Upper] {
            let values: &mut [f64] = if side == Bound::Lower { lower } else { upper };
            let sign = if side == Bound::Lower { 1.0 } else { -1.0 };
            let mut moved = f64::MIN_POSITIVE;
            // A few rounds, for moving them rounds as well.
            for _ in 0..MOVES {
                let mut next = values.to_vec();
                let choices = self.step(&mut next, discount, side);
                let spoilt = values.iter().zip(&next).map(|(v, n)| sign * (v - n)).fold(0.0, f64::max);
                if spoilt <= 0.0 {
                    if self.maximises == (side == Bound::Lower) {
                        chosen = choices;
                    }
                    moved = 0.0;
                    break;
                }
                moved = moved.max(2.0 * spoilt / room);
                values.iter_mut().for_each(|value| *value = (*value - sign * moved).max(0.0));
            }
            if moved > 0.0 {
                return None;
            }
        }
        let all = || 0..lower.len();
        Some(Evidence::RewardInductive(RewardInductive {
            choices: self.operator.states.iter().copied().zip(chosen).collect(),
            lower: unlike(lower, all(), 0.0),
            upper: unlike(upper, all(), f64::INFINITY),
            missed: vec![],
        }))
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
