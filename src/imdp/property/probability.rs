//! The operator `P`, and thresholds.

use super::lexer::TokenKind;
use super::parse_error::Span;
use super::parser::{Parser, Result};
use super::tree::{Asked, Node, NodeKind};
use super::{
    Optimum, ParseErrorKind, Probability, ProbabilityError, Relation, Threshold, ThresholdComparison,
    unsupported,
};

impl Parser<'_> {
    /// `P… [ path ]`
    pub(super) fn probability(&mut self) -> Result<Node> {
        let start = self.span();
        let asked = self.asked()?;
        self.expect("[", "`[` and a path formula")?;
        let path = self.nested(Self::path_expression)?;
        let span = start.to(self.span());
        if self.peek() == TokenKind::Symbol("{") {
            return Err(self.error(unsupported::FILTER));
        }
        self.expect("]", "`]` or an operator")?;
        self.node(NodeKind::Probability(Box::new(asked), Box::new(path)), span)
    }

    /// What stands in front of the path formula. PRISM allows blanks, as in `P max min=?`.
    fn asked(&mut self) -> Result<Asked> {
        let mut suffix = String::new();
        if let TokenKind::Word(word) = self.peek() {
            suffix.push_str(&word[1..]);
        }
        self.advance();
        while let TokenKind::Word(word @ ("min" | "max" | "minmin" | "minmax" | "maxmin" | "maxmax")) =
            self.peek()
        {
            suffix.push_str(word);
            self.advance();
        }
        match self.peek() {
            TokenKind::Symbol("(") => Err(self.error(unsupported::MODIFIER)),
            TokenKind::Symbol("=") if suffix.is_empty() => Err(self.error(unsupported::NO_DIRECTION)),
            TokenKind::Symbol(symbol @ (">=" | ">" | "<=" | "<")) => {
                if !suffix.is_empty() {
                    return Err(self.error(unsupported::BOUNDED_OPTIMUM));
                }
                self.advance();
                self.bound(symbol).map(Asked::ForAll)
            }
            _ => {
                let optimum = Optimum::from_suffix(&suffix).ok_or_else(|| {
                    self.unexpected("Pmaxmin, Pmaxmax, Pminmin, Pminmax, Pmin, Pmax or P>=p")
                })?;
                self.expect("=", "`=?`")?;
                self.expect("?", "`=?`")?;
                Ok(Asked::Value(optimum))
            }
        }
    }

    /// The decimal of `P>=p [`.
    fn bound(&mut self, symbol: &str) -> Result<Threshold> {
        let comparison = match symbol {
            ">=" => ThresholdComparison::AtLeast,
            ">" => ThresholdComparison::Above,
            "<=" => ThresholdComparison::AtMost,
            _ => ThresholdComparison::Below,
        };
        let number = match self.peek() {
            TokenKind::Number(_) => self.span(),
            TokenKind::Symbol("-") => self.span().to(self.token(1).span),
            _ => return Err(self.unexpected("a probability such as 0.95")),
        };
        let probability = self.threshold(number)?;
        self.advance();
        if self.peek() != TokenKind::Symbol("[") {
            return Err(self.unexpected("`[` (a threshold is a single decimal, such as 0.95)"));
        }
        Ok(Threshold { comparison, probability })
    }

    /// The probability that stands at `span`.
    fn threshold(&self, span: Span) -> Result<Probability> {
        let text = self.text(span);
        Probability::parse(text).map_err(|error| {
            let error = if text.starts_with('-') { ProbabilityError::Range } else { error };
            self.error_at(span, ParseErrorKind::Threshold { error, found: text.to_owned() })
        })
    }

    /// The threshold of `(P…)<comparison><number>`.
    pub(super) fn verdict_threshold(&self, comparison: Relation, number: &Node) -> Result<Threshold> {
        let comparison = ThresholdComparison::from_comparison(comparison)
            .ok_or_else(|| self.wrong_kind(number, "one of >=, >, <= and < before a threshold"))?;
        match number.kind {
            NodeKind::Integer(_) | NodeKind::Decimal | NodeKind::Negate(_) => {
                Ok(Threshold { comparison, probability: self.threshold(number.span)? })
            }
            _ => Err(self.wrong_kind(number, "a threshold that is a single decimal, such as 0.95")),
        }
    }
}
