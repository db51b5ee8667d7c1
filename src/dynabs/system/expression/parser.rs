//! From tokens to a node of a graph.
//!
//! ```text
//! sum     = product (("+" | "-") product)*
//! product = factor (("*" | "/") factor)*
//! factor  = ("+" | "-") factor | power
//! power   = atom ("^" factor)?
//! atom    = number | name | function "(" sum ("," sum)* ")" | "(" sum ")"
//! ```

use super::functions::{CHOOSERS, FUNCTIONS, is_reserved};
use super::graph::{Graph, NodeId};
use super::lexer::{Placed, Token, tokens};
use super::{ExpressionError, Scope};

/// The deepest nesting of parentheses, signs and exponents.
const MAX_DEPTH: usize = 200;

/// Reads `text`, which is number `number` of the texts that places refer to.
pub(super) fn parse(
    graph: &mut Graph,
    scope: &Scope,
    text: &str,
    number: u32,
) -> Result<NodeId, ExpressionError> {
    let mut parser = Parser { graph, scope, tokens: tokens(text)?, at: 0, depth: 0, number };
    let root = parser.sum()?;
    match parser.peek() {
        Token::End => Ok(root),
        Token::Number(_) | Token::Name(_) | Token::Symbol('(') => Err(parser
            .unexpected("an operator + - * / ^")
            .remedy("Products are written with *: 2*x, not 2 x.")),
        _ => Err(parser.unexpected("an operator + - * / ^ or the end of the expression")),
    }
}

struct Parser<'a> {
    graph: &'a mut Graph,
    scope: &'a Scope,
    tokens: Vec<Placed>,
    at: usize,
    depth: usize,
    number: u32,
}

impl Parser<'_> {
    fn peek(&self) -> &Token {
        &self.tokens[self.at].token
    }

    fn column(&self) -> usize {
        self.tokens[self.at].column
    }

    /// The next token; the end is never passed.
    fn next(&mut self) -> Placed {
        let placed = self.tokens[self.at].clone();
        self.at = (self.at + 1).min(self.tokens.len() - 1);
        placed
    }

    /// Takes one of these symbols if it is next.
    fn take(&mut self, symbols: &[char]) -> Option<(char, usize)> {
        match *self.peek() {
            Token::Symbol(symbol) if symbols.contains(&symbol) => Some((symbol, self.next().column)),
            _ => None,
        }
    }

    fn unexpected(&self, expected: impl Into<String>) -> ExpressionError {
        ExpressionError::new(self.column(), self.peek().describe(), expected)
    }

    fn mark(&mut self, node: NodeId, column: usize) -> NodeId {
        self.graph.mark(node, self.number, column);
        node
    }

    fn sum(&mut self) -> Result<NodeId, ExpressionError> {
        let mut left = self.product()?;
        while let Some((operator, column)) = self.take(&['+', '-']) {
            let right = self.product()?;
            left =
                if operator == '+' { self.graph.add(left, right) } else { self.graph.subtract(left, right) };
            self.mark(left, column);
        }
        Ok(left)
    }

    fn product(&mut self) -> Result<NodeId, ExpressionError> {
        let mut left = self.factor()?;
        while let Some((operator, column)) = self.take(&['*', '/']) {
            let right = self.factor()?;
            if operator == '/' && self.graph.is_zero(right) {
                return Err(ExpressionError::new(column, "a division by 0", "a divisor that is not 0"));
            }
            left = if operator == '*' {
                self.graph.multiply(left, right)
            } else {
                self.graph.divide(left, right)
            };
            self.mark(left, column);
        }
        Ok(left)
    }

    fn factor(&mut self) -> Result<NodeId, ExpressionError> {
        self.deeper()?;
        let factor = match self.take(&['+', '-']) {
            Some(('-', column)) => {
                let inner = self.factor()?;
                let negated = self.graph.negate(inner);
                Ok(self.mark(negated, column))
            }
            Some(_) => self.factor(),
            None => self.power(),
        };
        self.depth -= 1;
        factor
    }

    fn deeper(&mut self) -> Result<(), ExpressionError> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            let found = format!("parentheses, signs or exponents nested more than {MAX_DEPTH} deep");
            return Err(ExpressionError::new(self.column(), found, "a flatter expression")
                .remedy("Name inner parts under \"definitions\"."));
        }
        Ok(())
    }

    fn power(&mut self) -> Result<NodeId, ExpressionError> {
        let base = self.atom()?;
        let Some((_, column)) = self.take(&['^']) else { return Ok(base) };
        let exponent = self.factor()?;
        let power = self.graph.power_real(base, exponent);
        Ok(self.mark(power, column))
    }

    fn atom(&mut self) -> Result<NodeId, ExpressionError> {
        let operand = "a number, a name, a function or \"(\"";
        match self.peek() {
            Token::Symbol('(') => {
                self.next();
                let inner = self.sum()?;
                self.close()?;
                Ok(inner)
            }
            Token::Number(_) | Token::Name(_) => {
                let Placed { token, column } = self.next();
                match token {
                    Token::Name(name) => self.name(&name, column),
                    Token::Number(value) => Ok(self.graph.constant(value)),
                    Token::Symbol(_) | Token::End => Err(self.unexpected(operand)),
                }
            }
            _ => Err(self.unexpected(operand)),
        }
    }

    fn close(&mut self) -> Result<(), ExpressionError> {
        match self.take(&[')']) {
            Some(_) => Ok(()),
            None => Err(self.unexpected("an operator or \")\"")),
        }
    }

    fn name(&mut self, name: &str, column: usize) -> Result<NodeId, ExpressionError> {
        if *self.peek() == Token::Symbol('(') {
            return self.call(name, column);
        }
        if name == "pi" {
            return Ok(self.graph.pi());
        }
        if is_reserved(name) {
            return Err(self.unexpected(format!("\"(\" after the function {name}")));
        }
        self.scope.get(name).ok_or_else(|| {
            let error =
                ExpressionError::new(column, format!("the unknown name \"{name}\""), self.scope.describe());
            match name {
                "e" => error.remedy("Euler's number is exp(1)."),
                _ => error,
            }
        })
    }

    fn call(&mut self, name: &str, column: usize) -> Result<NodeId, ExpressionError> {
        let function = FUNCTIONS.iter().find(|(own, _)| *own == name).map(|(_, function)| *function);
        let chooser = CHOOSERS.iter().find(|(own, _)| *own == name).map(|(_, count)| *count);
        if function.is_none() && chooser.is_none() {
            let names: Vec<_> = FUNCTIONS.iter().map(|(own, _)| *own).chain(["min", "max", "clip"]).collect();
            let error =
                ExpressionError::new(column, format!("the unknown function \"{name}\""), names.join(", "));
            return Err(match name {
                "log" => error.remedy("The natural logarithm is ln."),
                "pow" => error.remedy("Powers are written with ^."),
                "atan2" => error.remedy("Use atan(y/x) where x keeps its sign."),
                _ => error,
            });
        }
        self.next();
        let mut arguments = vec![self.sum()?];
        while self.take(&[',']).is_some() {
            arguments.push(self.sum()?);
        }
        let count = chooser.unwrap_or(1);
        if arguments.len() != count {
            let found = format!("{} arguments of {name}", arguments.len());
            return Err(ExpressionError::new(column, found, count.to_string()));
        }
        self.close()?;
        let node = match (function, arguments[..].as_ref(), name) {
            (Some(function), [x, ..], _) => self.graph.call(function, *x),
            (None, [x, y], "min") => self.graph.min(*x, *y),
            (None, [x, low, high], _) => {
                if self.graph.is_greater(*low, *high) {
                    return Err(ExpressionError::new(
                        column,
                        "a clip whose lower bound is above its upper bound",
                        "clip(x, lower, upper)",
                    ));
                }
                let below = self.graph.min(*x, *high);
                self.graph.max(*low, below)
            }
            (None, [x, y], _) => self.graph.max(*x, *y),
            _ => return Err(self.unexpected("an argument")),
        };
        Ok(self.mark(node, column))
    }
}
