//! The operators `P` and `R`.

use super::lexer::TokenKind;
use super::parser::{Parser, Result};
use super::tree::{
    Asked, AutomatonPath, Measured, Node, NodeKind, Operator, RewardPath, StepBound, Structure,
};
use super::{Optimum, ThresholdComparison, unsupported};

impl Parser<'_> {
    /// `P… [ path ]` or `R… [ … ]`
    pub(super) fn operator(&mut self) -> Result<Node> {
        let start = self.span();
        let is_reward = matches!(self.peek(), TokenKind::Word(word) if word.starts_with('R'));
        let (structure, asked) = self.asked(is_reward)?;
        self.expect("[", "`[` and a path formula")?;
        let measured = match is_reward {
            true => Measured::Reward(structure, self.reward_path()?),
            false => Measured::Probability(self.nested(Self::path_expression)?),
        };
        let span = start.to(self.span());
        if self.peek() == TokenKind::Symbol("{") {
            return Err(self.error(unsupported::OLD_FILTER));
        }
        self.expect("]", "`]` or an operator")?;
        self.node(NodeKind::Operator(Box::new(Operator { asked, measured })), span)
    }

    /// What stands in front of the path formula. PRISM allows blanks, as in `P max min=?`.
    fn asked(&mut self, is_reward: bool) -> Result<(Structure, Asked)> {
        let mut suffix = String::new();
        if let TokenKind::Word(word) = self.peek() {
            suffix.push_str(&word[1..]);
        }
        self.advance();
        let structure = if is_reward { self.structure()? } else { Structure::First };
        while let TokenKind::Word(word @ ("min" | "max" | "minmin" | "minmax" | "maxmin" | "maxmax")) =
            self.peek()
        {
            suffix.push_str(word);
            self.advance();
        }
        match self.peek() {
            TokenKind::Symbol("(") => Err(self.error(unsupported::MODIFIER)),
            TokenKind::Symbol(symbol @ (">=" | ">" | "<=" | "<")) => {
                if !suffix.is_empty() {
                    return Err(self.error(unsupported::BOUNDED_OPTIMUM));
                }
                let comparison = match symbol {
                    ">=" => ThresholdComparison::AtLeast,
                    ">" => ThresholdComparison::Above,
                    "<=" => ThresholdComparison::AtMost,
                    _ => ThresholdComparison::Below,
                };
                let StepBound { steps: threshold, .. } = self.step_bound(false)?;
                Ok((structure, Asked::ForAll(comparison, threshold)))
            }
            _ => {
                let optimum = match suffix.as_str() {
                    "" if self.peek() == TokenKind::Symbol("=") => Optimum::Only,
                    suffix => Optimum::from_suffix(suffix).ok_or_else(|| {
                        self.unexpected(
                            "Pmaxmin, Pmaxmax, Pminmin, Pminmax, Pmin, Pmax or P>=p (or R likewise)",
                        )
                    })?,
                };
                self.expect("=", "`=?`")?;
                self.expect("?", "`=?`")?;
                Ok((structure, Asked::Value(optimum)))
            }
        }
    }

    /// `{"name"}` or `{number}`, if it comes next.
    fn structure(&mut self) -> Result<Structure> {
        if !self.accept("{") {
            return Ok(Structure::First);
        }
        let structure = match self.peek() {
            TokenKind::Symbol("\"") => match self.quoted() {
                Some(span) => Structure::Name(self.text(span).to_owned()),
                None => return Err(self.unexpected("the name of a reward structure and `\"`")),
            },
            _ => Structure::Number(self.nested(Self::expression)?),
        };
        self.expect("}", "`}`")?;
        Ok(structure)
    }

    /// `HOA: {"file", "p" <- formula, …}`
    pub(super) fn automaton(&mut self) -> Result<Node> {
        let start = self.span();
        self.advance();
        self.expect(":", "`:`")?;
        self.expect("{", "`{` and the name of a file")?;
        let Some(file) = self.quoted() else {
            return Err(self.unexpected("the name of a file in the Hanoi omega-automata format, in quotes"));
        };
        let mut path = AutomatonPath { file: self.text(file).into(), propositions: vec![] };
        while self.accept(",") {
            let Some(name) = self.quoted() else {
                return Err(self.unexpected("the name of a proposition of the automaton, in quotes"));
            };
            self.expect("<", "`<-` and a formula")?;
            self.expect("-", "`<-` and a formula")?;
            path.propositions.push((self.text(name).to_owned(), self.nested(Self::expression)?));
        }
        let span = start.to(self.span());
        self.expect("}", "`}` or `,` and what a proposition means")?;
        self.node(NodeKind::Automaton(Box::new(path)), span)
    }

    /// What stands in the brackets of `R`.
    fn reward_path(&mut self) -> Result<RewardPath> {
        match (self.peek(), self.token(1).kind) {
            (TokenKind::Word("C"), _) => {
                self.advance();
                let mut bound = None;
                if let TokenKind::Symbol(symbol @ ("<=" | "<")) = self.peek() {
                    bound = Some(self.step_bound(symbol == "<")?);
                }
                let mut discount = None;
                if self.accept(",") {
                    match self.peek() {
                        TokenKind::Word("discount") => self.advance(),
                        _ => return Err(self.unexpected("discount=0.9 or the like")),
                    }
                    self.expect("=", "`=` and a factor between 0 and 1")?;
                    discount = Some(self.nested(Self::expression)?);
                }
                Ok(RewardPath::Cumulative(bound, discount))
            }
            (TokenKind::Word("I"), TokenKind::Symbol("=")) => {
                self.advance();
                let StepBound { steps, .. } = self.step_bound(false)?;
                Ok(RewardPath::Instantaneous(steps))
            }
            (TokenKind::Word("S"), TokenKind::Symbol("]")) => Err(self.error(unsupported::STEADY)),
            _ => Ok(RewardPath::Reach(self.nested(Self::path_expression)?)),
        }
    }
}
