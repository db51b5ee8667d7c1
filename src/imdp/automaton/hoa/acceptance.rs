//! How a condition is written behind `Acceptance:`.

use super::label::MAX_DEPTH;
use super::lexer::{Token, Tokens};
use super::{HoaError, HoaErrorKind};
use crate::automaton::acceptance::{AcceptanceCondition, MAX_ALTERNATIVES};

impl AcceptanceCondition {
    /// Reads what stands behind `Acceptance:` and the number of sets.
    pub(super) fn read(tokens: &mut Tokens<'_>, sets: usize) -> Result<Self, HoaError> {
        Self::disjunction(tokens, sets, 0)
    }

    fn disjunction(tokens: &mut Tokens<'_>, sets: usize, depth: usize) -> Result<Self, HoaError> {
        let mut operands = vec![];
        loop {
            let mut factors = vec![Self::operand(tokens, sets, depth)?];
            while tokens.accept('&')? {
                factors.push(Self::operand(tokens, sets, depth)?);
            }
            operands.push(Self::And(factors));
            if !tokens.accept('|')? {
                return Ok(Self::Or(operands));
            }
        }
    }

    fn operand(tokens: &mut Tokens<'_>, sets: usize, depth: usize) -> Result<Self, HoaError> {
        if depth == MAX_DEPTH {
            return Err(tokens.error(HoaErrorKind::TooDeep { limit: MAX_DEPTH }));
        }
        if tokens.accept('(')? {
            let condition = Self::disjunction(tokens, sets, depth + 1)?;
            tokens.expect(')')?;
            return Ok(condition);
        }
        let Token::Word(word) = tokens.peek().clone() else {
            return Err(tokens.unexpected("Fin, Inf, t, f or `(`"));
        };
        let is_infinite = match word.as_str() {
            "t" | "f" => {
                tokens.advance()?;
                return Ok(Self::Constant(word == "t"));
            }
            "Inf" => true,
            "Fin" => false,
            _ => return Err(tokens.unexpected("Fin, Inf, t or f")),
        };
        tokens.advance()?;
        tokens.expect('(')?;
        let offset = if tokens.accept('!')? { sets } else { 0 };
        let set = offset + tokens.integer("the acceptance set", sets as u64)? as usize;
        tokens.expect(')')?;
        Ok(if is_infinite { Self::Infinitely(set) } else { Self::Finitely(set) })
    }
}

/// What kept a condition from being used.
pub(super) fn too_many_alternatives() -> HoaErrorKind {
    HoaErrorKind::TooMany {
        what: "alternatives in the acceptance condition",
        found: MAX_ALTERNATIVES as u64 + 1,
        limit: MAX_ALTERNATIVES as u64,
    }
}
