//! Expressions of PRISM's language, before it is known which are formulas and which are numbers.

use super::parse_error::Span;
use super::{Optimum, Relation, ThresholdComparison};

/// An expression and where it stands. Parentheses leave no trace.
#[derive(Clone, Debug)]
pub(crate) struct Node {
    pub(crate) kind: NodeKind,
    pub(crate) span: Span,
    /// The length of the longest path to a leaf.
    pub(crate) depth: usize,
}

#[derive(Clone, Debug)]
pub(crate) enum NodeKind {
    True,
    False,
    Integer(u32),
    /// A number that is not an integer, as it was written.
    Decimal(String),
    Label(String),
    /// A variable, a constant or a formula.
    Variable(String),
    Not(Box<Node>),
    Negate(Box<Node>),
    And(Vec<Node>),
    Or(Vec<Node>),
    Binary(BinaryOperator, Box<Node>, Box<Node>),
    /// `condition ? then : else`
    Conditional(Box<[Node; 3]>),
    Call(Function, Vec<Node>),
    /// `X`, `F` or `G`.
    Temporal(TemporalOperator, StepBounds, Box<Node>),
    /// `left U right`, `left W right` or `left R right`.
    Until(UntilOperator, StepBounds, Box<[Node; 2]>),
    /// `HOA: {"file", …}`
    Automaton(Box<AutomatonPath>),
    /// `P… [ … ]` or `R… [ … ]`.
    Operator(Box<Operator>),
    /// `filter(…)`
    Filter(Box<Filter>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum BinaryOperator {
    Implies,
    Iff,
    Compare(Relation),
    Add,
    Subtract,
    Multiply,
    Divide,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum TemporalOperator {
    Next,
    Finally,
    Globally,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum UntilOperator {
    Until,
    Weak,
    Release,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Function {
    Minimum,
    Maximum,
    Modulo,
    Power,
    Floor,
    Ceiling,
    Round,
}

/// The steps within which something must happen: none is no bound.
#[derive(Clone, Debug, Default)]
pub(crate) struct StepBounds {
    pub(crate) lower: Option<Box<StepBound>>,
    pub(crate) upper: Option<Box<StepBound>>,
}

/// A number of steps.
#[derive(Clone, Debug)]
pub(crate) struct StepBound {
    pub(crate) steps: Node,
    /// `<` or `>` instead of `<=` or `>=`.
    pub(crate) is_strict: bool,
}

/// The runs that an automaton accepts, which stands in a file.
#[derive(Clone, Debug)]
pub(crate) struct AutomatonPath {
    pub(crate) file: std::path::PathBuf,
    /// What its propositions mean; those that are not listed are labels.
    pub(crate) propositions: Vec<(String, Node)>,
}

/// What is asked of the probability of a path formula, or of an expected reward.
#[derive(Clone, Debug)]
pub(crate) struct Operator {
    pub(crate) asked: Asked,
    pub(crate) measured: Measured,
}

#[derive(Clone, Debug)]
pub(crate) enum Measured {
    Probability(Node),
    Reward(Structure, RewardPath),
}

/// Which reward structure is meant.
#[derive(Clone, Debug)]
pub(crate) enum Structure {
    /// The first one.
    First,
    Name(String),
    /// Counted from 1.
    Number(Node),
}

/// Which rewards of a path count.
#[derive(Clone, Debug)]
pub(crate) enum RewardPath {
    /// Those before a formula holds.
    Reach(Node),
    /// Those of the first steps, or of all, discounted if a factor is given.
    Cumulative(Option<StepBound>, Option<Node>),
    /// That of the state after so many steps.
    Instantaneous(Node),
}

/// What stands between `P` and its path formula.
#[derive(Clone, Debug)]
pub(crate) enum Asked {
    /// `min=?` and the like.
    Value(Optimum),
    /// `>=p` and the like.
    ForAll(ThresholdComparison, Node),
}

#[derive(Clone, Debug)]
pub(crate) struct Filter {
    pub(crate) operator: FilterOperator,
    pub(crate) operand: Node,
    /// The states that count; all if there are none.
    pub(crate) states: Option<Node>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FilterOperator {
    Minimum,
    Maximum,
    Average,
    Sum,
    Count,
    State,
    First,
    ForAll,
    Exists,
    Print,
}

impl Node {
    pub(super) fn new(kind: NodeKind, span: Span) -> Self {
        let below = kind.children().into_iter().map(|child| child.depth).max().unwrap_or(0);
        Self { kind, span, depth: below + 1 }
    }
}

impl NodeKind {
    /// The expressions that this one is made of.
    pub(crate) fn children(&self) -> Vec<&Node> {
        match self {
            Self::True
            | Self::False
            | Self::Integer(_)
            | Self::Decimal(_)
            | Self::Label(_)
            | Self::Variable(_) => vec![],
            Self::Not(operand) | Self::Negate(operand) => vec![operand],
            Self::And(operands) | Self::Or(operands) | Self::Call(_, operands) => operands.iter().collect(),
            Self::Binary(_, left, right) => vec![left, right],
            Self::Conditional(parts) => parts.iter().collect(),
            Self::Temporal(_, bounds, operand) => bounds.nodes().chain([&**operand]).collect(),
            Self::Until(_, bounds, operands) => bounds.nodes().chain(operands.iter()).collect(),
            Self::Automaton(path) => path.propositions.iter().map(|(_, formula)| formula).collect(),
            Self::Operator(operator) => operator.nodes(),
            Self::Filter(filter) => std::iter::once(&filter.operand).chain(&filter.states).collect(),
        }
    }

    /// The same, to be changed.
    pub(super) fn children_mut(&mut self) -> Vec<&mut Node> {
        match self {
            Self::True
            | Self::False
            | Self::Integer(_)
            | Self::Decimal(_)
            | Self::Label(_)
            | Self::Variable(_) => vec![],
            Self::Not(operand) | Self::Negate(operand) => vec![operand],
            Self::And(operands) | Self::Or(operands) | Self::Call(_, operands) => {
                operands.iter_mut().collect()
            }
            Self::Binary(_, left, right) => vec![left, right],
            Self::Conditional(parts) => parts.iter_mut().collect(),
            Self::Temporal(_, bounds, operand) => bounds.nodes_mut().chain([&mut **operand]).collect(),
            Self::Until(_, bounds, operands) => bounds.nodes_mut().chain(operands.iter_mut()).collect(),
            Self::Automaton(path) => path.propositions.iter_mut().map(|(_, formula)| formula).collect(),
            Self::Operator(operator) => operator.nodes_mut(),
            Self::Filter(filter) => std::iter::once(&mut filter.operand).chain(&mut filter.states).collect(),
        }
    }
}

impl StepBounds {
    fn nodes(&self) -> impl Iterator<Item = &Node> {
        [&self.lower, &self.upper].into_iter().flatten().map(|bound| &bound.steps)
    }

    fn nodes_mut(&mut self) -> impl Iterator<Item = &mut Node> {
        [&mut self.lower, &mut self.upper].into_iter().flatten().map(|bound| &mut bound.steps)
    }

    /// Whether there is no bound.
    pub(crate) fn is_none(&self) -> bool {
        self.lower.is_none() && self.upper.is_none()
    }
}

impl Operator {
    fn nodes(&self) -> Vec<&Node> {
        let mut nodes: Vec<&Node> = match &self.asked {
            Asked::Value(_) => vec![],
            Asked::ForAll(_, threshold) => vec![threshold],
        };
        match &self.measured {
            Measured::Probability(path) => nodes.push(path),
            Measured::Reward(structure, path) => {
                if let Structure::Number(number) = structure {
                    nodes.push(number);
                }
                match path {
                    RewardPath::Reach(node) | RewardPath::Instantaneous(node) => nodes.push(node),
                    RewardPath::Cumulative(bound, discount) => {
                        nodes.extend(bound.iter().map(|bound| &bound.steps).chain(discount));
                    }
                }
            }
        }
        nodes
    }

    fn nodes_mut(&mut self) -> Vec<&mut Node> {
        let mut nodes: Vec<&mut Node> = match &mut self.asked {
            Asked::Value(_) => vec![],
            Asked::ForAll(_, threshold) => vec![threshold],
        };
        match &mut self.measured {
            Measured::Probability(path) => nodes.push(path),
            Measured::Reward(structure, path) => {
                if let Structure::Number(number) = structure {
                    nodes.push(number);
                }
                match path {
                    RewardPath::Reach(node) | RewardPath::Instantaneous(node) => nodes.push(node),
                    RewardPath::Cumulative(bound, discount) => {
                        nodes.extend(bound.iter_mut().map(|bound| &mut bound.steps).chain(discount));
                    }
                }
            }
        }
        nodes
    }
}
