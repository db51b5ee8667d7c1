//! A cyclic part of the model, everything it leads to being solved already.
//!
//! **Lower bound.** Iteration from 0, rounded down, which stays below the least fixpoint; sped up by
//! extrapolation where that can be justified (`extrapolate`).
//!
//! **Upper bound.** Guess `U = L + δ`, and accept it only if the operator, rounded up, does not raise it:
//! `T(U) ≤ U` implies that `U` is at least the least fixpoint (Knaster and Tarski), for every resolution
//! and whatever led to the guess. In end components, where a maximising side can stay for ever, any common
//! value reproduces itself; there the guess is made level, or it would never be accepted.

use super::expectation::Bound;
use super::guess::{LevelSets, levels};
use super::options::{Control, Status};
use super::shared::Shared;
use super::sweep::Sweep;
use crate::model::{RowId, StateId};

/// Raises of a refuted guess are multiplied by powers of 8 up to this one: 8⁸ is 1.7·10⁷.
const LEAPS: i32 = 8;

/// So many multiplications are worth a try in any case.
const LEAST_BUDGET: u64 = 5_000_000;

/// Whoever has not come to an end after so many sweeps never will.
const LAST_SWEEP: u64 = 1 << 20;

/// The part being solved.
pub(super) struct Component<'s, 'a> {
    pub shared: &'s mut Shared<'a>,
    pub sweep: Sweep<'a>,
    /// By position in `sweep.states`: the last change of the lower bounds.
    pub change: Vec<f64>,
    /// How many times the last change the next jump of the lower bounds tries.
    pub leap: f64,
    results: Vec<f64>,
}

impl<'s, 'a> Component<'s, 'a> {
    pub(super) fn new(shared: &'s mut Shared<'a>, states: Vec<StateId>, rows: &[RowId]) -> Self {
        shared.lower_rows.prepare(shared.model.choices(), &states);
        shared.upper_rows.prepare(shared.model.choices(), &states);
        let change = vec![0.0; states.len()];
        let sweep = Sweep::new(shared.model, shared.players, states, rows);
        rows.iter().for_each(|&row| shared.own_rows.insert(row.index()));
        Self { shared, sweep, change, leap: 0.0, results: vec![] }
    }

    /// Iterates until the bounds are at most `share` further apart than those of the successors.
    ///
    /// Returns why, if the computation must stop altogether.
    pub(super) fn solve(mut self, share: f64, control: &mut Control<'_>) -> Option<Status> {
        let behind = self.gap_behind();
        let mut margin = share;
        let (mut rate, mut previous) = (0.0, 0.0);
        let (mut next_guess, mut next_jump) = (1, 8);
        let mut next_strategies = self.shared.patience;
        let entries: usize = self.sweep.rows().map(|row| self.shared.model.rows().row_len(row)).sum();
        for sweeps in 1u64.. {
            if let Some(reason) = control.stop() {
                return Some(reason);
            }
            let change = self.raise_lower();
            control.done(self.gap());
            if previous > 0.0 {
                rate = change / previous;
            }
            previous = change;
            if sweeps >= next_jump && change > 0.0 {
                let jumped = self.extrapolate(rate);
                next_jump = sweeps + if jumped { 4 } else { 4 + sweeps / 8 };
                previous = 0.0;
            }
            // As long as a step raises L by more, it raises L + δ.
            if (sweeps >= next_guess && change <= behind + margin) || change == 0.0 {
                next_guess = sweeps + 1 + sweeps / 4;
                let rounds = 4 + sweeps.min(4096) / 2;
                if self.guess(behind, margin, rounds) && (self.gap() <= behind + 2.0 * share || change == 0.0)
                {
                    break;
                }
            }
            if change == 0.0 || sweeps >= next_strategies {
                next_strategies = sweeps.max(self.shared.patience).saturating_mul(16);
                // As much work as all sweeps so far.
                let budget = LEAST_BUDGET.max(2 * sweeps * entries as u64);
                if self.solve_by_strategies(share, budget, control) {
                    break;
                }
                if change == 0.0 || sweeps >= LAST_SWEEP {
                    // Nothing will improve any more: settle for the tightest bound that can be verified.
                    margin *= 4.0;
                    if margin > 2.0 {
                        break;
                    }
                }
            }
        }
        self.finish();
        None
    }

    /// How far apart the bounds of everything this part leads to are.
    pub(super) fn gap_behind(&self) -> f64 {
        let shared = &self.shared;
        let inside = |s: &StateId| self.sweep.states.binary_search(s).is_ok();
        let mut gap: f64 = 0.0;
        for row in self.sweep.rows() {
            let row = shared.model.rows().row(row);
            let possible = row.successors.iter().zip(row.upper).filter(|(s, u)| **u > 0.0 && !inside(s));
            gap =
                possible.map(|(&s, _)| shared.upper[s.index()] - shared.lower[s.index()]).fold(gap, f64::max);
        }
        let rows = self.sweep.states.iter().flat_map(|&s| shared.model.choices().rows(s));
        for row in rows.filter(|&row| !shared.own_rows.contains(row.index())) {
            let row = row.index();
            gap = gap.max(shared.upper_rows.values()[row] - shared.lower_rows.values()[row]);
        }
        gap
    }

    fn gap(&self) -> f64 {
        let gap = |&s: &StateId| self.shared.upper[s.index()] - self.shared.lower[s.index()];
        self.sweep.states.iter().map(gap).fold(0.0, f64::max)
    }

    /// `L := max(L, T(L))`; returns the largest change.
    fn raise_lower(&mut self) -> f64 {
        let shared = &mut *self.shared;
        self.sweep.evaluate_rows(&shared.lower, Bound::Lower, &mut shared.lower_rows);
        self.sweep.evaluate_states(&shared.lower_rows, &mut self.results);
        let mut largest: f64 = 0.0;
        for (i, &s) in self.sweep.states.iter().enumerate() {
            let change = (self.results[i] - shared.lower[s.index()]).max(0.0);
            self.change[i] = change;
            largest = largest.max(change);
            if change > 0.0 {
                shared.lower[s.index()] = self.results[i];
                if shared.maximises_for_policy() && !shared.keeps_choice(s, self.results[i]) {
                    shared.choose(s);
                }
            }
        }
        largest
    }

    /// Tries `U = L + behind + margin` and shapes derived from it; returns whether one is an upper bound.
    ///
    /// Where a single step does not lose any of the margin, rounding alone can spoil a guess `C`. The mean
    /// of `C, T(C), …, T^{k−1}(C)` spreads what is lost in `k` steps evenly: for a linear operator it is
    /// raised by `(T^k(C) − C)/k`. Means start anew at every power of two, to forget a bad beginning.
    pub(super) fn guess(&mut self, behind: f64, margin: f64, rounds: u64) -> bool {
        let states = self.sweep.states.clone();
        let raised = |&s: &StateId| (self.shared.lower[s.index()] + behind + margin).min(1.0);
        let mut iterate: Vec<f64> = states.iter().map(raised).collect();
        let old: Vec<f64> = states.iter().map(|&s| self.shared.upper[s.index()]).collect();
        if self.is_inductive(&iterate, &LevelSets::default()) {
            self.accept(&old);
            return true;
        }
        states.iter().zip(&old).for_each(|(&s, &u)| self.shared.upper[s.index()] = u);
        let levels = levels(self.shared, &self.sweep);
        levels.raise(&mut iterate);
        let (mut sum, mut count) = (vec![0.0; states.len()], 0.0);
        for k in 1..=rounds {
            sum.iter_mut().zip(&iterate).for_each(|(sum, value)| *sum += value);
            count += 1.0;
            if k.is_power_of_two() {
                let mean: Vec<f64> = sum.iter().map(|sum| (sum / count).min(1.0)).collect();
                if self.is_inductive(&mean, &levels) {
                    self.accept(&old);
                    return true;
                }
                sum.fill(0.0);
                count = 0.0;
            }
            if self.is_inductive(&iterate, &levels)
                || (k.is_power_of_two() && self.leap_up(&iterate, &levels, margin))
            {
                self.accept(&old);
                return true;
            }
            iterate.iter_mut().zip(&self.results).for_each(|(value, new)| *value = new.min(1.0));
        }
        states.iter().zip(&old).for_each(|(&s, &u)| self.shared.upper[s.index()] = u);
        false
    }

    /// Tries the candidate just refuted, raised further and further where the operator raised it.
    ///
    /// A state that hardly moves follows a level one, but its lower bound stays behind by what rounding
    /// takes, divided by how much it moves. So much is missing in its guess too, and plain iteration would
    /// have to regain it as slowly. Raises by at most `room`: values near 1 would be accepted, but say nothing.
    /// Leaves `T` of the candidate in the results if it fails.
    fn leap_up(&mut self, candidate: &[f64], levels: &LevelSets, room: f64) -> bool {
        let image = self.results.clone();
        let mut raised = candidate.to_vec();
        for exponent in 1..=LEAPS {
            let factor = 8f64.powi(exponent);
            for (value, new) in raised.iter_mut().zip(&self.results) {
                *value = (*value + factor * (new - *value).max(0.0)).min(1.0);
            }
            levels.raise(&mut raised);
            if raised.iter().zip(candidate).any(|(value, old)| value - old > room) {
                break;
            }
            if self.is_inductive(&raised, levels) {
                return true;
            }
        }
        self.results = image;
        false
    }

    /// Whether `T(U) ≤ U` with upward rounding; leaves `U` in the upper bounds and `T(U)` in the results.
    fn is_inductive(&mut self, candidate: &[f64], levels: &LevelSets) -> bool {
        let shared = &mut *self.shared;
        let states = &self.sweep.states;
        states.iter().zip(candidate).for_each(|(&s, &u)| shared.upper[s.index()] = u);
        self.sweep.evaluate_rows(&shared.upper, Bound::Upper, &mut shared.upper_rows);
        if levels.cap(candidate, shared.upper_rows.values_mut()) {
            shared.upper_rows.rebuild();
        }
        self.sweep.evaluate_states(&shared.upper_rows, &mut self.results);
        self.results.iter().zip(candidate).all(|(new, guess)| new <= guess)
    }

    /// Makes `T(U)` of an inductive `U` the upper bound, unless the old one is better.
    fn accept(&mut self, old: &[f64]) {
        let shared = &mut *self.shared;
        for (i, &s) in self.sweep.states.iter().enumerate() {
            // The table still holds the rows at `U`: what the policy chooses here attains `T(U)`.
            if self.results[i] < old[i] && shared.minimises_for_policy() {
                shared.choose(s);
            }
            shared.upper[s.index()] = self.results[i].min(old[i]).max(shared.lower[s.index()]);
        }
    }

    /// Leaves in both tables what the final bounds say about the rows.
    fn finish(&mut self) {
        let shared = &mut *self.shared;
        self.sweep.evaluate_rows(&shared.lower, Bound::Lower, &mut shared.lower_rows);
        self.sweep.evaluate_rows(&shared.upper, Bound::Upper, &mut shared.upper_rows);
        shared.lower_rows.reset();
        shared.upper_rows.reset();
        self.sweep.rows().for_each(|row| shared.own_rows.set(row.index(), false));
    }
}
