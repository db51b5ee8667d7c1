//! Operands: numbers, variables, labels, and what stands in parentheses.

use super::lexer::TokenKind;
use super::parse_error::Span;
use super::parser::{Parser, Result};
use super::tree::{Filter, FilterOperator, Function, Node, NodeKind};
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
                return self.operator();
            }
            TokenKind::Word("R" | "Rmin" | "Rmax" | "Rminmin" | "Rminmax" | "Rmaxmin" | "Rmaxmax") => {
                return self.operator();
            }
            TokenKind::Word("filter") => return self.filter(),
            TokenKind::Word("min" | "max" | "mod" | "pow" | "floor" | "ceil" | "round" | "func")
                if self.token(1).kind == TokenKind::Symbol("(") =>
            {
                return self.call();
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
            return Ok(NodeKind::Decimal(text.to_owned()));
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
        if unsupported::KEYWORDS.contains(&word) || ["U", "W", "const", "label", "formula"].contains(&word) {
            return Err(self.unexpected("a formula or a number, and no keyword of PRISM"));
        }
        if self.token(1).kind == TokenKind::Symbol("(") {
            return Err(self.error(unsupported::function(word)));
        }
        Ok(NodeKind::Variable(word.to_owned()))
    }

    /// `"name"`: whatever stands in the quotes, for other tools have labels that are no identifiers.
    fn label(&mut self) -> Result<Node> {
        let start = self.span();
        let span = self.quoted().ok_or_else(|| self.unexpected("the name of a label and `\"`"))?;
        let name = self.text(span).trim().to_owned();
        let span = Span { start: start.start, end: self.previous_end() };
        self.node(NodeKind::Label(name), span)
    }

    /// `min(a,b,…)` and its like; `func(min,a,b)` is the same.
    fn call(&mut self) -> Result<Node> {
        let start = self.span();
        let is_old = self.peek() == TokenKind::Word("func");
        let mut word = self.peek();
        self.advance();
        self.expect("(", "`(`")?;
        if is_old {
            word = self.peek();
            self.advance();
            self.expect(",", "`,` and the arguments")?;
        }
        let function = match word {
            TokenKind::Word("min") => Function::Minimum,
            TokenKind::Word("max") => Function::Maximum,
            TokenKind::Word("mod") => Function::Modulo,
            TokenKind::Word("pow") => Function::Power,
            TokenKind::Word("floor") => Function::Floor,
            TokenKind::Word("ceil") => Function::Ceiling,
            TokenKind::Word("round") => Function::Round,
            _ => return Err(self.error_at(start, unsupported::FUNCTION)),
        };
        let mut arguments = vec![self.nested(Self::expression)?];
        while self.accept(",") {
            arguments.push(self.nested(Self::expression)?);
        }
        let span = start.to(self.span());
        self.expect(")", "`)` or `,`")?;
        let fits = match function {
            Function::Minimum | Function::Maximum => arguments.len() >= 2,
            Function::Modulo | Function::Power => arguments.len() == 2,
            Function::Floor | Function::Ceiling | Function::Round => arguments.len() == 1,
        };
        if !fits {
            return Err(self.error_at(span, ParseErrorKind::Arguments { found: arguments.len() }));
        }
        self.node(NodeKind::Call(function, arguments), span)
    }

    /// `filter(operator, operand, states)`
    fn filter(&mut self) -> Result<Node> {
        let start = self.span();
        self.advance();
        self.expect("(", "`(`")?;
        let operator = match self.peek() {
            TokenKind::Word("min") => FilterOperator::Minimum,
            TokenKind::Word("max") => FilterOperator::Maximum,
            TokenKind::Word("avg") => FilterOperator::Average,
            TokenKind::Word("sum") | TokenKind::Symbol("+") => FilterOperator::Sum,
            TokenKind::Word("count") => FilterOperator::Count,
            TokenKind::Word("state") => FilterOperator::State,
            TokenKind::Word("first") => FilterOperator::First,
            TokenKind::Word("forall") | TokenKind::Symbol("&") => FilterOperator::ForAll,
            TokenKind::Word("exists") | TokenKind::Symbol("|") => FilterOperator::Exists,
            TokenKind::Word("print" | "printall") => FilterOperator::Print,
            _ => return Err(self.error(unsupported::FILTER)),
        };
        self.advance();
        self.expect(",", "`,` and what is filtered")?;
        let operand = self.nested(Self::expression)?;
        let states = if self.accept(",") { Some(self.nested(Self::expression)?) } else { None };
        let span = start.to(self.span());
        self.expect(")", "`)` or `,` and the states that count")?;
        self.node(NodeKind::Filter(Box::new(Filter { operator, operand, states })), span)
    }
}
