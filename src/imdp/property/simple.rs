//! Questions about a single probability, the most common ones.

use super::constant::{Constant, constant};
use super::parser::{Parser, Result};
use super::tree::{
    Asked, BinaryOperator, Measured, Node, NodeKind, Operator, TemporalOperator, UntilOperator,
};
use super::{
    Compound, Inquiry, IntegerExpression, ParseErrorKind, PathFormula, Probability, ProbabilityError,
    Property, Question, Relation, StateFormula, Threshold, ThresholdComparison,
};

impl Parser<'_> {
    /// What an expression asks.
    pub(super) fn inquiry(&self, name: Option<String>, text: &str, node: Node) -> Result<Inquiry> {
        self.infer(&node)?;
        if !contains_operator(&node) {
            let expected = "a property that asks for a probability, such as Pmaxmin=? [ F \"goal\" ]";
            return Err(self.wrong_kind(&node, expected));
        }
        Ok(match self.simple(&node)? {
            Some((question, path)) => Inquiry::Probability(Property { name, question, path }),
            None => Inquiry::Compound(Compound::new(name, text, node)),
        })
    }

    /// The one probability that is asked for, if that is all and its path formula is of the simple kind.
    fn simple(&self, node: &Node) -> Result<Option<(Question, PathFormula)>> {
        let simple = |node: &Node, question| self.path(node).map(|path| path.map(|path| (question, path)));
        match &node.kind {
            NodeKind::Operator(operator) => match &**operator {
                Operator { asked: Asked::Value(optimum), measured: Measured::Probability(path) } => {
                    simple(path, Question::Value(*optimum))
                }
                Operator {
                    asked: Asked::ForAll(comparison, threshold),
                    measured: Measured::Probability(path),
                } => {
                    let probability = self.threshold(threshold, true)?;
                    simple(path, Question::ForAll(Threshold { comparison: *comparison, probability }))
                }
                _ => Ok(None),
            },
            NodeKind::Binary(BinaryOperator::Compare(comparison), left, right) => {
                let (NodeKind::Operator(operator), Some(comparison)) =
                    (&left.kind, ThresholdComparison::from_comparison(*comparison))
                else {
                    return Ok(None);
                };
                match &**operator {
                    Operator { asked: Asked::Value(optimum), measured: Measured::Probability(path) }
                        if constant(right).is_some() =>
                    {
                        let probability = self.threshold(right, true)?;
                        simple(path, Question::Verdict(*optimum, Threshold { comparison, probability }))
                    }
                    _ => Ok(None),
                }
            }
            _ => Ok(None),
        }
    }

    /// The threshold that a constant is: a probability, or any number that is not negative.
    pub(super) fn threshold(&self, node: &Node, is_probability: bool) -> Result<Probability> {
        let written = self.text(node.span);
        let failed =
            |error| self.error_at(node.span, ParseErrorKind::Threshold { error, found: written.to_owned() });
        if let (NodeKind::Integer(_) | NodeKind::Decimal(_), true) = (&node.kind, is_probability) {
            let text = match &node.kind {
                NodeKind::Integer(value) => value.to_string(),
                NodeKind::Decimal(text) => text.clone(),
                _ => String::new(),
            };
            return Probability::parse(&text).map_err(failed);
        }
        self.no_constant_without_value(node)?;
        let exact =
            constant(node).and_then(Constant::number).ok_or_else(|| failed(ProbabilityError::NotDecimal))?;
        match is_probability {
            true => Probability::of_rational(exact).map_err(failed),
            // Only that it is a number is of interest here.
            false if exact >= num_traits::Zero::zero() => {
                Probability::of_rational(num_traits::Zero::zero()).map_err(failed)
            }
            false => Err(failed(ProbabilityError::Range)),
        }
    }

    fn path(&self, node: &Node) -> Result<Option<PathFormula>> {
        Ok(match &node.kind {
            NodeKind::Temporal(operator, bounds, operand) => {
                let ((0, steps), Some(formula)) = (self.step_range(bounds)?, formula(operand)) else {
                    return Ok(None);
                };
                Some(match operator {
                    TemporalOperator::Next => PathFormula::Next(formula),
                    TemporalOperator::Finally => PathFormula::Finally { formula, steps },
                    TemporalOperator::Globally => PathFormula::Globally { formula, steps },
                })
            }
            NodeKind::Until(UntilOperator::Until, bounds, operands) => {
                let [left, right] = &**operands;
                match (self.step_range(bounds)?, formula(left), formula(right)) {
                    ((0, steps), Some(left), Some(right)) => Some(PathFormula::Until { left, right, steps }),
                    _ => None,
                }
            }
            _ => None,
        })
    }
}

/// The state formula that a node is, if it needs no solver and no numbers but integers.
pub(crate) fn formula(node: &Node) -> Option<StateFormula> {
    let boxed = |node| formula(node).map(Box::new);
    let all = |nodes: &[Node]| nodes.iter().map(formula).collect::<Option<Vec<_>>>();
    Some(match &node.kind {
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
        NodeKind::Binary(BinaryOperator::Iff, left, right) => StateFormula::Iff(boxed(left)?, boxed(right)?),
        NodeKind::Binary(BinaryOperator::Compare(comparison), left, right) => {
            compare(*comparison, left, right)?
        }
        _ => return None,
    })
}

/// `=` and `!=` also compare formulas, and then mean `<=>` and its negation.
fn compare(comparison: Relation, left: &Node, right: &Node) -> Option<StateFormula> {
    let is_equality = matches!(comparison, Relation::Equal | Relation::NotEqual);
    if is_equality && (is_formula(left) || is_formula(right)) {
        let (left, right) = (Box::new(formula(left)?), Box::new(formula(right)?));
        return Some(match comparison {
            Relation::Equal => StateFormula::Iff(left, right),
            _ => StateFormula::Differ(left, right),
        });
    }
    Some(StateFormula::Compare(integer(left)?, comparison, integer(right)?))
}

fn integer(node: &Node) -> Option<IntegerExpression> {
    let boxed = |node| integer(node).map(Box::new);
    Some(match &node.kind {
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
        _ => return None,
    })
}

/// Whether a node is certainly a formula; a variable may be either.
pub(crate) fn is_formula(node: &Node) -> bool {
    match &node.kind {
        NodeKind::Integer(_) | NodeKind::Decimal(_) | NodeKind::Variable(_) | NodeKind::Negate(_) => false,
        NodeKind::Binary(operator, ..) => {
            matches!(operator, BinaryOperator::Implies | BinaryOperator::Iff | BinaryOperator::Compare(_))
        }
        NodeKind::Conditional(parts) => is_formula(&parts[1]) || is_formula(&parts[2]),
        NodeKind::Call(..) => false,
        NodeKind::Operator(operator) => matches!(operator.asked, Asked::ForAll(..)),
        NodeKind::Filter(filter) => {
            use super::tree::FilterOperator as F;
            match filter.operator {
                F::ForAll | F::Exists => true,
                F::State | F::First | F::Print => is_formula(&filter.operand),
                _ => false,
            }
        }
        _ => true,
    }
}

/// Whether a node asks for a probability or a reward somewhere.
pub(crate) fn contains_operator(node: &Node) -> bool {
    matches!(node.kind, NodeKind::Operator(_) | NodeKind::Filter(_))
        || node.kind.children().into_iter().any(contains_operator)
}
