//! Where the value is 0, and where it is 1, decided exactly.
//!
//! With `Q_a` = ∃ for a maximising policy and ∀ for a minimising one, `Q_p` the same for nature:
//!
//! - value > 0: `μY. goal ∪ {s : Q_a Q_p p(Y) > 0}`;
//! - value = 1: `νX. μY. goal ∪ {s : Q_a Q_p (p(X) = 1 ∧ p(Y) > 0)}`.
//!
//! For a minimising nature `p(Y) > 0` means `max(Σ_Y l, 1 − Σ_{Yᶜ} u) > 0` and `p(X) = 1` means
//! `max p(Xᶜ) = 0`. A maximising one needs a single `p` for both: `Σ_{Xᶜ} l = 0`, `Σ_X u ≥ 1` and
//! `min(Σ_{X∩Y} u, 1 − Σ_{X∖Y} l) > 0`.

use super::super::policy::{NO_CHOICE, first_choice};
use super::super::query::{Direction, Players};
use super::choice_tree::ChoiceTree;
use super::decide::{compare_with_one, lower_covers_one, margin, upper_covers_one};
use crate::model::{End, IntervalMdp, Row, RowBuffer, RowId, RowSet, StateId, StateSet};
use std::cmp::Ordering;

/// The states with the extreme values.
pub(in crate::solver) struct ZeroOne {
    /// Value > 0.
    pub positive: StateSet,
    /// Value = 1.
    pub certain: StateSet,
    /// Choices that attain 1 or 0 where the policy has to do something for it; else [`NO_CHOICE`].
    pub choices: Vec<u32>,
}

/// Finds the states of value 0 and 1; `moving` are the safe states with rows that are not goal states.
pub(in crate::solver) fn zero_one(
    model: &IntervalMdp,
    goal: &StateSet,
    moving: &StateSet,
    players: Players,
) -> ZeroOne {
    let rows = model.rows().len();
    let tree = ChoiceTree::new(rows, model.choices(), |s| moving.contains(s.index()));
    let analysis = Analysis::new(model.rows(), goal, players, &tree);
    let mut allowed = StateSet::with_capacity(rows);
    allowed.insert_range(..);
    let (positive, made_it) = analysis.attract(&allowed);
    let mut choices = vec![NO_CHOICE; model.num_states()];
    if players.policy == Direction::Min {
        for s in moving.difference(&positive) {
            let stays = |row: RowId| !made_it.contains(row.index());
            choices[s] = first_choice(model.choices(), StateId::from_index(s), stays).unwrap_or(NO_CHOICE);
        }
    }
    let (mut certain, mut buffer) = (positive.clone(), RowBuffer::default());
    loop {
        for row in 0..rows {
            let keep = allowed.contains(row)
                && stays(model.rows().row(RowId::from_index(row), &mut buffer), players.nature, |s| {
                    certain.contains(s.index())
                });
            allowed.set(row, keep);
        }
        let (next, _) = analysis.attract(&allowed);
        if next == certain {
            break;
        }
        certain = next;
    }
    if players.policy == Direction::Max {
        analysis.attract_with(&allowed, |state, row| {
            let choice = first_choice(model.choices(), state, |other| other == row);
            choices[state.index()] = choice.unwrap_or(NO_CHOICE);
        });
    }
    ZeroOne { positive, certain, choices }
}

/// `Q_p p(X) = 1`: whether every (`Min`) or some (`Max`) distribution of a row stays in a set.
pub(in crate::solver) fn stays(
    row: Row<'_>,
    nature: Direction,
    inside: impl Fn(StateId) -> bool + Copy,
) -> bool {
    let outside = |bounds: &[f64]| row.successors.iter().zip(bounds).all(|(s, b)| inside(*s) || *b == 0.0);
    match nature {
        Direction::Min => outside(row.upper) || lower_covers_one(row, inside),
        Direction::Max => outside(row.lower) && upper_covers_one(row, inside),
    }
}

/// `Q_p p(Y) > 0`: whether every (`Min`) or some (`Max`) distribution of a row gives a set positive probability.
pub(in crate::solver) fn hits(row: Row<'_>, nature: Direction, inside: impl Fn(StateId) -> bool) -> bool {
    let within = || (0..row.len()).filter(|&i| inside(row.successors[i]));
    if nature == Direction::Min && within().any(|i| row.lower[i] > 0.0) {
        return true;
    }
    let end = if nature == Direction::Min { End::Upper } else { End::Lower };
    within().any(|i| row.upper[i] > 0.0)
        && compare_with_one(row, end, |i| !inside(row.successors[i])) == Ordering::Less
}

/// What is needed to find the states from which a set is met with positive probability.
pub(super) struct Analysis<'a> {
    rows: &'a RowSet,
    goal: &'a StateSet,
    players: Players,
    tree: &'a ChoiceTree,
    predecessors: Predecessors,
}

impl<'a> Analysis<'a> {
    pub(super) fn new(rows: &'a RowSet, goal: &'a StateSet, players: Players, tree: &'a ChoiceTree) -> Self {
        Self { rows, goal, players, tree, predecessors: Predecessors::new(rows, goal.len()) }
    }

    /// `μY. goal ∪ {s : Q_a (allowed(a) ∧ Q_p p(Y) > 0)}` and the rows that satisfy the condition.
    fn attract(&self, allowed: &StateSet) -> (StateSet, StateSet) {
        self.attract_with(allowed, |_, _| {})
    }

    /// The same; `joined(s, a)` is told by which row a state was the first time found to belong to `Y`.
    pub(super) fn attract_with(
        &self,
        allowed: &StateSet,
        mut joined: impl FnMut(StateId, RowId),
    ) -> (StateSet, StateSet) {
        let rows = self.rows;
        let (mut reached, mut done) = (self.goal.clone(), StateSet::with_capacity(rows.len()));
        let mut collector = self.tree.collect(self.players.policy);
        // Running sums of the bounds outside Y: upper ones limit what nature can keep away from Y, lower
        // ones are what a maximising nature must waste.
        let bounds = |row: Row<'_>, i: usize| match self.players.nature {
            Direction::Min => row.upper[i],
            Direction::Max => row.lower[i],
        };
        let mut outside: Vec<f64> = Vec::with_capacity(rows.len());
        rows.for_each(|_, row| outside.push((0..row.len()).map(|i| bounds(row, i)).sum()));
        let mut buffer = RowBuffer::default();
        let mut work: Vec<StateId> = self.goal.ones().map(StateId::from_index).collect();
        while let Some(state) = work.pop() {
            for &id in self.predecessors.get(state) {
                let index = id.index();
                if done.contains(index) || !allowed.contains(index) {
                    continue;
                }
                let row = rows.row(id, &mut buffer);
                let Ok(i) = row.successors.binary_search(&state) else { continue };
                outside[index] -= bounds(row, i);
                if !self.hits(row, &reached, outside[index], i) {
                    continue;
                }
                done.insert(index);
                collector.add(id, |found| {
                    if !reached.contains(found.index()) {
                        reached.insert(found.index());
                        joined(found, id);
                        work.push(found);
                    }
                });
            }
        }
        (reached, done)
    }

    /// `Q_p p(Y) > 0` for a row whose successor `i` has just joined `Y`.
    fn hits(&self, row: Row<'_>, reached: &StateSet, outside: f64, i: usize) -> bool {
        if self.players.nature == Direction::Min && row.lower[i] > 0.0 {
            return true;
        }
        let inside = |s: StateId| reached.contains(s.index());
        if outside > 1.0 + margin(row.len()) {
            return false;
        }
        if outside < 1.0 - margin(row.len()) {
            return (0..row.len()).any(|j| row.upper[j] > 0.0 && inside(row.successors[j]));
        }
        hits(row, self.players.nature, inside)
    }
}

/// For every state, the rows that list it.
pub(super) struct Predecessors {
    starts: Vec<usize>,
    rows: Vec<RowId>,
}

impl Predecessors {
    pub(super) fn new(all: &RowSet, states: usize) -> Self {
        let mut starts = vec![0; states + 1];
        all.for_each(|_, row| row.successors.iter().for_each(|&s| starts[s.index() + 1] += 1));
        for state in 0..states {
            starts[state + 1] += starts[state];
        }
        let (mut next, mut rows) = (starts.clone(), vec![RowId(0); all.num_entries()]);
        all.for_each(|id, row| {
            for &s in row.successors {
                rows[next[s.index()]] = id;
                next[s.index()] += 1;
            }
        });
        Self { starts, rows }
    }

    pub(super) fn get(&self, state: StateId) -> &[RowId] {
        &self.rows[self.starts[state.index()]..self.starts[state.index() + 1]]
    }
}
