//! Deterministic automata whose states are all there.

use super::acceptance::AcceptanceCondition;
use super::guard::Guard;
use super::{Acceptor, Aim, Condition, Dfa, LtlError};
use crate::solver::strong_components;
use std::collections::{HashMap, HashSet};

/// An edge of an automaton.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Edge {
    pub(super) guard: Guard,
    pub(super) target: u32,
    /// The acceptance sets that it is in, by bit.
    pub(super) marks: u64,
}

/// A deterministic automaton over sets of named propositions.
///
/// Its states are `0, 1, …, num_states − 1`; the last one accepts nothing and stands for edges that are not listed. Letters
/// are sets of propositions, a bit each: bit `i` says that `propositions()[i]` holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DeterministicAutomaton {
    propositions: Vec<String>,
    start: u32,
    edges: Vec<Vec<Edge>>,
    sets: usize,
    acceptance: AcceptanceCondition,
    /// For every state: whether every continuation is accepted (`Some(true)`), or none.
    decided: Vec<Option<bool>>,
}

impl DeterministicAutomaton {
    /// From the edges of every state, the last of which is the one that accepts nothing; none if its condition has too many
    /// alternatives.
    pub(super) fn new(
        propositions: Vec<String>,
        start: u32,
        edges: Vec<Vec<Edge>>,
        (sets, acceptance): (usize, AcceptanceCondition),
    ) -> Option<Self> {
        let mut automaton = Self { propositions, start, edges, sets, acceptance, decided: vec![] };
        let accepts = automaton.satisfying(&automaton.acceptance.alternatives()?, false);
        let rejects = automaton.satisfying(&automaton.acceptance.negation().alternatives()?, true);
        let decide = |(accepts, rejects)| match (accepts, rejects) {
            (false, _) => Some(false),
            (true, false) => Some(true),
            (true, true) => None,
        };
        automaton.decided = accepts.into_iter().zip(rejects).map(decide).collect();
        Some(automaton)
    }

    /// The names of the propositions.
    pub fn propositions(&self) -> &[String] {
        &self.propositions
    }

    /// The state before the first letter.
    pub fn start(&self) -> u32 {
        self.start
    }

    /// The number of states.
    pub fn num_states(&self) -> usize {
        self.edges.len()
    }

    /// The state after a letter.
    pub fn step(&self, state: u32, letter: u64) -> u32 {
        self.edge(state, letter).map_or(self.sink(), |edge| edge.target)
    }

    /// Whether every continuation from a state is accepted (`Some(true)`) or none (`Some(false)`).
    ///
    /// A run is accepted or rejected for good as soon as it meets such a state. Where all runs do, the automaton is one for
    /// finite words.
    pub fn decided(&self, state: u32) -> Option<bool> {
        self.decided[state as usize]
    }

    fn sink(&self) -> u32 {
        self.edges.len() as u32 - 1
    }

    fn edge(&self, state: u32, letter: u64) -> Option<&Edge> {
        self.edges[state as usize].iter().find(|edge| edge.guard.allows(letter))
    }

    /// Whether an edge with such marks is in a set, or in its complement.
    fn is_in(&self, marks: u64, set: usize) -> bool {
        if set < self.sets { marks >> set & 1 == 1 } else { marks >> (set - self.sets) & 1 == 0 }
    }

    /// From which states some run satisfies one of the conditions, given whether those do that take an edge which is not
    /// listed.
    fn satisfying(&self, conditions: &[Condition], of_sink: bool) -> Vec<bool> {
        let mut found = self.cycles(conditions, |_| true);
        if let Some(sink) = found.last_mut() {
            *sink = of_sink;
        }
        self.leading_to(found)
    }

    /// Which states, of those to consider, are on a cycle of them that satisfies one of the conditions.
    fn cycles(&self, conditions: &[Condition], considered: impl Fn(u32) -> bool) -> Vec<bool> {
        let mut found = vec![false; self.edges.len()];
        for condition in conditions {
            let stays = |edge: &&Edge| {
                considered(edge.target) && !condition.finitely.iter().any(|&set| self.is_in(edge.marks, set))
            };
            let states = (0..self.edges.len()).filter(|&state| considered(state as u32));
            let components = strong_components(self.edges.len(), states, |state, out| {
                out.extend(self.edges[state].iter().filter(stays).map(|edge| edge.target));
            });
            for component in components {
                let inside: HashSet<u32> = component.iter().copied().collect();
                let edges = || component.iter().flat_map(|&state| &self.edges[state as usize]).filter(stays);
                let mut kept = edges().filter(|edge| inside.contains(&edge.target)).peekable();
                let mut is_met = kept.peek().is_some();
                for &set in &condition.infinitely {
                    let mut kept = edges().filter(|edge| inside.contains(&edge.target));
                    is_met = is_met && kept.any(|edge| self.is_in(edge.marks, set));
                }
                component.iter().for_each(|&state| found[state as usize] |= is_met);
            }
        }
        found
    }

    /// The minimal automaton for finite words, if a prefix decides every word: either all that are accepted, or all that
    /// are not.
    ///
    /// # Errors
    /// [`LtlError::Undecided`] if there is none, another [`LtlError`] if it is too large.
    pub fn on_prefixes(&self) -> Result<(Dfa, Aim), LtlError> {
        let alternatives = |condition: &AcceptanceCondition| condition.alternatives().unwrap_or_default();
        let undecided = |state: u32| self.decided(state).is_none();
        let some = |condition| self.cycles(&alternatives(condition), undecided).contains(&true);
        let aim = if !some(&self.acceptance) {
            Aim::Reach
        } else if !some(&self.acceptance.negation()) {
            Aim::Stay
        } else {
            return Err(LtlError::Undecided);
        };
        let accepts = |&state: &u32| match aim {
            Aim::Stay => self.decided(state) != Some(false),
            Aim::Reach | Aim::End => self.decided(state) == Some(true),
        };
        let step = |&state: &u32, letter| Ok(self.step(state, letter));
        let dfa = Dfa::explored(self.propositions.len(), self.start, step, accepts)?;
        Ok((dfa.minimal(aim), aim))
    }

    /// The states from which some run meets one of these.
    fn leading_to(&self, mut found: Vec<bool>) -> Vec<bool> {
        let mut sources: Vec<Vec<u32>> = vec![vec![]; self.edges.len()];
        for (state, edges) in (0u32..).zip(&self.edges) {
            edges.iter().for_each(|edge| sources[edge.target as usize].push(state));
        }
        let mut open: Vec<u32> =
            (0u32..).zip(&found).filter(|(_, found)| **found).map(|(state, _)| state).collect();
        while let Some(state) = open.pop() {
            for &source in &sources[state as usize] {
                if !std::mem::replace(&mut found[source as usize], true) {
                    open.push(source);
                }
            }
        }
        found
    }
}

/// A deterministic automaton with the marks of the last edge in its states: an acceptor of its language, or of the
/// complement.
#[derive(Debug)]
pub(crate) struct MarkedAutomaton<'a> {
    automaton: &'a DeterministicAutomaton,
    is_complement: bool,
    conditions: Vec<Condition>,
    states: Vec<(u32, u64)>,
    ids: HashMap<(u32, u64), u32>,
}

impl<'a> MarkedAutomaton<'a> {
    /// The acceptor in the state before the first letter.
    pub(crate) fn new(automaton: &'a DeterministicAutomaton, is_complement: bool) -> Self {
        let condition = match is_complement {
            true => &automaton.acceptance.negation(),
            false => &automaton.acceptance,
        };
        // Whoever made the automaton has seen that there are not too many.
        let conditions = condition.alternatives().unwrap_or_default();
        let start = (automaton.start, 0);
        Self { automaton, is_complement, conditions, states: vec![start], ids: HashMap::from([(start, 0)]) }
    }
}

impl Acceptor for MarkedAutomaton<'_> {
    fn step(&mut self, state: u32, letter: u64) -> Result<u32, LtlError> {
        let (state, _) = self.states[state as usize];
        let next = self
            .automaton
            .edge(state, letter)
            .map_or((self.automaton.sink(), 0), |edge| (edge.target, edge.marks));
        let new = self.states.len() as u32;
        let id = *self.ids.entry(next).or_insert(new);
        if id == new {
            self.states.push(next);
        }
        Ok(id)
    }

    fn decided(&self, state: u32) -> Option<bool> {
        self.automaton.decided(self.states[state as usize].0).map(|accepts| accepts != self.is_complement)
    }

    fn decides(&self, state: u32, check: usize) -> bool {
        self.automaton.is_in(self.states[state as usize].1, check)
    }

    fn conditions(&self) -> &[Condition] {
        &self.conditions
    }
}
