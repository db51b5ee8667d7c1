//! Thresholds 0 and 1: decided by the graph of a model, however long its exact values are.

use super::graph::{within, zero_one};
use super::query::{Event, Players};
use crate::model::{IntervalMdp, StateId, StateSet};
use crate::numeric::Rational;
use crate::property::Resolution;
use num_traits::{One, Zero};

/// Where the probability of an event is 0 or 1.
#[derive(Clone, Debug)]
pub(crate) struct Extremes {
    /// Where it is above 0.
    positive: StateSet,
    /// Where it is 1.
    certain: StateSet,
}

impl Extremes {
    /// Decides it for every state.
    pub(crate) fn new(model: &IntervalMdp, event: &Event<'_>, resolution: Resolution) -> Self {
        let players: Players = resolution.into();
        let has_rows = |s: &usize| !model.choices().ranges(StateId::from_index(*s)).is_empty();
        let mut moving = StateSet::with_capacity(model.num_states());
        (0..model.num_states()).filter(has_rows).for_each(|s| moving.insert(s));
        let (positive, certain) = match *event {
            Event::Until { safe, goal, steps } => {
                moving.intersect_with(safe);
                moving.difference_with(goal);
                match steps {
                    Some(steps) => within(model, goal, &moving, players, steps),
                    None => {
                        let known = zero_one(model, goal, &moving, players);
                        (known.positive, known.certain)
                    }
                }
            }
            // What cannot move stays where it is.
            Event::Next { goal } => within(model, goal, &moving, players, 1),
        };
        Self { positive, certain }
    }

    /// 0 or 1 where that is the probability, else ½: it compares with 0 and with 1 like the probability itself.
    pub(crate) fn stand_in(&self, state: usize) -> Rational {
        if self.certain.contains(state) {
            Rational::one()
        } else if self.positive.contains(state) {
            Rational::new(1.into(), 2.into())
        } else {
            Rational::zero()
        }
    }
}
