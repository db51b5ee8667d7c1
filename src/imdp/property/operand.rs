//! Operands: numbers, variables, labels, and what stands in parentheses.

use super::lexer::TokenKind;
use super::parser::{Parser, Result};
use super::tree::{Node, NodeKind};
use super::{ParseErrorKind, unsupported};

impl Parser<'_> {
    /// An operand without prefix operators.
    pub(super) fn primary(&mut self) -> Result<Node> {
        let start = self.span();
        let kind = match self.peek() {
            TokenKind::Symbol("(") => {
                self.advance();
                let node = self.nested(Self::path_expression)?;
                self.expect(")", "`)`")?;
                return Ok(node);
            }
            TokenKind::Symbol("\"") => return self.label(),
            TokenKind::Symbol("<<" | "[") => return Err(self.error(unsupported::STRATEGY)),
            TokenKind::Number(text) => self.number(text)?,
            TokenKind::Word("true") => NodeKind::True,
            TokenKind::Word("false") => NodeKind::False,
            TokenKind::Word("P" | "Pmin" | "Pmax" | "Pminmin" | "Pminmax" | "Pmaxmin" | "Pmaxmax") => {
                return self.probability();
            }
            TokenKind::Word(word) => self.variable(word)?,
            // What stands before `=?` was read as a variable.
            TokenKind::Symbol("?") => {
                return Err(self.unexpected("Pmaxmin, Pmaxmax, Pminmin, Pminmax, Pmin or Pmax before `=?`"));
            }
            _ => return Err(self.unexpected("a formula or a number")),
        };
        self.advance();
        self.node(kind, start)
    }

    fn number(&self, text: &str) -> Result<NodeKind> {
        let is_integer =
            text.bytes().all(|byte| byte.is_ascii_digit()) && (text == "0" || !text.starts_with('0'));
        if !is_integer {
            return Ok(NodeKind::Decimal);
        }
        match text.parse::<u32>() {
            Ok(value) if i32::try_from(value).is_ok() => Ok(NodeKind::Integer(value)),
            _ => Err(self.error(ParseErrorKind::Integer { found: text.to_owned() })),
        }
    }

    fn variable(&self, word: &str) -> Result<NodeKind> {
        if let Some(unsupported) = unsupported::keyword(word) {
            return Err(self.error(unsupported));
        }
        if unsupported::KEYWORDS.contains(&word) || ["U", "W"].contains(&word) {
            return Err(self.unexpected("a formula or a number, and no keyword of PRISM"));
        }
        if self.token(1).kind == TokenKind::Symbol("(") {
            return Err(self.error(unsupported::function(word)));
        }
        Ok(NodeKind::Variable(word.to_owned()))
    }

    /// `"name"`. Keywords are allowed: models that do not come from PRISM may have such labels.
    fn label(&mut self) -> Result<Node> {
        let start = self.span();
        self.advance();
        let TokenKind::Word(name) = self.peek() else {
            return Err(self.unexpected("the name of a label (letters, digits and `_`)"));
        };
        self.advance();
        let span = start.to(self.span());
        self.expect("\"", "`\"` after the name of a label")?;
        self.node(NodeKind::Label(name.to_owned()), span)
    }
}
