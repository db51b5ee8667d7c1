//! Substitution, and the recognition of affine functions.

use super::graph::{Function, Graph, Node, NodeId};
use imdp::numeric::Rational;
use num_traits::{One, Zero};
use std::collections::{BTreeMap, HashMap};

/// An expression written as `Σ slope_k · v_k + rest`, where `rest` has none of the variables `v_k`.
#[derive(Clone, Debug)]
pub struct AffineForm {
    /// The slopes that are not 0, by the number of the variable.
    pub slopes: BTreeMap<u32, Rational>,
    /// What does not depend on these variables.
    pub rest: NodeId,
}

impl AffineForm {
    fn scaled(&self, factor: &Rational) -> BTreeMap<u32, Rational> {
        self.slopes.iter().map(|(&variable, slope)| (variable, slope * factor)).collect()
    }

    /// The slopes of `self + factor · other`.
    fn combined(&self, other: &Self, factor: &Rational) -> BTreeMap<u32, Rational> {
        let mut slopes = self.slopes.clone();
        for (variable, slope) in other.scaled(factor) {
            *slopes.entry(variable).or_insert_with(Rational::zero) += slope;
        }
        slopes.retain(|_, slope| !slope.is_zero());
        slopes
    }
}

impl Graph {
    /// `root` with variables replaced: number `v` by `replacements[v]`, if there is one.
    pub fn substitute(&mut self, root: NodeId, replacements: &[Option<NodeId>]) -> NodeId {
        let mut known: HashMap<NodeId, NodeId> = HashMap::new();
        for id in self.below(root) {
            let new = self.replaced(id, replacements, &known);
            self.mark_like(new, id);
            known.insert(id, new);
        }
        known[&root]
    }

    fn replaced(
        &mut self,
        id: NodeId,
        replacements: &[Option<NodeId>],
        known: &HashMap<NodeId, NodeId>,
    ) -> NodeId {
        let new = |a: NodeId| known[&a];
        match *self.node(id) {
            Node::Constant(_) | Node::Pi | Node::Enclosed(_) => id,
            Node::Variable(number) => replacements.get(number as usize).copied().flatten().unwrap_or(id),
            Node::Negate(a) => self.negate(new(a)),
            Node::Add(a, b) => self.add(new(a), new(b)),
            Node::Subtract(a, b) => self.subtract(new(a), new(b)),
            Node::Multiply(a, b) => self.multiply(new(a), new(b)),
            Node::Divide(a, b) => self.divide(new(a), new(b)),
            Node::Power(a, n) => self.power(new(a), n),
            Node::PowerReal(a, b) => self.power_real(new(a), new(b)),
            Node::Min(a, b) => self.min(new(a), new(b)),
            Node::Max(a, b) => self.max(new(a), new(b)),
            Node::Select(a, b, c) => self.select(new(a), new(b), new(c)),
            Node::Call(function, a) => self.call(function, new(a)),
        }
    }

    /// `root` as an affine function of the variables below `count`, with exact slopes; `None` if it is not
    /// recognised as one.
    pub fn affine(&mut self, root: NodeId, count: u32) -> Option<AffineForm> {
        let mut known: HashMap<NodeId, AffineForm> = HashMap::new();
        for id in self.below(root) {
            let form = self.affine_of(id, count, &known)?;
            known.insert(id, form);
        }
        known.remove(&root)
    }

    fn affine_of(
        &mut self,
        id: NodeId,
        count: u32,
        known: &HashMap<NodeId, AffineForm>,
    ) -> Option<AffineForm> {
        let one = Rational::one();
        match self.node(id).clone() {
            Node::Variable(number) if number < count => {
                let rest = self.integer(0);
                Some(AffineForm { slopes: BTreeMap::from([(number, one)]), rest })
            }
            Node::Negate(a) => {
                let rest = self.negate(known[&a].rest);
                Some(AffineForm { slopes: known[&a].scaled(&-one), rest })
            }
            Node::Add(a, b) => {
                let rest = self.add(known[&a].rest, known[&b].rest);
                Some(AffineForm { slopes: known[&a].combined(&known[&b], &one), rest })
            }
            Node::Subtract(a, b) => {
                let rest = self.subtract(known[&a].rest, known[&b].rest);
                Some(AffineForm { slopes: known[&a].combined(&known[&b], &-one), rest })
            }
            // Constant factors stand in front.
            Node::Multiply(a, b) if !known[&b].slopes.is_empty() => {
                let Node::Constant(factor) = self.node(a).clone() else { return None };
                let rest = self.multiply(a, known[&b].rest);
                Some(AffineForm { slopes: known[&b].scaled(&factor), rest })
            }
            _ => {
                let constant = self.operands(id).into_iter().flatten().all(|a| known[&a].slopes.is_empty());
                constant.then(|| AffineForm { slopes: BTreeMap::new(), rest: id })
            }
        }
    }

    /// A function without a continuous derivative in `root`, if there is one: its name.
    pub fn kink(&self, root: NodeId) -> Option<(NodeId, &'static str)> {
        self.below(root).into_iter().find_map(|id| match self.node(id) {
            Node::Min(..) => Some((id, "min or clip")),
            Node::Max(..) => Some((id, "max or clip")),
            Node::Select(..) | Node::Call(Function::Abs, _) => Some((id, "abs")),
            _ => None,
        })
    }
}
