//! One application of the Bellman operator with rewards.

use super::super::expectation::{Bound, RowBlock, Workspace};
use super::super::query::{Direction, Players};
use super::costs;
use crate::model::{IntervalMdp, RewardStructure, RowBuffer, RowId, RowSet, Rows, StateId};
use std::borrow::Cow;

/// A choice that a state may make.
struct Choice {
    /// Its number within the state.
    number: u32,
    /// Its row, in the rows of the operator.
    row: RowId,
    /// What it earns, from below and from above.
    cost: [f64; 2],
}

/// The states, choices and rows that are iterated.
pub(super) struct Operator {
    pub(super) states: Vec<StateId>,
    players: Players,
    choices: Vec<Vec<Choice>>,
    rows: RowSet,
    block: RowBlock,
    workspace: Workspace,
    /// How many states the model has; rows with rewards on branches have successors of their own beyond them.
    model_states: usize,
    /// Per extra successor, the state it stands for and what the branch to it earns.
    branches: Vec<(StateId, f64)>,
}

impl Operator {
    /// The operator for these states; `usable` says which of their rows may be chosen, and `possible` which successors may be
    /// met: nature is known to leave out the others.
    pub(super) fn new(
        model: &IntervalMdp,
        rewards: Option<&RewardStructure>,
        players: Players,
        states: Vec<StateId>,
        (usable, possible): (&dyn Fn(RowId) -> bool, &dyn Fn(StateId) -> bool),
    ) -> Self {
        let first_choices = model.choices().first_choices();
        let mut shared = vec![None; model.rows().len()];
        let (mut rows, mut buffer) = (Rows::new(), RowBuffer::default());
        let mut branches = vec![];
        let model_states = model.num_states();
        let mut choices = vec![];
        for &state in &states {
            let mut own = vec![];
            for (number, row) in (0u32..).zip(model.choices().rows(state)) {
                if !usable(row) {
                    continue;
                }
                let choice = first_choices[state.index()] + u64::from(number);
                let of_branches = rewards.and_then(|rewards| rewards.branches.get(&choice));
                let local = match (of_branches, shared[row.index()]) {
                    (None, Some(local)) => local,
                    _ => {
                        let source = model.rows().row(row, &mut buffer);
                        for (position, &successor) in source.successors.iter().enumerate() {
                            let is_possible = possible(successor);
                            let successor = match of_branches.map(|of_branches| of_branches[position]) {
                                None => successor,
                                Some(reward) => {
                                    branches.push((successor, reward));
                                    StateId::from_index(model_states + branches.len() - 1)
                                }
                            };
                            match is_possible {
                                true => rows.push_entry_of(successor, source, position),
                                // Nature can leave it out, so its lower bound is 0.
                                false => rows.push_entry(successor, 0.0, 0.0),
                            }
                        }
                        let local = rows.finish_row();
                        if of_branches.is_none() {
                            shared[row.index()] = Some(local);
                        }
                        local
                    }
                };
                let cost = match rewards {
                    None => [1.0; 2],
                    Some(rewards) => [Bound::Lower, Bound::Upper]
                        .map(|side| costs::of_choice(rewards, state, choice, side)),
                };
                own.push(Choice { number, row: local, cost });
            }
            choices.push(own);
        }
        let rows = RowSet::from(rows);
        let mut workspace = Workspace::default();
        let mut block = RowBlock::new(RowId::first(rows.len()).collect());
        block.prepare(&rows, &mut workspace);
        Self { states, players, choices, rows, block, workspace, model_states, branches }
    }

    /// The most that a choice and the branches behind it can earn.
    pub(super) fn largest_cost(&self) -> f64 {
        let costs = self.choices.iter().flatten().map(|choice| choice.cost[1]).fold(0.0, f64::max);
        let branches = self.branches.iter().map(|(_, reward)| *reward).fold(0.0, f64::max);
        costs::sum(costs, costs::written(branches, Bound::Upper), Bound::Upper)
    }

    /// `opt_a opt_p (r + γ p·V)` for every state in the order of [`Self::states`], and the choices that attain it.
    pub(super) fn apply(&mut self, values: &[f64], discount: f64, side: Bound) -> (Vec<f64>, Vec<u32>) {
        debug_assert_eq!(values.len(), self.model_states);
        let needs_own = discount != 1.0 || !self.branches.is_empty();
        let later: Cow<'_, [f64]> =
            if needs_own { self.later(values, discount, side).into() } else { values.into() };
        let mut weights = vec![0.0; self.rows.len()];
        let (later, _) = later.as_chunks::<1>();
        let (way, out) = ((self.players.nature, [side]), [&mut weights[..]]);
        self.block.evaluate(&self.rows, later, way, |_| [true], out, &mut self.workspace);
        let maximises = self.players.policy == Direction::Max;
        let (mut results, mut chosen) = (vec![], vec![]);
        for choices in &self.choices {
            let mut best: Option<(f64, u32)> = None;
            for choice in choices {
                let weight = weights[choice.row.index()];
                let value = costs::sum(choice.cost[usize::from(side == Bound::Upper)], weight, side);
                let better = best.is_none_or(|(old, _)| if maximises { value > old } else { value < old });
                if better {
                    best = Some((value, choice.number));
                }
            }
            let (value, number) = best.unwrap_or((0.0, 0));
            results.push(value);
            chosen.push(number);
        }
        (results, chosen)
    }

    /// What successors are worth today: `γ V(s)` of a state, `r + γ V(s)` of a branch that earns `r` of its own.
    fn later(&self, values: &[f64], discount: f64, side: Bound) -> Vec<f64> {
        let mut later: Vec<f64> = values.iter().map(|&value| discounted(value, discount, side)).collect();
        for &(state, reward) in &self.branches {
            later.push(costs::sum(later[state.index()], costs::written(reward, side), side));
        }
        later
    }
}

/// A value of the next step as it is worth today.
pub(super) fn discounted(value: f64, discount: f64, side: Bound) -> f64 {
    if discount == 1.0 || value == 0.0 {
        return value;
    }
    // The factor may be the double next to what was written.
    match side {
        Bound::Lower => (value * discount.next_down()).next_down().max(0.0),
        Bound::Upper => (value * discount.next_up()).next_up(),
    }
}
