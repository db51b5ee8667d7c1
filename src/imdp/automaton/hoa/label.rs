//! Labels of edges: expressions of propositions.

use super::lexer::{Token, Tokens};
use super::{HoaError, HoaErrorKind};
use crate::automaton::guard::{Guard, MAX_CUBES};
use std::collections::HashMap;

/// Parentheses and negations inside of each other.
pub(super) const MAX_DEPTH: usize = 64;

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
            (result.num_cubes() <= MAX_CUBES).then_some(result)
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
