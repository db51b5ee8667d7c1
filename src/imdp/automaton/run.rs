//! The automaton, made state by state as it is needed.

use super::checks::{Check, Checks};
use super::formulas::{Dnf, Formulas};
use super::{Acceptor, Condition, Ltl, LtlError};
use std::collections::HashMap;

/// More states than this are given up.
const MAX_STATES: usize = 1 << 16;

/// A letter has one bit for each proposition.
const MAX_PROPOSITIONS: usize = 64;

/// A deterministic automaton whose states remember which checks the last letter decided.
#[derive(Debug)]
pub(crate) struct Automaton {
    formulas: Formulas,
    checks: Checks,
    /// What remains of the whole formula and of each check, and which checks were decided just now.
    states: Vec<State>,
    ids: HashMap<State, u32>,
    steps: HashMap<(u32, u64), u32>,
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct State {
    remainder: Dnf,
    checks: Vec<Dnf>,
    decided: Vec<bool>,
}

impl Automaton {
    /// The automaton of a formula, in the state before the first letter, which is state 0.
    ///
    /// # Errors
    /// [`LtlError`] if the formula is too large.
    pub(crate) fn new(formula: &Ltl) -> Result<Self, LtlError> {
        let found = formula.propositions();
        if found > MAX_PROPOSITIONS {
            return Err(LtlError::Propositions { found, limit: MAX_PROPOSITIONS });
        }
        let mut formulas = Formulas::default();
        let remainder = formula.normal(true, &mut formulas)?;
        let checks = Checks::new(&remainder, &mut formulas)?;
        let mut starts = vec![];
        for check in &checks.checks {
            starts.push(start(check, &remainder, &mut formulas)?);
        }
        let decided = vec![false; starts.len()];
        let mut automaton =
            Self { formulas, checks, states: vec![], ids: HashMap::new(), steps: HashMap::new() };
        automaton.id(State { remainder, checks: starts, decided })?;
        Ok(automaton)
    }

    fn id(&mut self, state: State) -> Result<u32, LtlError> {
        if let Some(&id) = self.ids.get(&state) {
            return Ok(id);
        }
        if self.states.len() >= MAX_STATES {
            return Err(LtlError::Size);
        }
        let id = self.states.len() as u32;
        self.ids.insert(state.clone(), id);
        self.states.push(state);
        Ok(id)
    }
}

impl Acceptor for Automaton {
    fn step(&mut self, state: u32, letter: u64) -> Result<u32, LtlError> {
        if let Some(&next) = self.steps.get(&(state, letter)) {
            return Ok(next);
        }
        let State { remainder, checks, .. } = self.states[state as usize].clone();
        let remainder = self.formulas.after(&remainder, letter)?;
        let mut next = State { remainder, checks: vec![], decided: vec![] };
        if next.remainder.is_true() || next.remainder.is_false() {
            // It is decided: whatever the checks do is of no interest any more.
            next.checks = vec![Dnf::truth(); checks.len()];
            next.decided = vec![false; checks.len()];
        } else {
            for (i, check) in checks.iter().enumerate() {
                let after = self.formulas.after(check, letter)?;
                let kind = &self.checks.checks[i];
                let is_decided = match kind {
                    Check::CoSafety(_) => after.is_true(),
                    Check::Remainder(_) | Check::Safety(_) => after.is_false(),
                };
                next.decided.push(is_decided);
                next.checks.push(match is_decided {
                    true => start(kind, &next.remainder, &mut self.formulas)?,
                    false => after,
                });
            }
        }
        let id = self.id(next)?;
        self.steps.insert((state, letter), id);
        Ok(id)
    }

    fn decided(&self, state: u32) -> Option<bool> {
        let remainder = &self.states[state as usize].remainder;
        match (remainder.is_true(), remainder.is_false()) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => None,
        }
    }

    fn decides(&self, state: u32, check: usize) -> bool {
        self.states[state as usize].decided[check]
    }

    fn conditions(&self) -> &[Condition] {
        &self.checks.conditions
    }
}

/// What a check has to see when it starts anew.
fn start(check: &Check, remainder: &Dnf, formulas: &mut Formulas) -> Result<Dnf, LtlError> {
    match check {
        Check::Remainder(often) => formulas.as_safety(remainder, often),
        Check::Safety(formula) | Check::CoSafety(formula) => Ok(formula.clone()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether `stem` and then `cycle` for ever is accepted.
    fn accepts(formula: &Ltl, stem: &[u64], cycle: &[u64]) -> bool {
        let mut automaton = Automaton::new(formula).unwrap();
        let mut state = 0;
        for &letter in stem {
            state = automaton.step(state, letter).unwrap();
        }
        // After as many rounds as there may be states, everything is repeated.
        let mut seen = HashMap::new();
        let mut rounds: Vec<Vec<u32>> = vec![];
        while !seen.contains_key(&state) {
            seen.insert(state, rounds.len());
            let mut round = vec![];
            for &letter in cycle {
                state = automaton.step(state, letter).unwrap();
                round.push(state);
            }
            rounds.push(round);
        }
        if let Some(decision) = automaton.decided(state) {
            return decision;
        }
        let repeated: Vec<u32> = rounds[seen[&state]..].concat();
        let decided = |check: &usize| repeated.iter().any(|&state| automaton.decides(state, *check));
        automaton.conditions().iter().any(|condition| {
            !condition.finitely.iter().any(decided) && condition.infinitely.iter().all(decided)
        })
    }

    /// Whether the word satisfies the formula at a position, by definition, on the finite graph of its positions.
    fn holds(formula: &Ltl, word: &[u64], back: usize) -> Vec<bool> {
        let n = word.len();
        let next = |i: usize| if i + 1 < n { i + 1 } else { back };
        let fixpoint = |start: bool, step: &dyn Fn(usize, &[bool]) -> bool| {
            let mut values = vec![start; n];
            for _ in 0..=n {
                values = (0..n).map(|i| step(i, &values)).collect();
            }
            values
        };
        match formula {
            Ltl::True => vec![true; n],
            Ltl::Proposition(p) => word.iter().map(|letter| letter >> p & 1 == 1).collect(),
            Ltl::Not(a) => holds(a, word, back).into_iter().map(|x| !x).collect(),
            Ltl::And(all) => {
                let parts: Vec<_> = all.iter().map(|a| holds(a, word, back)).collect();
                (0..n).map(|i| parts.iter().all(|part| part[i])).collect()
            }
            Ltl::Or(all) => {
                let parts: Vec<_> = all.iter().map(|a| holds(a, word, back)).collect();
                (0..n).map(|i| parts.iter().any(|part| part[i])).collect()
            }
            Ltl::Next(a) => {
                let a = holds(a, word, back);
                (0..n).map(|i| a[next(i)]).collect()
            }
            Ltl::Finally(a) => {
                let a = holds(a, word, back);
                fixpoint(false, &|i, v| a[i] || v[next(i)])
            }
            Ltl::Globally(a) => {
                let a = holds(a, word, back);
                fixpoint(true, &|i, v| a[i] && v[next(i)])
            }
            Ltl::Until(a, b) => {
                let (a, b) = (holds(a, word, back), holds(b, word, back));
                fixpoint(false, &|i, v| b[i] || (a[i] && v[next(i)]))
            }
            Ltl::Weak(a, b) => {
                let (a, b) = (holds(a, word, back), holds(b, word, back));
                fixpoint(true, &|i, v| b[i] || (a[i] && v[next(i)]))
            }
            Ltl::Release(a, b) => {
                let (a, b) = (holds(a, word, back), holds(b, word, back));
                fixpoint(true, &|i, v| b[i] && (a[i] || v[next(i)]))
            }
        }
    }

    /// A formula from random numbers.
    fn random(numbers: &mut impl Iterator<Item = u32>, depth: u32) -> Ltl {
        let kind = numbers.next().unwrap_or(0) % if depth == 0 { 2 } else { 11 };
        let mut operand = || Box::new(random(numbers, depth - 1));
        match kind {
            0 => Ltl::Proposition(0),
            1 => Ltl::Proposition(1),
            2 => Ltl::Not(operand()),
            3 => Ltl::And(vec![*operand(), *operand()]),
            4 => Ltl::Or(vec![*operand(), *operand()]),
            5 => Ltl::Next(operand()),
            6 => Ltl::Finally(operand()),
            7 => Ltl::Globally(operand()),
            8 => Ltl::Until(operand(), operand()),
            9 => Ltl::Weak(operand(), operand()),
            _ => Ltl::Release(operand(), operand()),
        }
    }

    #[test]
    fn words_are_accepted_if_they_satisfy_the_formula() {
        let mut seed = 1u64;
        let mut numbers = std::iter::from_fn(|| {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            Some((seed >> 40) as u32)
        });
        for round in 0..400 {
            let formula = random(&mut numbers, 3);
            for _ in 0..8 {
                let mut letters = |n: u32| -> Vec<u64> {
                    let length = numbers.next().unwrap() % 3 + n;
                    (0..length).map(|_| u64::from(numbers.next().unwrap() % 4)).collect()
                };
                let (stem, cycle) = (letters(0), letters(1));
                let word = [stem.clone(), cycle.clone()].concat();
                let expected = holds(&formula, &word, stem.len())[0];
                assert_eq!(
                    accepts(&formula, &stem, &cycle),
                    expected,
                    "{round}: {formula:?} {stem:?} {cycle:?}"
                );
            }
        }
    }
}
