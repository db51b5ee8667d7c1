//! Complete deterministic automata over sets of propositions, which read finite words.

use super::LtlError;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;

/// How the states of an automaton decide a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Aim {
    /// To come to an accepting state.
    #[default]
    Reach,
    /// To be in an accepting state after every letter.
    Stay,
    /// To be in an accepting state after the last letter.
    End,
}

/// A complete deterministic automaton whose letters are sets of the propositions `0 … k − 1`, as bits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Dfa {
    propositions: u32,
    start: u32,
    /// `state · 2ᵏ + letter`.
    next: Vec<u32>,
    accepting: Vec<bool>,
}

impl Dfa {
    /// More propositions make too many letters.
    pub const MAX_PROPOSITIONS: usize = 12;

    /// More transitions than this are given up.
    const MAX_TRANSITIONS: usize = 1 << 24;

    /// An automaton from its transitions: `explore(state, letter)` names the next state by its content.
    ///
    /// # Errors
    /// [`LtlError`] if there are too many propositions or transitions, or what `explore` and `accepts` return.
    pub(super) fn explored<S: Clone + Eq + std::hash::Hash>(
        propositions: usize,
        start: S,
        mut explore: impl FnMut(&S, u64) -> Result<S, LtlError>,
        mut accepts: impl FnMut(&S) -> bool,
    ) -> Result<Self, LtlError> {
        if propositions > Self::MAX_PROPOSITIONS {
            return Err(LtlError::Propositions { found: propositions, limit: Self::MAX_PROPOSITIONS });
        }
        let letters = 1u64 << propositions;
        let (mut states, mut ids) = (vec![start.clone()], HashMap::from([(start, 0)]));
        let (mut next, mut accepting) = (vec![], vec![]);
        while let Some(state) = states.get(accepting.len()).cloned() {
            accepting.push(accepts(&state));
            for letter in 0..letters {
                let to = explore(&state, letter)?;
                let fresh = states.len() as u32;
                let id = *ids.entry(to.clone()).or_insert(fresh);
                if id == fresh {
                    states.push(to);
                }
                next.push(id);
            }
            if next.len() > Self::MAX_TRANSITIONS {
                return Err(LtlError::Size);
            }
        }
        Ok(Self { propositions: propositions as u32, start: 0, next, accepting })
    }

    /// An automaton from its parts: `next[state · 2ᵏ + letter]` and whether each state accepts.
    pub fn from_parts(propositions: u32, start: u32, next: Vec<u32>, accepting: Vec<bool>) -> Self {
        Self { propositions, start, next, accepting }
    }

    /// The number of propositions, `k`.
    pub fn propositions(&self) -> u32 {
        self.propositions
    }

    /// The number of letters, `2ᵏ`.
    pub fn letters(&self) -> u64 {
        1 << self.propositions
    }

    /// The number of states.
    pub fn num_states(&self) -> u32 {
        self.accepting.len() as u32
    }

    /// The state before the first letter.
    pub fn start(&self) -> u32 {
        self.start
    }

    /// The state after a letter.
    pub fn step(&self, state: u32, letter: u64) -> u32 {
        self.next[((u64::from(state) << self.propositions) + letter) as usize]
    }

    /// Whether a state is accepting.
    pub fn accepts(&self, state: u32) -> bool {
        self.accepting[state as usize]
    }

    /// Whether a state is never left.
    pub fn is_sink(&self, state: u32) -> bool {
        (0..self.letters()).all(|letter| self.step(state, letter) == state)
    }

    /// The states that words lead to, in the order in which they are met.
    fn reachable(&self) -> Vec<u32> {
        let (mut met, mut known) = (vec![self.start], vec![false; self.accepting.len()]);
        known[self.start as usize] = true;
        let mut at = 0;
        while let Some(&state) = met.get(at) {
            at += 1;
            for letter in 0..self.letters() {
                let to = self.step(state, letter);
                if !std::mem::replace(&mut known[to as usize], true) {
                    met.push(to);
                }
            }
        }
        met
    }

    /// The automaton with one more proposition, the last one, which must not hold before the word is decided.
    #[must_use]
    pub fn guarded(&self) -> Self {
        let sink = self.num_states();
        let next = (0..sink).flat_map(|state| {
            let free = (0..self.letters()).map(move |letter| self.step(state, letter));
            free.chain((0..self.letters()).map(move |_| sink))
        });
        let mut accepting = self.accepting.clone();
        accepting.push(false);
        Self {
            propositions: self.propositions + 1,
            start: self.start,
            next: next.chain((0..2 * self.letters()).map(|_| sink)).collect(),
            accepting,
        }
    }

    /// The smallest automaton that decides the same words for this aim, its states in the order in which words meet them.
    ///
    /// What comes after the decision does not matter: accepting states of [`Aim::Reach`] and rejecting ones of
    /// [`Aim::Stay`] become sinks. Blocks of equivalent states are refined until they are stable (Moore).
    #[must_use]
    pub fn minimal(&self, aim: Aim) -> Self {
        let decided = |state: u32| match aim {
            Aim::Reach => self.accepts(state),
            // Before the first letter nothing is asked.
            Aim::Stay => !self.accepts(state) && state != self.start,
            Aim::End => false,
        };
        let step = |state: u32, letter: u64| if decided(state) { state } else { self.step(state, letter) };
        let states: Vec<u32> = (0..self.num_states()).collect();
        let mut block: Vec<u32> = self.accepting.iter().map(|&accepts| accepts.into()).collect();
        if aim == Aim::Stay {
            block[self.start as usize] = 1;
        }
        let mut count = 0;
        loop {
            let mut signatures: HashMap<Vec<u32>, u32> = HashMap::new();
            let refined: Vec<u32> = (states.iter())
                .map(|&state| {
                    let after = (0..self.letters()).map(|letter| block[step(state, letter) as usize]);
                    let signature = std::iter::once(block[state as usize]).chain(after).collect();
                    let fresh = signatures.len() as u32;
                    *signatures.entry(signature).or_insert(fresh)
                })
                .collect();
            block = refined;
            if signatures.len() == count {
                break;
            }
            count = signatures.len();
        }
        let mut representative = vec![self.start; count];
        states.iter().rev().for_each(|&state| representative[block[state as usize] as usize] = state);
        let quotient = Self {
            propositions: self.propositions,
            start: block[self.start as usize],
            next: (representative.iter())
                .flat_map(|&state| (0..self.letters()).map(move |letter| (state, letter)))
                .map(|(state, letter)| block[step(state, letter) as usize])
                .collect(),
            accepting: representative
                .iter()
                .map(|&state| self.accepts(state) || aim == Aim::Stay && state == self.start)
                .collect(),
        };
        quotient.renumbered()
    }

    /// Only what words lead to, in the order in which they do.
    fn renumbered(&self) -> Self {
        let order = self.reachable();
        let mut number = vec![0; self.accepting.len()];
        order.iter().enumerate().for_each(|(new, &old)| number[old as usize] = new as u32);
        let next = order.iter().flat_map(|&state| (0..self.letters()).map(move |letter| (state, letter)));
        Self {
            propositions: self.propositions,
            start: 0,
            next: next.map(|(state, letter)| number[self.step(state, letter) as usize]).collect(),
            accepting: order.iter().map(|&state| self.accepts(state)).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two states that take turns being accepting until the letter 1, doubled.
    fn doubled() -> Dfa {
        // 0, 1 wait and are equivalent; 2, 3 accept and return.
        Dfa::from_parts(1, 0, vec![1, 2, 0, 3, 0, 1, 1, 0], vec![false, false, true, true])
    }

    #[test]
    fn equivalent_states_become_one() {
        let last = doubled().minimal(Aim::End);
        assert_eq!(last, Dfa::from_parts(1, 0, vec![0, 1, 0, 0], vec![false, true]));
        let reach = doubled().minimal(Aim::Reach);
        assert_eq!(reach, Dfa::from_parts(1, 0, vec![0, 1, 1, 1], vec![false, true]));
    }

    #[test]
    fn guards_reject_until_the_word_is_decided() {
        let guarded = doubled().guarded().minimal(Aim::Reach);
        let (reached, lost) = (guarded.step(0, 0b01), guarded.step(0, 0b11));
        assert!(guarded.accepts(reached) && guarded.step(reached, 0b10) == reached);
        assert!(!guarded.accepts(lost) && guarded.is_sink(lost) && guarded.step(0, 0b10) == lost);
    }

    #[test]
    fn what_is_asked_to_stay_fails_for_ever() {
        // Accepting while the letter is 1; the start accepts nothing, but nothing is asked of it.
        let dfa = Dfa::from_parts(1, 2, vec![1, 0, 0, 0, 1, 0], vec![true, false, false]);
        let stay = dfa.minimal(Aim::Stay);
        assert_eq!(stay, Dfa::from_parts(1, 0, vec![1, 0, 1, 1], vec![true, false]));
    }
}
