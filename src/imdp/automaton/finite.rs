//! Automata of formulas that finite words decide.
//!
//! In negation normal form a formula without `G W R` is co-safe: it is satisfied if and only if nothing but true remains of
//! it after some prefix. Without `F U M` it is safe: it is violated if and only if false remains after some prefix. So what
//! remains are the states.
//!
//! On finite words (LTLf) a formula is read as one on infinite words that are `alive` for a while and dead, without any
//! proposition, ever after (De Giacomo, Vardi, IJCAI 2013): `X a` becomes `X (alive & a)`, `F a` `F (alive & a)`, and dually. A
//! word may end where what remains holds on the dead word.

use super::dfa::{Aim, Dfa};
use super::formulas::{Dnf, Formulas, Modal};
use super::{Ltl, LtlError};

impl Dfa {
    /// The minimal automaton of a co-safe or safe formula on infinite words.
    ///
    /// # Errors
    /// [`LtlError::Undecided`] if it is neither by its form, another [`LtlError`] if it is too large.
    pub fn of_ltl(formula: &Ltl) -> Result<(Self, Aim), LtlError> {
        let mut formulas = Formulas::default();
        let start = formula.normal(true, &mut formulas)?;
        let below = formulas.below(&start);
        let aim = if !below.iter().any(|&id| formulas.is_greatest(id)) {
            Aim::Reach
        } else if !below.iter().any(|&id| formulas.is_least(id)) {
            Aim::Stay
        } else {
            return Err(LtlError::Undecided);
        };
        let accepts = |remainder: &Dnf| match aim {
            Aim::Reach | Aim::End => remainder.is_true(),
            Aim::Stay => !remainder.is_false(),
        };
        let explore = |remainder: &Dnf, letter| formulas.after(remainder, letter);
        let dfa = Self::explored(formula.propositions(), start, explore, accepts)?;
        Ok((dfa.minimal(aim), aim))
    }

    /// The minimal automaton of a formula on finite words that have a letter at least, [`Aim::End`].
    ///
    /// # Errors
    /// [`LtlError`] if the formula is too large.
    pub fn of_ltlf(formula: &Ltl) -> Result<Self, LtlError> {
        let propositions = formula.propositions();
        if propositions > Self::MAX_PROPOSITIONS {
            return Err(LtlError::Propositions { found: propositions, limit: Self::MAX_PROPOSITIONS });
        }
        let alive = propositions as u32;
        let mut formulas = Formulas::default();
        let start = while_alive(formula, alive).normal(true, &mut formulas)?;
        let explore = |remainder: &Dnf, letter| formulas.after(remainder, letter | 1 << alive);
        let dfa = Self::explored(propositions, start, explore, |remainder| formulas.on_the_dead(remainder))?;
        Ok(dfa.minimal(Aim::End))
    }
}

/// The formula on infinite words that are alive as long as the finite word lasts.
fn while_alive(formula: &Ltl, alive: u32) -> Ltl {
    let of = |operand: &Ltl| while_alive(operand, alive);
    let here = |operand: &Ltl| Ltl::And(vec![Ltl::Proposition(alive), of(operand)]);
    let unless_over = |operand: &Ltl| Ltl::Or(vec![Ltl::Not(Box::new(Ltl::Proposition(alive))), of(operand)]);
    match formula {
        Ltl::True | Ltl::Proposition(_) => formula.clone(),
        Ltl::Not(operand) => Ltl::Not(Box::new(of(operand))),
        Ltl::And(operands) => Ltl::And(operands.iter().map(of).collect()),
        Ltl::Or(operands) => Ltl::Or(operands.iter().map(of).collect()),
        Ltl::Next(operand) => Ltl::Next(Box::new(here(operand))),
        Ltl::Finally(operand) => Ltl::Finally(Box::new(here(operand))),
        Ltl::Globally(operand) => Ltl::Globally(Box::new(unless_over(operand))),
        Ltl::Until(left, right) => Ltl::Until(Box::new(of(left)), Box::new(here(right))),
        Ltl::Weak(left, right) => Ltl::Weak(Box::new(of(left)), Box::new(unless_over(right))),
        Ltl::Release(left, right) => Ltl::Release(Box::new(of(left)), Box::new(unless_over(right))),
    }
}

impl Formulas {
    /// Whether a combination holds on the infinite word whose letters are all empty.
    fn on_the_dead(&self, formula: &Dnf) -> bool {
        formula.holds(|id| match self.get(id) {
            Modal::Literal(_, positive) => !positive,
            Modal::Next(operand) | Modal::Finally(operand) | Modal::Globally(operand) => {
                self.on_the_dead(operand)
            }
            Modal::Until(_, right) | Modal::Release(_, right) => self.on_the_dead(right),
            Modal::Weak(left, right) => self.on_the_dead(left) || self.on_the_dead(right),
            Modal::Strong(left, right) => self.on_the_dead(left) && self.on_the_dead(right),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a finite word satisfies a formula from a position on, by definition.
    fn holds(formula: &Ltl, word: &[u64]) -> bool {
        let Some((&letter, rest)) = word.split_first() else { return false };
        let suffixes = || (0..word.len()).map(|i| &word[i..]);
        match formula {
            Ltl::True => true,
            Ltl::Proposition(p) => letter >> p & 1 == 1,
            Ltl::Not(a) => !holds(a, word),
            Ltl::And(all) => all.iter().all(|a| holds(a, word)),
            Ltl::Or(all) => all.iter().any(|a| holds(a, word)),
            Ltl::Next(a) => !rest.is_empty() && holds(a, rest),
            Ltl::Finally(a) => suffixes().any(|suffix| holds(a, suffix)),
            Ltl::Globally(a) => suffixes().all(|suffix| holds(a, suffix)),
            Ltl::Until(a, b) => holds(b, word) || holds(a, word) && holds(formula, rest),
            Ltl::Weak(a, b) => holds(b, word) || holds(a, word) && (rest.is_empty() || holds(formula, rest)),
            Ltl::Release(a, b) => {
                holds(b, word) && (holds(a, word) || rest.is_empty() || holds(formula, rest))
            }
        }
    }

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

    fn numbers() -> impl Iterator<Item = u32> {
        let mut seed = 7u64;
        std::iter::from_fn(move || {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            Some((seed >> 40) as u32)
        })
    }

    fn words(length: u32) -> impl Iterator<Item = Vec<u64>> {
        (0..4u64.pow(length)).map(move |code| (0..length).map(|i| code >> (2 * i) & 3).collect())
    }

    #[test]
    fn finite_words_are_accepted_if_they_satisfy_the_formula() {
        let mut numbers = numbers();
        for _ in 0..150 {
            let formula = random(&mut numbers, 3);
            let dfa = Dfa::of_ltlf(&formula).unwrap();
            for word in (1..=4).flat_map(words) {
                let known = dfa.propositions();
                let letter = |letter: &u64| letter & ((1 << known) - 1);
                let state = word.iter().map(letter).fold(dfa.start(), |q, letter| dfa.step(q, letter));
                assert_eq!(dfa.accepts(state), holds(&formula, &word), "{formula:?} on {word:?}");
            }
        }
    }

    /// A prefix decides only what every finite continuation confirms.
    #[test]
    fn prefixes_decide_safe_and_cosafe_formulas() {
        let (mut numbers, mut found) = (numbers(), [0; 3]);
        for _ in 0..400 {
            let formula = random(&mut numbers, 3);
            let Ok((dfa, aim)) = Dfa::of_ltl(&formula) else {
                found[2] += 1;
                continue;
            };
            found[usize::from(aim == Aim::Stay)] += 1;
            let letter = |letter: &u64| letter & (dfa.letters() - 1);
            for word in (1..=3).flat_map(words) {
                let state = word.iter().map(letter).fold(dfa.start(), |q, letter| dfa.step(q, letter));
                // Finite words that go on long enough satisfy what has been decided, whatever comes.
                let decided = dfa.accepts(state) == (aim == Aim::Reach);
                for end in words(2) {
                    let longer = [word.clone(), end, vec![0; 3]].concat();
                    assert!(
                        !decided || holds(&formula, &longer) == (aim == Aim::Reach),
                        "{formula:?} on {longer:?}"
                    );
                }
            }
        }
        assert!(found.iter().all(|&count| count > 20), "{found:?}");
    }

    #[test]
    fn the_package_is_delivered_by_four_states() {
        let p = |i| Box::new(Ltl::Proposition(i));
        // F (p0 & (!p1 U p2)): waiting, carrying, delivered.
        let deliver = Ltl::Until(Box::new(Ltl::Not(p(1))), p(2));
        let formula = Ltl::Finally(Box::new(Ltl::And(vec![*p(0), deliver])));
        let (dfa, aim) = Dfa::of_ltl(&formula).unwrap();
        assert_eq!((dfa.num_states(), aim), (3, Aim::Reach));
        let carrying = dfa.step(dfa.start(), 0b001);
        assert_eq!(dfa.step(carrying, 0b010), dfa.start());
        assert!(dfa.accepts(dfa.step(carrying, 0b100)) && dfa.accepts(dfa.step(0, 0b101)));
    }
}
