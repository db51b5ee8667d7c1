//! Automatic differentiation: derivatives as further nodes of the same graph.

use super::graph::{Function, Graph, Node, NodeId};
use std::collections::{HashMap, HashSet};

impl Graph {
    /// `∂root/∂variable`, an expression that shares its parts with `root` and with other derivatives.
    ///
    /// Where `abs`, `min` or `max` have a kink, the derivative is [`Node::Select`]: an element of Clarke's
    /// generalised gradient, for which the mean-value theorem holds too (Lebourg 1975).
    pub fn derivative(&mut self, root: NodeId, variable: u32) -> NodeId {
        let mut known = HashMap::new();
        for id in self.below(root) {
            let derivative = self.derivative_of(id, variable, &known);
            known.insert(id, derivative);
        }
        known[&root]
    }

    /// The nodes that `root` needs, operands first, `root` last.
    pub(super) fn below(&self, root: NodeId) -> Vec<NodeId> {
        let (mut seen, mut open) = (HashSet::from([root]), vec![root]);
        let mut nodes = Vec::new();
        while let Some(id) = open.pop() {
            nodes.push(id);
            open.extend(self.operands(id).into_iter().flatten().filter(|&operand| seen.insert(operand)));
        }
        // Operands have smaller numbers than what is made of them.
        nodes.sort_unstable();
        nodes
    }

    /// The operands of a node.
    pub(super) fn operands(&self, id: NodeId) -> [Option<NodeId>; 3] {
        match *self.node(id) {
            Node::Constant(_) | Node::Pi | Node::Enclosed(_) | Node::Variable(_) => [None; 3],
            Node::Negate(a) | Node::Power(a, _) | Node::Call(_, a) => [Some(a), None, None],
            Node::Add(a, b)
            | Node::Subtract(a, b)
            | Node::Multiply(a, b)
            | Node::Divide(a, b)
            | Node::PowerReal(a, b)
            | Node::Min(a, b)
            | Node::Max(a, b) => [Some(a), Some(b), None],
            Node::Select(a, b, c) => [Some(a), Some(b), Some(c)],
        }
    }

    fn derivative_of(&mut self, id: NodeId, variable: u32, known: &HashMap<NodeId, NodeId>) -> NodeId {
        let of = |a: &NodeId| known[a];
        match self.node(id).clone() {
            Node::Constant(_) | Node::Pi | Node::Enclosed(_) => self.integer(0),
            Node::Variable(own) => self.integer((own == variable).into()),
            Node::Negate(a) => self.negate(of(&a)),
            Node::Add(a, b) => self.add(of(&a), of(&b)),
            Node::Subtract(a, b) => self.subtract(of(&a), of(&b)),
            Node::Multiply(a, b) => {
                let (left, right) = (self.multiply(of(&a), b), self.multiply(a, of(&b)));
                self.add(left, right)
            }
            Node::Divide(a, b) => {
                // (a/b)′ = (a′ − (a/b) b′) / b
                let change = self.multiply(id, of(&b));
                let rest = self.subtract(of(&a), change);
                self.divide(rest, b)
            }
            Node::Power(a, n) => {
                let (factor, power) = (self.integer(n), self.power(a, n - 1));
                let outer = self.multiply(factor, power);
                self.multiply(outer, of(&a))
            }
            Node::PowerReal(a, b) => {
                // (aᵇ)′ = aᵇ (b′ ln a + b a′ / a)
                let logarithm = self.call(Function::Ln, a);
                let by_exponent = self.multiply(of(&b), logarithm);
                let relative = self.divide(of(&a), a);
                let by_base = self.multiply(b, relative);
                let sum = self.add(by_exponent, by_base);
                self.multiply(id, sum)
            }
            Node::Min(a, b) => {
                let test = self.subtract(a, b);
                self.select(test, of(&a), of(&b))
            }
            Node::Max(a, b) => {
                let test = self.subtract(a, b);
                self.select(test, of(&b), of(&a))
            }
            Node::Select(test, a, b) => self.select(test, of(&a), of(&b)),
            Node::Call(function, a) => {
                let inner = of(&a);
                if function == Function::Abs {
                    let falling = self.negate(inner);
                    return self.select(a, falling, inner);
                }
                let outer = self.outer_derivative(function, a, id);
                self.multiply(outer, inner)
            }
        }
    }

    /// The derivative of a smooth function at `a`, where its value is `value`.
    fn outer_derivative(&mut self, function: Function, a: NodeId, value: NodeId) -> NodeId {
        let one = self.integer(1);
        match function {
            Function::Sin => self.call(Function::Cos, a),
            Function::Cos => {
                let sine = self.call(Function::Sin, a);
                self.negate(sine)
            }
            Function::Tan => {
                let square = self.power(value, 2);
                self.add(one, square)
            }
            Function::Atan => {
                let square = self.power(a, 2);
                let sum = self.add(one, square);
                self.divide(one, sum)
            }
            Function::Asin | Function::Acos => {
                let square = self.power(a, 2);
                let rest = self.subtract(one, square);
                let root = self.call(Function::Sqrt, rest);
                let slope = self.divide(one, root);
                if function == Function::Asin { slope } else { self.negate(slope) }
            }
            Function::Sinh => self.call(Function::Cosh, a),
            Function::Cosh => self.call(Function::Sinh, a),
            Function::Tanh => {
                let square = self.power(value, 2);
                self.subtract(one, square)
            }
            Function::Exp => value,
            Function::Ln => self.divide(one, a),
            Function::Sqrt => {
                let two = self.integer(2);
                let double = self.multiply(two, value);
                self.divide(one, double)
            }
            // The caller has dealt with its kink.
            Function::Abs => one,
        }
    }
}
