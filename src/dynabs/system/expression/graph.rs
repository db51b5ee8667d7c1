//! Expressions as one acyclic graph in which equal parts are one node.

use crate::system::Interval;
use imdp::numeric::Rational;
use num_traits::Zero;
use std::collections::HashMap;
use std::fmt;

/// A node of a [`Graph`]; its operands have smaller numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(u32);

impl NodeId {
    pub(super) fn index(self) -> usize {
        self.0 as usize
    }
}

/// A function of one argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Function {
    /// `sin`.
    Sin,
    /// `cos`.
    Cos,
    /// `tan`.
    Tan,
    /// `atan`.
    Atan,
    /// `asin`.
    Asin,
    /// `acos`.
    Acos,
    /// `sinh`.
    Sinh,
    /// `cosh`.
    Cosh,
    /// `tanh`.
    Tanh,
    /// `exp`.
    Exp,
    /// `ln`.
    Ln,
    /// `sqrt`.
    Sqrt,
    /// `abs`.
    Abs,
}

/// One operation of an expression.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// A number, exactly.
    Constant(Rational),
    /// `π`.
    Pi,
    /// A real number known only by the enclosure with this number.
    Enclosed(u32),
    /// The variable with this number.
    Variable(u32),
    /// `−a`.
    Negate(NodeId),
    /// `a + b`.
    Add(NodeId, NodeId),
    /// `a − b`.
    Subtract(NodeId, NodeId),
    /// `a · b`.
    Multiply(NodeId, NodeId),
    /// `a / b`.
    Divide(NodeId, NodeId),
    /// `aⁿ`.
    Power(NodeId, i32),
    /// `aᵇ` for positive `a`.
    PowerReal(NodeId, NodeId),
    /// `min(a, b)`.
    Min(NodeId, NodeId),
    /// `max(a, b)`.
    Max(NodeId, NodeId),
    /// The second where the first is negative, the third where it is positive, either where it is 0.
    Select(NodeId, NodeId, NodeId),
    /// A function of `a`.
    Call(Function, NodeId),
}

/// Expressions that share their common parts.
#[derive(Clone, Default)]
pub struct Graph {
    nodes: Vec<Node>,
    numbers: HashMap<Node, NodeId>,
    enclosures: Vec<Interval>,
    /// What the texts are called that nodes come from.
    texts: Vec<String>,
    /// Where a node was first written: (which text, column).
    places: HashMap<NodeId, (u32, u32)>,
}

/// The nodes, which say everything: what is written for developers is the same in every process.
impl fmt::Debug for Graph {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Graph").field("nodes", &self.nodes).finish_non_exhaustive()
    }
}

impl Graph {
    /// The operation at a node.
    pub fn node(&self, id: NodeId) -> &Node {
        &self.nodes[id.index()]
    }

    /// The number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there are no nodes.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The value that an [`Node::Enclosed`] stands for.
    pub fn enclosure(&self, number: u32) -> Interval {
        self.enclosures[number as usize]
    }

    /// Begins another text with this name; returns its number.
    pub(super) fn begin_text(&mut self, name: &str) -> u32 {
        self.texts.push(name.to_owned());
        self.texts.len() as u32 - 1
    }

    /// Remembers where a node was first written: in text number `text`, at a column from 1.
    pub(super) fn mark(&mut self, id: NodeId, text: u32, column: usize) {
        self.places.entry(id).or_insert((text, column as u32));
    }

    /// Gives a node the place of another one, which it was made from.
    pub(super) fn mark_like(&mut self, id: NodeId, origin: NodeId) {
        if let Some(&(text, column)) = self.places.get(&origin) {
            self.mark(id, text, column as usize);
        }
    }

    /// Where a node was first written: the name of the text, and the column from 1.
    pub fn place(&self, id: NodeId) -> Option<(&str, u32)> {
        self.places.get(&id).map(|&(text, column)| (self.texts[text as usize].as_str(), column))
    }

    pub(super) fn add_node(&mut self, node: Node) -> NodeId {
        if let Some(&id) = self.numbers.get(&node) {
            return id;
        }
        let id = NodeId(self.nodes.len() as u32);
        self.nodes.push(node.clone());
        self.numbers.insert(node, id);
        id
    }

    /// The number that a node is, if it is one.
    pub fn number(&self, id: NodeId) -> Option<&Rational> {
        match self.node(id) {
            Node::Constant(value) => Some(value),
            _ => None,
        }
    }

    /// Whether a node is the number 0.
    pub(super) fn is_zero(&self, id: NodeId) -> bool {
        self.number(id).is_some_and(Zero::is_zero)
    }

    /// Whether both nodes are numbers and the first is the greater one.
    pub(super) fn is_greater(&self, a: NodeId, b: NodeId) -> bool {
        matches!((self.number(a), self.number(b)), (Some(a), Some(b)) if a > b)
    }

    /// A number.
    pub fn constant(&mut self, value: Rational) -> NodeId {
        self.add_node(Node::Constant(value))
    }

    /// An integer.
    pub fn integer(&mut self, value: i32) -> NodeId {
        self.constant(Rational::from_integer(value.into()))
    }

    /// `π`.
    pub fn pi(&mut self) -> NodeId {
        self.add_node(Node::Pi)
    }

    /// A fixed real number of which only an enclosure is known; each call makes another number.
    pub fn enclosed(&mut self, enclosure: Interval) -> NodeId {
        self.enclosures.push(enclosure);
        self.add_node(Node::Enclosed(self.enclosures.len() as u32 - 1))
    }

    /// A variable.
    pub fn variable(&mut self, number: u32) -> NodeId {
        self.add_node(Node::Variable(number))
    }
}
