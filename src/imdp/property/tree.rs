//! Expressions of PRISM's language, before it is known which are formulas and which are integers.

use super::parse_error::Span;
use super::{Optimum, Relation, Threshold};

/// An expression and where it stands. Parentheses leave no trace.
#[derive(Debug)]
pub(super) struct Node {
    pub(super) kind: NodeKind,
    pub(super) span: Span,
    /// The length of the longest path to a leaf.
    pub(super) depth: usize,
}

#[derive(Debug)]
pub(super) enum NodeKind {
    True,
    False,
    Integer(u32),
    /// A number that is not an integer; its text is that of the span.
    Decimal,
    Label(String),
    Variable(String),
    Not(Box<Node>),
    Negate(Box<Node>),
    And(Vec<Node>),
    Or(Vec<Node>),
    Binary(BinaryOperator, Box<Node>, Box<Node>),
    /// `X`, `F` or `G`.
    Temporal(TemporalOperator, Option<u64>, Box<Node>),
    /// `left U right`.
    Until(Option<u64>, Box<Node>, Box<Node>),
    /// `P… [ path ]`.
    Probability(Box<Asked>, Box<Node>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum BinaryOperator {
    Implies,
    Iff,
    Compare(Relation),
    Add,
    Subtract,
    Multiply,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum TemporalOperator {
    Next,
    Finally,
    Globally,
}

/// What stands between `P` and its path formula.
#[derive(Debug)]
pub(super) enum Asked {
    /// `min=?` and the like.
    Value(Optimum),
    /// `>=p` and the like.
    ForAll(Threshold),
}

impl Node {
    pub(super) fn new(kind: NodeKind, span: Span) -> Self {
        let below = match &kind {
            NodeKind::Not(operand)
            | NodeKind::Negate(operand)
            | NodeKind::Temporal(_, _, operand)
            | NodeKind::Probability(_, operand) => operand.depth,
            NodeKind::And(operands) | NodeKind::Or(operands) => {
                operands.iter().map(|operand| operand.depth).max().unwrap_or(0)
            }
            NodeKind::Binary(_, left, right) | NodeKind::Until(_, left, right) => left.depth.max(right.depth),
            _ => 0,
        };
        Self { kind, span, depth: below + 1 }
    }
}
