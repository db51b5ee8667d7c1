//! Values in exact arithmetic, where a threshold lies between the bounds.
//!
//! **Bounded.** Value iteration on what can be reached, over one denominator: with `S` the common denominator of all
//! bounds of rows, the values with `k` steps left are natural numbers over `D Sᵏ` (`iterate`).
//!
//! **Unbounded.** Where the value is 0 or 1 is known (`graph`). Elsewhere strategies of both sides are improved until
//! neither can do better, their values being the solution of linear equations (`strategies`). The result `x` is then
//! checked: `T(x) = x`, so that it is at least the value, the least fixed point; and under the strategies of the maximising
//! sides everything else is left almost surely, whatever the minimising ones do, so that it is at most the value (the proof
//! is told in [`crate::verify`]).
//!
//! Numbers grow with every step and state, so the work is limited: beyond the limit there is no exact value.

mod iterate;
mod part;
mod settle;
mod strategies;
mod work;

pub(super) use settle::settle;
pub use work::Inexact;

use super::graph::zero_one;
use super::query::Players;
use super::{Event, SolverOptions};
use crate::model::{IntervalMdp, StateId, StateSet};
use crate::numeric::Rational;
use crate::property::Resolution;
use iterate::Level;
use num_traits::{One, Zero};
use part::Part;
use std::collections::BTreeMap;
use work::Work;

/// Exact values, and how they come about.
pub(super) struct ExactSolution {
    /// What can be reached.
    part: Part,
    /// The values of the part's states.
    values: Vec<Rational>,
    /// The states outside of the part whose value is 1; all others have 0.
    ones: StateSet,
    record: Record,
}

/// What proves exact values.
enum Record {
    /// With 1, 2, … steps left, if wanted.
    Steps(Vec<Level>),
    /// By state of the part, what the policy chooses.
    Choices(Vec<u32>),
}

/// The exact values in these states of an event that begins after so many steps in safe states.
pub(crate) fn exact_values(
    model: &IntervalMdp,
    event: &Event<'_>,
    first: u64,
    resolution: Resolution,
    wanted: &StateSet,
    options: &SolverOptions<'_>,
) -> Result<BTreeMap<usize, Rational>, Inexact> {
    let plain = SolverOptions { policy: false, evidence: false, ..*options };
    let values = match *event {
        Event::Until { safe, .. } if first > 0 => {
            let mut work = Work::new(&plain);
            let mut moving = safe.clone();
            let has_rows = |s: &usize| !model.choices().ranges(StateId::from_index(*s)).is_empty();
            (0..model.num_states()).filter(|s| !has_rows(s)).for_each(|s| moving.set(s, false));
            let part = Part::new(model, &moving, wanted, &mut work)?;
            let mut reached = StateSet::with_capacity(model.num_states());
            part.all().for_each(|s| reached.insert(s.index()));
            reached.union_with(wanted);
            let later = ExactSolution::new(model, event, resolution.into(), &reached, &plain)?;
            let mut values = later.values_of(&reached);
            let start = part.all().map(|s| values.get(&s).cloned().unwrap_or_default()).collect();
            let mut wait = |start, steps| {
                let after = iterate::iterate(&part, start, steps, resolution.into(), false, &mut work)?;
                Ok(after.0)
            };
            let mut last = wait(Level::of_rationals(start), 1)?;
            // Where it is not safe to wait nothing can come of it.
            values.iter_mut().filter(|(s, _)| !safe.contains(s.index())).for_each(|(_, v)| v.set_zero());
            last.lose_outside(&part, |state| !safe.contains(state.index()));
            let last = wait(last, first - 1)?;
            values.extend(part.states.iter().copied().zip(last.rationals(part.states.len())));
            values.retain(|&s, _| wanted.contains(s.index()));
            values
        }
        _ => ExactSolution::new(model, event, resolution.into(), wanted, &plain)?.values_of(wanted),
    };
    Ok(values.into_iter().map(|(state, value)| (state.index(), value)).collect())
}

impl ExactSolution {
    /// The exact values of an event in these states, and in all that can be reached from them.
    pub(super) fn new(
        model: &IntervalMdp,
        event: &Event<'_>,
        players: Players,
        wanted: &StateSet,
        options: &SolverOptions<'_>,
    ) -> Result<Self, Inexact> {
        let mut work = Work::new(options);
        let record = options.policy || options.evidence;
        let mut moving = StateSet::with_capacity(model.num_states());
        let has_rows = |s: &usize| !model.choices().ranges(StateId::from_index(*s)).is_empty();
        (0..model.num_states()).filter(has_rows).for_each(|s| moving.insert(s));
        if let Event::Until { safe, goal, .. } = event {
            moving.intersect_with(safe);
            moving.difference_with(goal);
        }
        let (goal, steps) = match *event {
            Event::Next { goal } => (goal, 1),
            Event::Until { goal, steps: Some(steps), .. } => (goal, steps),
            Event::Until { goal, steps: None, .. } => {
                let known = zero_one(model, goal, &moving, players);
                moving.intersect_with(&known.positive);
                moving.difference_with(&known.certain);
                let part = Part::new(model, &moving, wanted, &mut work)?;
                let (values, choices) = strategies::solve(&part, &known.certain, players, &mut work)?;
                return Ok(Self { part, values, ones: known.certain, record: Record::Choices(choices) });
            }
        };
        let part = Part::new(model, &moving, wanted, &mut work)?;
        let start = |s: StateId| Rational::from_integer(u8::from(goal.contains(s.index())).into());
        let start = part.all().map(start).collect();
        let (last, levels) =
            iterate::iterate(&part, Level::of_rationals(start), steps, players, record, &mut work)?;
        let values = last.rationals(part.states.len());
        Ok(Self { part, values, ones: goal.clone(), record: Record::Steps(levels) })
    }

    /// The values of these states.
    pub(super) fn values_of(&self, wanted: &StateSet) -> BTreeMap<StateId, Rational> {
        let value = |s: usize| {
            let state = StateId::from_index(s);
            let value = match self.part.position(state) {
                Some(position) => self.values[position].clone(),
                None if self.ones.contains(s) => Rational::one(),
                None => Rational::zero(),
            };
            (state, value)
        };
        wanted.ones().map(value).collect()
    }
}
