//! PRISM's grammar of expressions.
//!
//! From the weakest operator to the strongest, as in `PrismParser.jj`: `U W R` (once), `X F G`, `?:` (to the
//! right), `=>` (to the
//! right), `<=>`, `|`, `&`, `!`, `= !=`, `< <= > >=`, `+ -`, `* /`, unary minus. A temporal operator inside
//! of another expression needs parentheses.

use super::lexer::TokenKind;
use super::parser::{Parser, Result};
use super::tree::{BinaryOperator, Node, NodeKind, StepBound, StepBounds, TemporalOperator, UntilOperator};
use super::{Relation, unsupported};

// How tightly operators bind.
const IMPLIES: u8 = 0;
const IFF: u8 = 1;
const OR: u8 = 2;
const AND: u8 = 3;
const NOT: u8 = 4;
const EQUALITY: u8 = 5;
const RELATION: u8 = 6;
const SUM: u8 = 7;
const PRODUCT: u8 = 8;
const UNARY: u8 = 9;

impl Parser<'_> {
    /// An expression that may be a path formula.
    pub(super) fn path_expression(&mut self) -> Result<Node> {
        let left = self.temporal_unary()?;
        let operator = match self.peek() {
            TokenKind::Word("U") => UntilOperator::Until,
            TokenKind::Word("W") => UntilOperator::Weak,
            TokenKind::Word("R") => UntilOperator::Release,
            _ => return Ok(left),
        };
        self.advance();
        let steps = self.step_bounds()?;
        let right = self.temporal_unary()?;
        let span = left.span.to(right.span);
        self.node(NodeKind::Until(operator, steps, Box::new([left, right])), span)
    }

    fn temporal_unary(&mut self) -> Result<Node> {
        let start = self.span();
        let operator = match self.peek() {
            TokenKind::Word("X") => TemporalOperator::Next,
            TokenKind::Word("F") => TemporalOperator::Finally,
            TokenKind::Word("G") => TemporalOperator::Globally,
            TokenKind::Word("HOA") if self.token(1).kind == TokenKind::Symbol(":") => {
                return self.automaton();
            }
            _ => return self.expression(),
        };
        self.advance();
        let bound = self.span();
        let steps = self.step_bounds()?;
        if operator == TemporalOperator::Next && !steps.is_none() {
            return Err(self.error_at(bound, unsupported::NEXT_BOUND));
        }
        let operand = self.nested(Self::temporal_unary)?;
        let span = start.to(operand.span);
        self.node(NodeKind::Temporal(operator, steps, Box::new(operand)), span)
    }

    /// An expression that is no path formula.
    pub(super) fn expression(&mut self) -> Result<Node> {
        let condition = self.binary(IMPLIES)?;
        if !self.accept("?") {
            return Ok(condition);
        }
        let then = self.nested(Self::expression)?;
        self.expect(":", "`:` and what holds otherwise")?;
        let otherwise = self.nested(Self::expression)?;
        let span = condition.span.to(otherwise.span);
        self.node(NodeKind::Conditional(Box::new([condition, then, otherwise])), span)
    }

    /// `<=k`, `<k`, `>=k`, `>k`, `=k` or `[a,b]`, if one of them comes next.
    fn step_bounds(&mut self) -> Result<StepBounds> {
        let TokenKind::Symbol(symbol) = self.peek() else { return Ok(StepBounds::default()) };
        let mut bounds = StepBounds::default();
        match symbol {
            "<=" | "<" | ">=" | ">" => {
                let bound = self.step_bound(matches!(symbol, "<" | ">"))?;
                let slot = if symbol.starts_with('<') { &mut bounds.upper } else { &mut bounds.lower };
                *slot = Some(Box::new(bound));
            }
            "=" => {
                let bound = Box::new(self.step_bound(false)?);
                (bounds.lower, bounds.upper) = (Some(bound.clone()), Some(bound));
            }
            "[" => {
                bounds.lower = Some(Box::new(self.step_bound(false)?));
                if self.peek() != TokenKind::Symbol(",") {
                    return Err(self.unexpected("`,` and the last step"));
                }
                bounds.upper = Some(Box::new(self.step_bound(false)?));
                self.expect("]", "`]`")?;
            }
            _ => {}
        }
        Ok(bounds)
    }

    /// What follows the symbol that comes next. As in PRISM, it takes what it can: `F<=8 -x=1` is bounded by `8-x`.
    pub(super) fn step_bound(&mut self, is_strict: bool) -> Result<StepBound> {
        self.advance();
        let steps = self.nested(|parser| parser.binary(SUM))?;
        Ok(StepBound { steps, is_strict })
    }

    /// Operators that bind at least as tightly as `level`.
    fn binary(&mut self, level: u8) -> Result<Node> {
        let mut left = self.unary(level)?;
        while let Some((operator, own)) = self.binary_operator()?.filter(|(_, own)| *own >= level) {
            left = match operator {
                Infix::Chain => self.chain(left, own)?,
                Infix::Binary(operator) => {
                    self.advance();
                    // Only `=>` is read from the right.
                    let next = if own == IMPLIES { own } else { own + 1 };
                    let right = self.nested(|parser| parser.binary(next))?;
                    let span = left.span.to(right.span);
                    self.node(NodeKind::Binary(operator, Box::new(left), Box::new(right)), span)?
                }
            };
        }
        Ok(left)
    }

    /// `a & b & …` or `a | b | …` from the first operator on.
    ///
    /// Long chains are common, so they are lists: as trees they would be as deep as they are long.
    fn chain(&mut self, first: Node, level: u8) -> Result<Node> {
        let symbol = self.peek();
        let start = first.span;
        let mut operands = vec![first];
        while self.peek() == symbol {
            self.advance();
            operands.push(self.nested(|parser| parser.binary(level + 1))?);
        }
        let span = start.to(operands.last().map_or(start, |last| last.span));
        self.node(if level == AND { NodeKind::And(operands) } else { NodeKind::Or(operands) }, span)
    }

    fn binary_operator(&self) -> Result<Option<(Infix, u8)>> {
        let TokenKind::Symbol(symbol) = self.peek() else { return Ok(None) };
        let compare = |comparison| Infix::Binary(BinaryOperator::Compare(comparison));
        Ok(Some(match symbol {
            "=>" => (Infix::Binary(BinaryOperator::Implies), IMPLIES),
            "<=>" => (Infix::Binary(BinaryOperator::Iff), IFF),
            "|" => (Infix::Chain, OR),
            "&" => (Infix::Chain, AND),
            "=" => (compare(Relation::Equal), EQUALITY),
            "!=" => (compare(Relation::NotEqual), EQUALITY),
            "<" => (compare(Relation::Less), RELATION),
            "<=" => (compare(Relation::LessEqual), RELATION),
            ">" => (compare(Relation::Greater), RELATION),
            ">=" => (compare(Relation::GreaterEqual), RELATION),
            "+" => (Infix::Binary(BinaryOperator::Add), SUM),
            "-" => (Infix::Binary(BinaryOperator::Subtract), SUM),
            "*" => (Infix::Binary(BinaryOperator::Multiply), PRODUCT),
            "/" => (Infix::Binary(BinaryOperator::Divide), PRODUCT),
            "^" => return Err(self.error(unsupported::POWER)),
            _ => return Ok(None),
        }))
    }

    /// A prefix operator or an operand.
    fn unary(&mut self, level: u8) -> Result<Node> {
        let start = self.span();
        match self.peek() {
            TokenKind::Symbol("!") if level <= NOT => {
                self.advance();
                let operand = self.nested(|parser| parser.binary(NOT))?;
                let span = start.to(operand.span);
                self.node(NodeKind::Not(Box::new(operand)), span)
            }
            TokenKind::Symbol("!") => Err(self.unexpected("an operand (put the negation in parentheses)")),
            TokenKind::Symbol("-") => {
                self.advance();
                let operand = self.nested(|parser| parser.binary(UNARY))?;
                let span = start.to(operand.span);
                self.node(NodeKind::Negate(Box::new(operand)), span)
            }
            _ => self.primary(),
        }
    }
}

/// An operator between two operands.
enum Infix {
    /// `&` or `|`.
    Chain,
    Binary(BinaryOperator),
}
