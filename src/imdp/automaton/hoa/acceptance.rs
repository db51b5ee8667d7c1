//! What a run must meet infinitely often, and what finitely often.

use super::guard::MAX_DEPTH;
use super::lexer::{Token, Tokens};
use super::{HoaError, HoaErrorKind};
use crate::automaton::Condition;

/// More alternatives than this are given up.
const MAX_ALTERNATIVES: usize = 4096;

/// A condition of `Fin` and `Inf` over sets of edges.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in super::super) enum AcceptanceCondition {
    Constant(bool),
    /// `Inf(set)`; with numbers from the number of sets on, the complement of a set is meant.
    Infinitely(usize),
    /// `Fin(set)`
    Finitely(usize),
    And(Vec<Self>),
    Or(Vec<Self>),
}

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

    /// The condition that holds where this one does not.
    pub(in super::super) fn negation(&self) -> Self {
        let all = |operands: &[Self]| operands.iter().map(Self::negation).collect();
        match self {
            Self::Constant(value) => Self::Constant(!value),
            Self::Infinitely(set) => Self::Finitely(*set),
            Self::Finitely(set) => Self::Infinitely(*set),
            Self::And(operands) => Self::Or(all(operands)),
            Self::Or(operands) => Self::And(all(operands)),
        }
    }

    /// The alternatives one of which a run must satisfy; none if there are too many.
    pub(in super::super) fn alternatives(&self) -> Option<Vec<Condition>> {
        let one =
            |finitely: Vec<usize>, infinitely: Vec<usize>| Some(vec![Condition { finitely, infinitely }]);
        match self {
            Self::Constant(true) => one(vec![], vec![]),
            Self::Constant(false) => Some(vec![]),
            Self::Infinitely(set) => one(vec![], vec![*set]),
            Self::Finitely(set) => one(vec![*set], vec![]),
            Self::Or(operands) => {
                let mut all = vec![];
                for operand in operands {
                    all.extend(operand.alternatives()?);
                }
                (all.len() <= MAX_ALTERNATIVES).then_some(all)
            }
            Self::And(operands) => {
                let mut all = Self::Constant(true).alternatives()?;
                for operand in operands {
                    let own = operand.alternatives()?;
                    if all.len() * own.len() > MAX_ALTERNATIVES {
                        return None;
                    }
                    all = all.iter().flat_map(|a| own.iter().map(|b| a.and(b))).collect();
                }
                Some(all)
            }
        }
    }
}

impl Condition {
    fn and(&self, other: &Self) -> Self {
        let both = |a: &[usize], b: &[usize]| {
            let mut all = [a, b].concat();
            all.sort_unstable();
            all.dedup();
            all
        };
        Self {
            finitely: both(&self.finitely, &other.finitely),
            infinitely: both(&self.infinitely, &other.infinitely),
        }
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
