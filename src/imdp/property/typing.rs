//! From trees to properties: what is a formula, what is an integer.

use super::lexer::TokenKind;
use super::parser::{Parser, Result};
use super::tree::{Asked, BinaryOperator, Node, NodeKind, TemporalOperator};
use super::unsupported;
use super::{
    IntegerExpression, ParseError, ParseErrorKind, PathFormula, Property, Question, Relation, StateFormula,
};

/// Reads one property.
///
/// # Errors
/// [`ParseError`] with the place and what is wrong there; see [`parse_properties`].
pub fn parse_property(text: &str) -> std::result::Result<Property, ParseError> {
    let mut parser = Parser::new(text);
    let property = parser.property()?;
    while parser.accept(";") {}
    match parser.peek() {
        TokenKind::End => Ok(property),
        _ => Err(parser.unexpected("the end, as this is one property")),
    }
}

/// Reads a properties file: any number of properties, each with an optional `"name":`.
///
/// As in PRISM, `;` may end a property, `//` starts a comment, and line breaks are blanks.
///
/// # Errors
/// [`ParseError`] with the place and what is wrong there: the text does not follow PRISM's grammar, asks for
/// something unsupported (called by its name), or repeats a property's name.
pub fn parse_properties(text: &str) -> std::result::Result<Vec<Property>, ParseError> {
    let mut parser = Parser::new(text);
    let mut properties: Vec<Property> = vec![];
    let mut names = std::collections::HashSet::new();
    loop {
        while parser.accept(";") {}
        if parser.peek() == TokenKind::End {
            return Ok(properties);
        }
        let span = parser.span();
        let property = parser.property()?;
        if let Some(name) = property.name.clone()
            && !names.insert(name.clone())
        {
            return Err(parser.error_at(span, ParseErrorKind::DuplicateName { name }));
        }
        properties.push(property);
    }
}

impl Parser<'_> {
    fn property(&mut self) -> Result<Property> {
        let name = self.property_name().map(str::to_owned);
        if matches!(self.peek(), TokenKind::End) {
            return Err(self.unexpected("a property, such as Pmaxmin=? [ F \"goal\" ]"));
        }
        let node = self.expression()?;
        let (question, path) = self.question(&node)?;
        Ok(Property { name, question, path: self.path(path)? })
    }

    fn question<'n>(&self, node: &'n Node) -> Result<(Question, &'n Node)> {
        match &node.kind {
            NodeKind::Probability(asked, path) => match &**asked {
                Asked::Value(optimum) => Ok((Question::Value(*optimum), path)),
                Asked::ForAll(threshold) => Ok((Question::ForAll(threshold.clone()), path)),
            },
            NodeKind::Binary(BinaryOperator::Compare(comparison), left, right) => match &left.kind {
                NodeKind::Probability(asked, path) => match **asked {
                    Asked::Value(optimum) => {
                        let threshold = self.verdict_threshold(*comparison, right)?;
                        Ok((Question::Verdict(optimum, threshold), path))
                    }
                    Asked::ForAll(_) => Err(self.no_property(node)),
                },
                _ => Err(self.no_property(node)),
            },
            _ => Err(self.no_property(node)),
        }
    }

    fn no_property(&self, node: &Node) -> ParseError {
        if contains_probability(node) {
            self.error_at(node.span, unsupported::COMBINED)
        } else {
            self.wrong_kind(node, "a property that asks for a probability, such as Pmaxmin=? [ F \"goal\" ]")
        }
    }

    fn path(&self, node: &Node) -> Result<PathFormula> {
        match &node.kind {
            NodeKind::Temporal(operator, steps, operand) => {
                let (formula, steps) = (self.formula(operand)?, *steps);
                Ok(match operator {
                    TemporalOperator::Next => PathFormula::Next(formula),
                    TemporalOperator::Finally => PathFormula::Finally { formula, steps },
                    TemporalOperator::Globally => PathFormula::Globally { formula, steps },
                })
            }
            NodeKind::Until(steps, left, right) => {
                let (left, right) = (self.formula(left)?, self.formula(right)?);
                Ok(PathFormula::Until { left, right, steps: *steps })
            }
            _ => {
                // Temporal operators further down are the better explanation.
                self.formula(node)?;
                Err(self.wrong_kind(node, "a path formula, with one of the operators X, F, G and U"))
            }
        }
    }

    fn formula(&self, node: &Node) -> Result<StateFormula> {
        let boxed = |node| self.formula(node).map(Box::new);
        let all = |nodes: &[Node]| nodes.iter().map(|node| self.formula(node)).collect::<Result<Vec<_>>>();
        Ok(match &node.kind {
            NodeKind::True => StateFormula::True,
            NodeKind::False => StateFormula::False,
            NodeKind::Label(name) => StateFormula::Label(name.clone()),
            NodeKind::Variable(name) => StateFormula::Variable(name.clone()),
            NodeKind::Not(operand) => StateFormula::Not(boxed(operand)?),
            NodeKind::And(operands) => StateFormula::And(all(operands)?),
            NodeKind::Or(operands) => StateFormula::Or(all(operands)?),
            NodeKind::Binary(BinaryOperator::Implies, left, right) => {
                StateFormula::Implies(boxed(left)?, boxed(right)?)
            }
            NodeKind::Binary(BinaryOperator::Iff, left, right) => {
                StateFormula::Iff(boxed(left)?, boxed(right)?)
            }
            NodeKind::Binary(BinaryOperator::Compare(comparison), left, right) => {
                return self.comparison(*comparison, left, right);
            }
            NodeKind::Temporal(..) | NodeKind::Until(..) => {
                return Err(self.error_at(node.span, unsupported::LTL));
            }
            NodeKind::Probability(..) => return Err(self.error_at(node.span, unsupported::NESTED)),
            NodeKind::Integer(_) | NodeKind::Decimal | NodeKind::Negate(_) | NodeKind::Binary(..) => {
                return Err(self.wrong_kind(node, "a formula (compare a number with something, as in x=1)"));
            }
        })
    }

    /// `=` and `!=` also compare formulas, and then mean `<=>` and its negation.
    fn comparison(&self, comparison: Relation, left: &Node, right: &Node) -> Result<StateFormula> {
        let is_equality = matches!(comparison, Relation::Equal | Relation::NotEqual);
        if is_equality && (is_formula(left) || is_formula(right)) {
            let (left, right) = (Box::new(self.formula(left)?), Box::new(self.formula(right)?));
            return Ok(match comparison {
                Relation::Equal => StateFormula::Iff(left, right),
                _ => StateFormula::Differ(left, right),
            });
        }
        Ok(StateFormula::Compare(self.integer(left)?, comparison, self.integer(right)?))
    }

    fn integer(&self, node: &Node) -> Result<IntegerExpression> {
        let boxed = |node| self.integer(node).map(Box::new);
        Ok(match &node.kind {
            NodeKind::Integer(value) => IntegerExpression::Literal(*value),
            NodeKind::Variable(name) => IntegerExpression::Variable(name.clone()),
            NodeKind::Negate(operand) => IntegerExpression::Negate(boxed(operand)?),
            NodeKind::Binary(BinaryOperator::Add, left, right) => {
                IntegerExpression::Add(boxed(left)?, boxed(right)?)
            }
            NodeKind::Binary(BinaryOperator::Subtract, left, right) => {
                IntegerExpression::Subtract(boxed(left)?, boxed(right)?)
            }
            NodeKind::Binary(BinaryOperator::Multiply, left, right) => {
                IntegerExpression::Multiply(boxed(left)?, boxed(right)?)
            }
            NodeKind::Temporal(..) | NodeKind::Until(..) => {
                return Err(self.error_at(node.span, unsupported::LTL));
            }
            NodeKind::Probability(..) => return Err(self.error_at(node.span, unsupported::NESTED)),
            _ => return Err(self.wrong_kind(node, "an integer (a number, a variable, or + - * of them)")),
        })
    }
}

/// Whether a node is certainly a formula; a variable may be either.
fn is_formula(node: &Node) -> bool {
    !matches!(
        node.kind,
        NodeKind::Integer(_)
            | NodeKind::Decimal
            | NodeKind::Variable(_)
            | NodeKind::Negate(_)
            | NodeKind::Binary(BinaryOperator::Add | BinaryOperator::Subtract | BinaryOperator::Multiply, ..)
    )
}

fn contains_probability(node: &Node) -> bool {
    match &node.kind {
        NodeKind::Probability(..) => true,
        NodeKind::Not(operand) | NodeKind::Negate(operand) | NodeKind::Temporal(_, _, operand) => {
            contains_probability(operand)
        }
        NodeKind::And(operands) | NodeKind::Or(operands) => operands.iter().any(contains_probability),
        NodeKind::Binary(_, left, right) | NodeKind::Until(_, left, right) => {
            contains_probability(left) || contains_probability(right)
        }
        _ => false,
    }
}
