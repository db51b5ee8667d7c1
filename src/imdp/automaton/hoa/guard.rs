//! What an edge asks of a letter.

use super::lexer::{Token, Tokens};
use super::{HoaError, HoaErrorKind};
use std::collections::HashMap;

/// More cubes than this are given up.
const MAX_CUBES: usize = 4096;

/// Parentheses and negations inside of each other.
pub(super) const MAX_DEPTH: usize = 64;

/// A Boolean combination of propositions, as a disjunction of cubes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in super::super) struct Guard(Vec<Cube>);

/// A conjunction of literals, by bit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Cube {
    positive: u64,
    negative: u64,
}

impl Guard {
    fn constant(value: bool) -> Self {
        Self(if value { vec![Cube { positive: 0, negative: 0 }] } else { vec![] })
    }

    fn literal(index: u64, value: bool) -> Self {
        let bit = 1 << index;
        Self(vec![if value {
            Cube { positive: bit, negative: 0 }
        } else {
            Cube { positive: 0, negative: bit }
        }])
    }

    /// The guard that a letter alone satisfies.
    pub(super) fn of_letter(letter: u64, propositions: usize) -> Self {
        let all = if propositions == 64 { u64::MAX } else { (1 << propositions) - 1 };
        Self(vec![Cube { positive: letter, negative: all & !letter }])
    }

    /// Whether a letter, the set of the propositions that hold, satisfies it.
    pub(in super::super) fn allows(&self, letter: u64) -> bool {
        self.0.iter().any(|cube| cube.positive & !letter == 0 && cube.negative & letter == 0)
    }

    /// Whether no letter satisfies it.
    pub(super) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// What no guard of an edge allows; none if it has too many cubes.
    pub(super) fn gap<'g>(guards: impl Iterator<Item = &'g Self>) -> Option<Self> {
        let mut left = vec![Cube { positive: 0, negative: 0 }];
        for cube in guards.flat_map(|guard| &guard.0) {
            left = left.into_iter().flat_map(|part| part.without(*cube)).collect();
            if left.len() > MAX_CUBES {
                return None;
            }
        }
        Some(Self(left))
    }

    /// Whether some letter satisfies both.
    pub(super) fn meets(&self, other: &Self) -> bool {
        self.0.iter().any(|a| other.0.iter().any(|b| a.and(*b).is_some()))
    }

    fn or(mut self, other: Self) -> Self {
        for cube in other.0 {
            if !self.0.contains(&cube) {
                self.0.push(cube);
            }
        }
        self
    }

    fn and(&self, other: &Self) -> Option<Self> {
        let mut cubes = vec![];
        for a in &self.0 {
            for cube in other.0.iter().filter_map(|b| a.and(*b)) {
                if !cubes.contains(&cube) {
                    cubes.push(cube);
                }
            }
            if cubes.len() > MAX_CUBES {
                return None;
            }
        }
        Some(Self(cubes))
    }
}

impl Cube {
    fn and(self, other: Self) -> Option<Self> {
        let both =
            Self { positive: self.positive | other.positive, negative: self.negative | other.negative };
        (both.positive & both.negative == 0).then_some(both)
    }

    /// The parts of this cube that the other leaves: for each of its literals, what violates it and no earlier one.
    fn without(self, other: Self) -> Vec<Self> {
        if self.and(other).is_none() {
            return vec![self];
        }
        let (mut rest, mut parts) = (self, vec![]);
        let open = (other.positive | other.negative) & !(self.positive | self.negative);
        for bit in (0..64).map(|index| 1u64 << index).filter(|bit| open & bit != 0) {
            let (holds, fails) = (
                Self { positive: rest.positive | bit, ..rest },
                Self { negative: rest.negative | bit, ..rest },
            );
            let (kept, cut) = if other.positive & bit != 0 { (holds, fails) } else { (fails, holds) };
            parts.push(cut);
            rest = kept;
        }
        parts
    }
}

/// A label expression, or its negation if it is not `positive`.
#[derive(Clone, Debug)]
pub(super) enum Label {
    Constant(bool),
    Proposition(u64),
    Not(Box<Self>),
    And(Vec<Self>),
    Or(Vec<Self>),
}

impl Label {
    /// Reads an expression of propositions below `propositions`.
    pub(super) fn read(
        tokens: &mut Tokens<'_>,
        aliases: &HashMap<String, Self>,
        propositions: usize,
    ) -> Result<Self, HoaError> {
        Self::disjunction(tokens, aliases, (propositions, 0))
    }

    fn disjunction(
        tokens: &mut Tokens<'_>,
        aliases: &HashMap<String, Self>,
        context: (usize, usize),
    ) -> Result<Self, HoaError> {
        let mut operands = vec![];
        loop {
            let mut factors = vec![Self::operand(tokens, aliases, context)?];
            while tokens.accept('&')? {
                factors.push(Self::operand(tokens, aliases, context)?);
            }
            operands.push(Self::And(factors));
            if !tokens.accept('|')? {
                return Ok(Self::Or(operands));
            }
        }
    }

    fn operand(
        tokens: &mut Tokens<'_>,
        aliases: &HashMap<String, Self>,
        (propositions, depth): (usize, usize),
    ) -> Result<Self, HoaError> {
        if depth == MAX_DEPTH {
            return Err(tokens.error(HoaErrorKind::TooDeep { limit: MAX_DEPTH }));
        }
        let inside = (propositions, depth + 1);
        match tokens.peek().clone() {
            Token::Symbol('!') => {
                tokens.advance()?;
                Ok(Self::Not(Box::new(Self::operand(tokens, aliases, inside)?)))
            }
            Token::Symbol('(') => {
                tokens.advance()?;
                let label = Self::disjunction(tokens, aliases, inside)?;
                tokens.expect(')')?;
                Ok(label)
            }
            Token::Word(word) if word == "t" || word == "f" => {
                tokens.advance()?;
                Ok(Self::Constant(word == "t"))
            }
            Token::Integer(_) => {
                tokens.integer("the proposition", propositions as u64).map(Self::Proposition)
            }
            Token::Alias(name) => match aliases.get(&name) {
                Some(label) => {
                    tokens.advance()?;
                    Ok(label.clone())
                }
                None => Err(tokens.unexpected("an alias that the header defines before")),
            },
            _ => Err(tokens.unexpected("a proposition's number, `t`, `f`, `!`, `(` or an alias")),
        }
    }

    /// The cubes of the expression, or of its negation.
    pub(super) fn guard(&self, is_positive: bool) -> Option<Guard> {
        let combine = |operands: &[Self], all: bool| {
            let mut result = Guard::constant(all);
            for operand in operands {
                let operand = operand.guard(is_positive)?;
                result = if all { result.and(&operand)? } else { result.or(operand) };
            }
            (result.0.len() <= MAX_CUBES).then_some(result)
        };
        match self {
            Self::Constant(value) => Some(Guard::constant(*value == is_positive)),
            Self::Proposition(index) => Some(Guard::literal(*index, is_positive)),
            Self::Not(operand) => operand.guard(!is_positive),
            Self::And(operands) => combine(operands, is_positive),
            Self::Or(operands) => combine(operands, !is_positive),
        }
    }
}

/// What kept a label from becoming a guard.
pub(super) fn too_many_cubes() -> HoaErrorKind {
    HoaErrorKind::TooMany {
        what: "alternatives in a label",
        found: MAX_CUBES as u64 + 1,
        limit: MAX_CUBES as u64,
    }
}
