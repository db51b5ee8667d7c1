//! Exact values put in the place of bounds: in the solution, its policy and what proves it.

use super::super::graph::ranks;
use super::super::policy::NO_CHOICE;
use super::super::query::Players;
use super::super::{Event, Policy, Solution, SolverOptions};
use super::iterate::Level;
use super::{ExactSolution, Inexact, Record};
use crate::certificate::{Evidence, Inductive, Step};
use crate::exact::Replaced;
use crate::model::{IntervalMdp, StateId, StateSet};
use crate::numeric::{Rational, to_f64_down, to_f64_up};
use std::collections::BTreeMap;

/// Makes a solution exact in the wanted states, and in all that can be reached from them; returns the values of those wanted.
pub(in crate::solver) fn settle(
    model: &IntervalMdp,
    event: &Event<'_>,
    players: Players,
    (solution, wanted): (&mut Solution, &StateSet),
    options: &SolverOptions<'_>,
) -> Result<BTreeMap<StateId, Rational>, Inexact> {
    let exact = ExactSolution::new(model, event, players, wanted, options)?;
    for (&state, value) in exact.part.states.iter().zip(&exact.values) {
        solution.values.lower[state.index()] = to_f64_down(value);
        solution.values.upper[state.index()] = to_f64_up(value);
    }
    match &exact.record {
        Record::Steps(levels) => {
            solution.policy = solution.policy.take().map(|policy| exact.policy(&policy, levels));
            if let Some(Evidence::Steps(steps)) = &mut solution.evidence {
                exact.prove_steps(steps, levels, event);
            }
        }
        Record::Choices(choices) => {
            let chosen = || exact.part.states.iter().copied().zip(choices.iter().copied());
            solution.policy = solution.policy.take().map(|policy| {
                let mut table = vec![NO_CHOICE; model.num_states()];
                StateId::first(model.num_states())
                    .zip(&mut table)
                    .for_each(|(s, choice)| *choice = policy.choice(s, 0).unwrap_or(NO_CHOICE));
                chosen().for_each(|(s, choice)| table[s.index()] = choice);
                Policy::stationary(&table)
            });
            if let Some(Evidence::Inductive(inductive)) = &mut solution.evidence {
                replace(&mut inductive.choices, &exact.part.states, chosen());
                exact.prove_inductive(inductive, model, players);
            }
        }
    }
    Ok(exact.values_of(wanted))
}

impl ExactSolution {
    /// The policy with the choices of these levels in the states of the part.
    fn policy(&self, policy: &Policy, levels: &[Level]) -> Policy {
        let mut list = vec![];
        for state in StateId::first(policy.num_states()) {
            match self.part.position(state) {
                None => {
                    list.extend(policy.changes(state).iter().map(|&(left, choice)| (state, left, choice)))
                }
                Some(position) => list.extend(
                    changes(levels, |level| level.choices[position])
                        .map(|(left, choice)| (state, left, choice)),
                ),
            }
        }
        Policy::time_varying(policy.horizon().unwrap_or(0), policy.num_states(), &list)
    }

    /// Replaces what is said about the states of the part, step by step.
    fn prove_steps(&self, steps: &mut Vec<Step>, levels: &[Level], event: &Event<'_>) {
        let states = &self.part.states;
        for step in steps.iter_mut() {
            replace(&mut step.choices, states, std::iter::empty());
            replace(&mut step.lower, states, std::iter::empty());
            replace(&mut step.upper, states, std::iter::empty());
        }
        if steps.len() < levels.len() {
            steps.resize(levels.len(), Step::default());
        }
        let goal = match event {
            Event::Until { goal, .. } | Event::Next { goal } => *goal,
        };
        let start = |&s: &StateId| Rational::from_integer(u8::from(goal.contains(s.index())).into());
        let mut before: Vec<Rational> = states.iter().map(start).collect();
        let mut choices = vec![NO_CHOICE; states.len()];
        for (step, level) in steps.iter_mut().zip(levels) {
            let values = level.rationals(states.len());
            let new = |i: &usize| values[*i] != before[*i];
            let changed: Vec<_> =
                (0..states.len()).filter(new).map(|i| (states[i], values[i].clone())).collect();
            let differs = |i: &usize| level.choices[*i] != choices[*i];
            let chosen: Vec<_> =
                (0..states.len()).filter(differs).map(|i| (states[i], level.choices[i])).collect();
            replace(&mut step.choices, &[], chosen.into_iter());
            step.exact_lower.clone_from(&changed);
            step.exact_upper = changed;
            (before, choices) = (values, level.choices.clone());
        }
    }

    /// Replaces what is said about the states of the part; ranks follow from everything that is said.
    fn prove_inductive(&self, inductive: &mut Inductive, model: &IntervalMdp, players: Players) {
        let states = &self.part.states;
        let exact = || states.iter().copied().zip(self.values.iter().cloned());
        replace(&mut inductive.lower, states, std::iter::empty());
        replace(&mut inductive.upper, states, std::iter::empty());
        replace(&mut inductive.exact_lower, states, exact());
        replace(&mut inductive.exact_upper, states, exact());
        let mut lower = vec![0.0; model.num_states()];
        self.ones.ones().for_each(|s| lower[s] = 1.0);
        inductive.lower.iter().for_each(|&(s, value)| lower[s.index()] = value);
        inductive.exact_lower.iter().for_each(|(s, value)| lower[s.index()] = to_f64_down(value));
        let mut choices = vec![NO_CHOICE; model.num_states()];
        inductive.choices.iter().for_each(|&(s, choice)| choices[s.index()] = choice);
        // Whoever can move has a choice.
        let mut moving = StateSet::with_capacity(model.num_states());
        inductive.choices.iter().for_each(|&(s, _)| moving.insert(s.index()));
        let replaced: Replaced = inductive.exact_lower.iter().cloned().collect();
        inductive.ranks = ranks(model, &moving, players, &lower, &replaced, &choices);
    }
}

/// What changes from level to level, with the number of steps left.
fn changes(levels: &[Level], of: impl Fn(&Level) -> u32) -> impl Iterator<Item = (u64, u32)> {
    let mut before = NO_CHOICE;
    let mut list = vec![];
    for (left, level) in (1..).zip(levels) {
        if std::mem::replace(&mut before, of(level)) != of(level) {
            list.push((left, of(level)));
        }
    }
    list.into_iter()
}

/// Takes states, given ascending, out of a list and puts items into it; both stay ascending.
fn replace<T>(list: &mut Vec<(StateId, T)>, states: &[StateId], items: impl Iterator<Item = (StateId, T)>) {
    list.retain(|(state, _)| states.binary_search(state).is_err());
    list.extend(items);
    list.sort_by_key(|entry| entry.0);
}
