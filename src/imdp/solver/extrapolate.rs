//! Jumps of the lower bounds along their last change.
//!
//! Where iteration converges slowly, its changes shrink by a constant factor `λ`: `L + κΔ` with
//! `κ < λ/(1−λ)` is then still below the value. That is a guess; it is accepted only if
//!
//! - `L′ ≤ T_σ(L′)`, rounded down, for the choices (and distributions) `σ` that are best at `L′` on the
//!   maximising sides, and
//! - whatever the minimising sides do, `σ` leaves the states of this part with `L′ > 0` almost surely,
//!
//! for then `L′ ≤ E_σ L′(where it is left) ≤ value`: a process that stays below its own expectation and
//! surely ends is bounded by what it ends with.

use super::component::Component;
use super::expectation::{Bound, poured_mass};
use super::graph::can_stay;
use super::query::Direction;
use crate::model::{RowBuffer, RowId, StateId};
use std::collections::HashMap;

impl Component<'_, '_> {
    /// Tries to jump and returns whether it did; on failure nothing changes.
    pub(super) fn extrapolate(&mut self, rate: f64) -> bool {
        // Near the limit, rounding hides the rate: what has worked before is the better guide.
        let expected = if rate > 0.5 && rate < 1.0 { 0.9 * rate / (1.0 - rate) } else { 0.0 };
        let mut factor = expected.max(4.0 * self.leap).min(1e15);
        let states = self.sweep.states.clone();
        let old: Vec<f64> = states.iter().map(|&s| self.shared.lower[s.index()]).collect();
        for _ in 0..4 {
            if factor < 1.0 {
                break;
            }
            for (i, &s) in states.iter().enumerate() {
                let value = old[i] + factor * self.change[i];
                self.shared.lower[s.index()] = value.min(self.shared.upper[s.index()]).max(old[i]);
            }
            if self.is_justified(&states) {
                // The choices must be those that were checked, even if the present ones are as good.
                if self.shared.maximises_for_policy() {
                    states.iter().for_each(|&s| self.shared.choose(s));
                }
                self.leap = factor;
                return true;
            }
            factor /= 6.0;
        }
        self.leap = factor;
        states.iter().zip(&old).for_each(|(&s, &value)| self.shared.lower[s.index()] = value);
        false
    }

    /// Whether the current lower bounds satisfy both conditions.
    fn is_justified(&mut self, states: &[StateId]) -> bool {
        let shared = &mut *self.shared;
        self.sweep.evaluate_rows(&shared.lower, Bound::Lower, &mut shared.lower_rows);
        let choices = shared.model.choices();
        let holds = |&s: &StateId| shared.lower_rows.best(choices.ranges(s)) >= shared.lower[s.index()];
        states.iter().all(holds) && self.is_left(states)
    }

    /// Whether the states with positive bounds are left almost surely: no set of them can be stayed in.
    fn is_left(&self, states: &[StateId]) -> bool {
        let shared = &*self.shared;
        let all = shared.model.rows();
        let is_own = |row: &RowId| shared.own_rows.contains(row.index());
        let supports: HashMap<RowId, Vec<bool>> = match shared.players.nature {
            Direction::Min => HashMap::new(),
            Direction::Max => self.sweep.rows().map(|id| (id, self.certain_support(id))).collect(),
        };
        // Only the maximising side's choice is fixed.
        let rows_of = |s: StateId| -> Vec<RowId> {
            let rows = shared.model.choices().rows(s);
            match shared.players.policy {
                Direction::Min => rows.filter(is_own).collect(),
                Direction::Max => {
                    let best = shared.lower_rows.best(shared.model.choices().ranges(s));
                    let attains = |row: &RowId| shared.lower_rows.values()[row.index()] == best;
                    rows.filter(attains).take(1).filter(is_own).collect()
                }
            }
        };
        let mut left: Vec<(StateId, Vec<RowId>)> =
            states.iter().filter(|&&s| shared.lower[s.index()] > 0.0).map(|&s| (s, rows_of(s))).collect();
        let mut inside = vec![false; states.len()];
        let position = |s: StateId| states.binary_search(&s).ok();
        left.iter().filter_map(|(s, _)| position(*s)).for_each(|i| inside[i] = true);
        let mut buffer = RowBuffer::default();
        // Rounds in alternating directions; giving up early only means not to jump.
        for _ in 0..64 {
            let before = left.len();
            left.reverse();
            left.retain(|(s, rows)| {
                let contained = |s: StateId| position(s).is_some_and(|i| inside[i]);
                let stays = rows.iter().any(|id| match shared.players.nature {
                    Direction::Min => can_stay(all.row(*id, &mut buffer), &contained),
                    Direction::Max => {
                        let support = supports.get(id).map_or(&[][..], |support| support);
                        let successors = all.row(*id, &mut buffer).successors;
                        successors.iter().zip(support).all(|(s, sure)| !sure || contained(*s))
                    }
                });
                if !stays && let Some(i) = position(*s) {
                    inside[i] = false;
                }
                stays
            });
            if left.is_empty() {
                return true;
            }
            if left.len() == before {
                return false;
            }
        }
        false
    }

    /// The successors that surely have positive probability when nature maximises at the current bounds.
    fn certain_support(&self, id: RowId) -> Vec<bool> {
        let buffer = &mut RowBuffer::default();
        let row = self.shared.model.rows().row(id, buffer);
        let doubtful = crate::numeric::rounding_factor(2 * row.len() + 8);
        let poured = poured_mass(row, &self.shared.lower, Direction::Max);
        poured.iter().zip(row.lower).map(|(p, l)| *l > 0.0 || *p > doubtful).collect()
    }
}
