//! Cyclic parts that iteration is too slow for: bounds from optimal strategies and linear equations.
//!
//! Where a part is left after 10⁹ steps or more, iteration creeps, and a bound in doubles cannot even be seen to
//! reproduce itself: what it gains in a step is less than its last digit. So strategies of both sides are computed
//! that are optimal for the values in fixed point (`game`), with one change: the values solve `x = T(x) ∓ offset`, the
//! offset being a little more than what fixed-point rounding can hide. Such values are off by the offset times the
//! number of steps to be expected, 10⁻³⁴ a step, and they are checked like any other guess, rounded to the safe side
//! throughout:
//!
//! - `L ≤ T_σ(L)`, where `σ` is a choice of the maximising sides that surely leads out of the part;
//! - `T(U) ≤ U`, in end components level by level (`guess`).

mod elimination;
mod fixed;
mod fixed_row;
mod game;
mod part;
#[cfg(test)]
mod tests;
mod ways_out;

pub(super) use elimination::{Elimination, Number, Process};
pub(super) use fixed::to_rational;
pub(super) use ways_out::{Leads, WaysOut, ways_out};

use super::component::Component;
use super::expectation::Bound;
use super::guess::levels;
use super::options::Control;
use super::query::Direction;
use part::Part;

impl Component<'_, '_> {
    /// Replaces the bounds by those of optimal strategies; returns whether the lower ones could be.
    ///
    /// If only they could, upper ones are looked for by guessing with larger and larger margins.
    pub(super) fn solve_by_strategies(&mut self, share: f64, budget: u64, control: &Control<'_>) -> bool {
        let behind = self.gap_behind();
        if !self.replace_bounds(Bound::Lower, budget, control) {
            return false;
        }
        if self.replace_bounds(Bound::Upper, budget, control) {
            return true;
        }
        let mut margin = share;
        while margin <= 2.0 && control.stop().is_none() && !self.guess(behind, margin, 64) {
            margin *= 4.0;
        }
        true
    }

    /// Replaces the bounds of one side, if they can be computed and verified.
    fn replace_bounds(&mut self, side: Bound, budget: u64, control: &Control<'_>) -> bool {
        let levels = match side {
            Bound::Lower => Default::default(),
            Bound::Upper => {
                let shared = &mut *self.shared;
                self.sweep.evaluate_rows(&shared.lower, Bound::Lower, &mut shared.lower_rows);
                levels(self.shared, &self.sweep)
            }
        };
        let Some(part) = Part::new(self, side, &levels, budget) else { return false };
        let Some((strategy, mut values)) = part.game.solve(&|| control.stop().is_some()) else {
            return false;
        };
        values.iter_mut().for_each(|value| *value = (*value).min(fixed::ONE));
        if !part.holds(&strategy, &values, &levels) {
            return false;
        }
        let shared = &mut *self.shared;
        let (doubles, precise) = match side {
            Bound::Lower => (&mut shared.lower, &mut shared.precise_lower),
            Bound::Upper => (&mut shared.upper, &mut shared.precise_upper),
        };
        for (i, &s) in self.sweep.states.iter().enumerate() {
            let value = values[part.node(i)];
            let (below, above) = (fixed::to_f64_down(value), fixed::to_f64_up(value));
            doubles[s.index()] = if side == Bound::Lower { below } else { above };
            if below < above {
                precise.insert(s, value);
            }
        }
        let attained = if side == Bound::Lower { Direction::Max } else { Direction::Min };
        if shared.wants_policy && shared.players.policy == attained {
            for (i, &s) in self.sweep.states.iter().enumerate() {
                shared.choices[s.index()] = part.choice(i, &strategy);
            }
        }
        true
    }
}
