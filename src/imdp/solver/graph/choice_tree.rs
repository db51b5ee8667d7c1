//! Which states can choose a row, without expanding ranges to choices.

use super::super::query::Direction;
use crate::model::{Choices, RowId, StateId};

/// A segment tree over the rows: node `i` has the children `2i` and `2i + 1`, row `r` is leaf `rows + r`.
///
/// The ranges of a state are covered by a few nodes, so walking from rows to states costs
/// `O((rows + ranges) log rows)` in total, however many choices the ranges stand for.
pub(in crate::solver) struct ChoiceTree {
    rows: usize,
    /// The covering nodes of every state, and the states of every node.
    nodes: Lists,
    states: Lists,
}

/// Lists of numbers, one after the other.
struct Lists {
    starts: Vec<usize>,
    items: Vec<u32>,
}

impl Lists {
    fn get(&self, list: usize) -> &[u32] {
        &self.items[self.starts[list]..self.starts[list + 1]]
    }
}

impl ChoiceTree {
    /// The tree for the ranges of the states that `include` names.
    pub(crate) fn new(rows: usize, choices: &Choices, include: impl Fn(StateId) -> bool) -> Self {
        let mut nodes = Lists { starts: vec![0], items: vec![] };
        for state in StateId::first(choices.num_states()) {
            if include(state) {
                for range in choices.ranges(state) {
                    cover(rows, range.first.index(), range.last.index(), &mut nodes.items);
                }
            }
            nodes.starts.push(nodes.items.len());
        }
        let mut starts = vec![0; 2 * rows + 1];
        nodes.items.iter().for_each(|&node| starts[node as usize + 1] += 1);
        for node in 0..2 * rows {
            starts[node + 1] += starts[node];
        }
        let mut next = starts.clone();
        let mut items = vec![0; nodes.items.len()];
        for state in 0..choices.num_states() {
            for &node in nodes.get(state) {
                items[next[node as usize]] = state as u32;
                next[node as usize] += 1;
            }
        }
        Self { rows, nodes, states: Lists { starts, items } }
    }

    /// The nodes that cover the choices of a state.
    pub(crate) fn cover(&self, state: StateId) -> &[u32] {
        self.nodes.get(state.index())
    }

    /// Starts to collect rows.
    pub(crate) fn collect(&self, policy: Direction) -> Collector<'_> {
        let needed = match policy {
            Direction::Max => vec![],
            Direction::Min => self.nodes.starts.windows(2).map(|pair| (pair[1] - pair[0]) as u32).collect(),
        };
        Collector { tree: self, policy, seen: vec![0; 2 * self.rows], needed }
    }
}

/// Finds the states one (maximising policy) or all (minimising policy) of whose rows were collected.
pub(in crate::solver) struct Collector<'a> {
    tree: &'a ChoiceTree,
    policy: Direction,
    /// Per node, how many children are complete (or: whether one was met).
    seen: Vec<u8>,
    /// Per state, how many covering nodes are incomplete.
    needed: Vec<u32>,
}

impl Collector<'_> {
    /// Collects a row, once; calls `found` for the states that are complete now (perhaps repeatedly).
    pub(crate) fn add(&mut self, row: RowId, mut found: impl FnMut(StateId)) {
        let leaf = self.tree.rows + row.index();
        let mut node = leaf;
        while node > 0 {
            self.seen[node] += 1;
            let complete = match self.policy {
                Direction::Max => self.seen[node] == 1,
                Direction::Min => node == leaf || self.seen[node] == 2,
            };
            if !complete {
                return;
            }
            for &state in self.tree.states.get(node) {
                match self.policy {
                    Direction::Max => found(StateId(state)),
                    Direction::Min => {
                        self.needed[state as usize] -= 1;
                        if self.needed[state as usize] == 0 {
                            found(StateId(state));
                        }
                    }
                }
            }
            node /= 2;
        }
    }
}

/// The nodes whose leaves are exactly `first ..= last`.
fn cover(rows: usize, first: usize, last: usize, out: &mut Vec<u32>) {
    let (mut first, mut end) = (first + rows, last + rows + 1);
    while first < end {
        if first % 2 == 1 {
            out.push(first as u32);
            first += 1;
        }
        if end % 2 == 1 {
            end -= 1;
            out.push(end as u32);
        }
        first /= 2;
        end /= 2;
    }
}
