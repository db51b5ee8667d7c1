//! From a cyclic part of the model to a game in fixed point, and back to what a bound must satisfy.

use super::super::component::Component;
use super::super::expectation::Bound;
use super::super::guess::{LevelSets, greedy_row};
use super::super::policy::{NO_CHOICE, first_choice};
use super::super::query::Direction;
use super::fixed::{ceil_f64, floor_f64};
use super::fixed_row::FixedRow;
use super::game::{Game, Node, Strategy};
use crate::model::{Choices, RowBuffer, RowId, StateId};
use std::collections::HashMap;

/// More choices than this are not written out, state by state.
const MOST_CHOICES: usize = 1 << 23;

/// A part of the model as a game for one of the bounds.
pub(super) struct Part<'a> {
    pub game: Game,
    side: Bound,
    choices: &'a Choices,
    states: Vec<StateId>,
    /// The node of every state: its own, or that of its end component.
    nodes: Vec<u32>,
    /// The rows of the game, as rows of the model.
    rows: Vec<RowId>,
    /// For a minimising policy, what it is fixed to in end components.
    fixed: HashMap<StateId, RowId>,
}

/// Collects rows and what they lead to.
struct Collector<'c, 's, 'a> {
    component: &'c Component<'s, 'a>,
    side: Bound,
    nodes: HashMap<StateId, u32>,
    count: u32,
    outside: Vec<u128>,
    outside_of: HashMap<StateId, u32>,
    rows: Vec<FixedRow>,
    ids: Vec<RowId>,
    index: HashMap<RowId, u32>,
}

impl<'a> Part<'a> {
    /// `None` if it is too large, or a row admits no distribution exactly.
    pub(super) fn new(
        component: &Component<'_, 'a>,
        side: Bound,
        levels: &LevelSets,
        budget: u64,
    ) -> Option<Self> {
        let shared = &*component.shared;
        let (states, players, choices) = (&component.sweep.states, shared.players, shared.model.choices());
        let total: usize = states.iter().flat_map(|&s| choices.ranges(s)).map(|range| range.len()).sum();
        (total <= MOST_CHOICES).then_some(())?;
        let mut nodes = vec![u32::MAX; states.len()];
        for (class, members) in (0..).zip(&levels.classes) {
            members.iter().for_each(|&i| nodes[i as usize] = class);
        }
        let mut count = levels.classes.len() as u32;
        for node in nodes.iter_mut().filter(|node| **node == u32::MAX) {
            *node = count;
            count += 1;
        }
        let node_of = states.iter().zip(&nodes).map(|(&s, &node)| (s, node)).collect();
        let mut collector = Collector {
            component,
            side,
            nodes: node_of,
            count,
            outside: vec![],
            outside_of: HashMap::new(),
            rows: vec![],
            ids: vec![],
            index: HashMap::new(),
        };
        let empty = || Node { options: vec![], optimum: players.policy, offset: 0 };
        let mut list: Vec<Node> = (0..count).map(|_| empty()).collect();
        let mut fixed = HashMap::new();
        for (&s, &node) in states.iter().zip(&nodes) {
            let in_class = (node as usize) < levels.classes.len();
            let node = &mut list[node as usize];
            if in_class && players.policy == Direction::Min {
                // Each of its states does what is best; the highest of them decides.
                node.optimum = Direction::Max;
                let row = greedy_row(shared, s)?;
                fixed.insert(s, row);
                node.options.push(collector.row(row)?);
            } else {
                for row in choices.rows(s) {
                    node.options.push(collector.row(row)?);
                }
            }
        }
        let Collector { outside, rows, ids, .. } = collector;
        for node in &mut list {
            node.options.sort_unstable();
            node.options.dedup();
            let longest = node.options.iter().map(|&row| rows[row as usize].targets.len()).max()?;
            node.offset = 4 * longest as u128 + 64;
        }
        let raised = side == Bound::Upper;
        let game = Game { nature: players.nature, nodes: list, rows, outside, raised, budget };
        Some(Self { game, side, choices, states: states.clone(), nodes, rows: ids, fixed })
    }

    /// The node of a state, by position.
    pub(super) fn node(&self, position: usize) -> usize {
        self.nodes[position] as usize
    }

    /// What a strategy chooses in a state, counted in the state's choices.
    pub(super) fn choice(&self, position: usize, strategy: &Strategy) -> u32 {
        let state = self.states[position];
        let of_node = self.rows[strategy.choices[self.node(position)] as usize];
        let row = self.fixed.get(&state).copied().unwrap_or(of_node);
        first_choice(self.choices, state, |other| other == row).unwrap_or(NO_CHOICE)
    }

    /// Whether values are certainly bounds: `L ≤ T_σ(L)`, or `T(U) ≤ U`.
    pub(super) fn holds(&self, strategy: &Strategy, values: &[u128], levels: &LevelSets) -> bool {
        let game = &self.game;
        let mut weights: Vec<u128> =
            game.rows.iter().map(|row| row.bound(values, game.nature, self.side)).collect();
        if self.side == Bound::Upper {
            let position: HashMap<RowId, usize> = self.rows.iter().zip(0..).map(|(&id, i)| (id, i)).collect();
            for (row, class) in &levels.capped {
                if let Some(&i) = position.get(row) {
                    weights[i] = weights[i].min(values[*class]);
                }
            }
        }
        // The side that a bound is proved for has made its choice; the other one can do anything.
        let proved_for = if self.side == Bound::Lower { Direction::Max } else { Direction::Min };
        game.nodes.iter().zip(&strategy.choices).zip(values).all(|((node, choice), &value)| {
            let holds = |row: &u32| match self.side {
                Bound::Lower => value <= weights[*row as usize],
                Bound::Upper => value >= weights[*row as usize],
            };
            if node.optimum == proved_for { holds(choice) } else { node.options.iter().all(holds) }
        })
    }
}

impl Collector<'_, '_, '_> {
    /// The index of a row in the game.
    fn row(&mut self, id: RowId) -> Option<u32> {
        if let Some(&index) = self.index.get(&id) {
            return Some(index);
        }
        let shared = &*self.component.shared;
        let row = if shared.own_rows.contains(id.index()) {
            let buffer = &mut RowBuffer::default();
            let row = shared.model.rows().row(id, buffer);
            let targets = row.successors.iter().map(|&s| self.target(s)).collect();
            FixedRow::new(row, targets)?
        } else {
            let table = if self.side == Bound::Lower { &shared.lower_rows } else { &shared.upper_rows };
            let value = self.fixed(table.values()[id.index()]);
            self.outside.push(value);
            FixedRow::certain(self.count + self.outside.len() as u32 - 1)
        };
        let index = self.rows.len() as u32;
        self.rows.push(row);
        self.ids.push(id);
        self.index.insert(id, index);
        Some(index)
    }

    fn target(&mut self, state: StateId) -> u32 {
        if let Some(&node) = self.nodes.get(&state) {
            return node;
        }
        let shared = &*self.component.shared;
        let value = match self.side {
            Bound::Lower => shared.lower[state.index()],
            Bound::Upper => shared.upper[state.index()],
        };
        let value = self.fixed(value);
        *self.outside_of.entry(state).or_insert_with(|| {
            self.outside.push(value);
            self.count + self.outside.len() as u32 - 1
        })
    }

    fn fixed(&self, value: f64) -> u128 {
        match self.side {
            Bound::Lower => floor_f64(value),
            Bound::Upper => ceil_f64(value),
        }
    }
}
