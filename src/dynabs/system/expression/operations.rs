//! The operations of a graph, each simplified as far as that is exact.

use super::graph::{Function, Graph, Node, NodeId};
use imdp::numeric::Rational;
use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// Constants with more bits than this are no longer combined exactly.
const MAX_BITS: u64 = 4096;
/// The largest exponent of an integer power.
const MAX_POWER: i32 = 1 << 20;
/// The largest exponent for which a power of a constant is taken exactly.
const MAX_EXACT_POWER: i32 = 64;

impl Graph {
    fn is(&self, id: NodeId, value: i32) -> bool {
        self.number(id).is_some_and(|own| *own == Rational::from_integer(value.into()))
    }

    /// Two constants combined exactly, unless the result is unreasonably long.
    fn combined(
        &mut self,
        a: NodeId,
        b: NodeId,
        combine: impl Fn(&Rational, &Rational) -> Rational,
    ) -> Option<NodeId> {
        let value = combine(self.number(a)?, self.number(b)?);
        (value.numer().bits().max(value.denom().bits()) <= MAX_BITS).then(|| self.constant(value))
    }

    /// `−a`.
    pub fn negate(&mut self, a: NodeId) -> NodeId {
        match self.node(a).clone() {
            Node::Constant(value) => self.constant(-value),
            Node::Negate(inner) => inner,
            Node::Subtract(x, y) => self.subtract(y, x),
            _ => self.add_node(Node::Negate(a)),
        }
    }

    /// `a + b`.
    pub fn add(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if let Some(sum) = self.combined(a, b, |a, b| a + b) {
            return sum;
        }
        if self.is(a, 0) {
            return b;
        }
        if self.is(b, 0) {
            return a;
        }
        if a == b {
            let two = self.integer(2);
            return self.multiply(two, a);
        }
        match (self.node(a).clone(), self.node(b).clone()) {
            (_, Node::Negate(b)) => self.subtract(a, b),
            (Node::Negate(a), _) => self.subtract(b, a),
            _ => self.add_node(Node::Add(a.min(b), a.max(b))),
        }
    }

    /// `a − b`.
    pub fn subtract(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if let Some(difference) = self.combined(a, b, |a, b| a - b) {
            return difference;
        }
        if self.is(b, 0) {
            return a;
        }
        if self.is(a, 0) {
            return self.negate(b);
        }
        if a == b {
            return self.integer(0);
        }
        match self.node(b).clone() {
            Node::Negate(b) => self.add(a, b),
            _ => self.add_node(Node::Subtract(a, b)),
        }
    }

    /// `a · b`.
    pub fn multiply(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if let Some(product) = self.combined(a, b, |a, b| a * b) {
            return product;
        }
        if self.is(a, 0) || self.is(b, 0) {
            return self.integer(0);
        }
        if self.is(a, 1) {
            return b;
        }
        if self.is(b, 1) {
            return a;
        }
        if self.is(a, -1) {
            return self.negate(b);
        }
        if self.is(b, -1) {
            return self.negate(a);
        }
        // Powers of one base are one power: x·x has no negative values, which x·y could have.
        let (base_a, exponent_a) = self.as_power(a);
        let (base_b, exponent_b) = self.as_power(b);
        if base_a == base_b && exponent_a > 0 && exponent_b > 0 && exponent_a + exponent_b <= MAX_POWER {
            return self.power(base_a, exponent_a + exponent_b);
        }
        // A constant factor goes to the front, and two of them become one.
        let (a, b) = if self.number(b).is_some() { (b, a) } else { (a, b) };
        if let (true, Node::Multiply(c, rest)) = (self.number(a).is_some(), self.node(b).clone())
            && let Some(factor) = self.combined(a, c, |a, c| a * c)
        {
            return self.multiply(factor, rest);
        }
        let (a, b) = if self.number(a).is_some() { (a, b) } else { (a.min(b), a.max(b)) };
        self.add_node(Node::Multiply(a, b))
    }

    fn as_power(&self, a: NodeId) -> (NodeId, i32) {
        match self.node(a) {
            Node::Power(base, exponent) => (*base, *exponent),
            _ => (a, 1),
        }
    }

    /// `a / b`; a division by the constant 0 stays as it is, for whoever evaluates it to refuse.
    pub fn divide(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match self.number(b).cloned() {
            Some(divisor) if !divisor.is_zero() => {
                let factor = self.constant(divisor.recip());
                self.multiply(factor, a)
            }
            Some(_) => self.add_node(Node::Divide(a, b)),
            None if self.is(a, 0) => a,
            None => self.add_node(Node::Divide(a, b)),
        }
    }

    /// `aⁿ` for `|n| ≤ 2²⁰`.
    pub fn power(&mut self, a: NodeId, n: i32) -> NodeId {
        match (n, self.node(a).clone()) {
            (0, _) => return self.integer(1),
            (1, _) => return a,
            (_, Node::Constant(value)) if n.abs() <= MAX_EXACT_POWER && !(n < 0 && value.is_zero()) => {
                let exact = num_traits::Pow::pow(&value, n);
                if exact.numer().bits().max(exact.denom().bits()) <= MAX_BITS {
                    return self.constant(exact);
                }
            }
            (_, Node::Power(base, m))
                if m > 0 && n > 0 && i64::from(m) * i64::from(n) <= MAX_POWER.into() =>
            {
                return self.add_node(Node::Power(base, m * n));
            }
            _ => {}
        }
        self.add_node(Node::Power(a, n))
    }

    /// `aᵇ`: an integer power or a square root if `b` says so, else defined for positive `a` only.
    pub fn power_real(&mut self, a: NodeId, b: NodeId) -> NodeId {
        if let Some(value) = self.number(b).cloned() {
            if let Some(n) = value.is_integer().then(|| value.to_integer().to_i32()).flatten()
                && n.abs() <= MAX_POWER
            {
                return self.power(a, n);
            }
            if value == Rational::new(1.into(), 2.into()) {
                return self.call(Function::Sqrt, a);
            }
        }
        self.add_node(Node::PowerReal(a, b))
    }

    /// `min(a, b)`.
    pub fn min(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match self.combined(a, b, |a, b| a.min(b).clone()) {
            Some(least) => least,
            None if a == b => a,
            None => self.add_node(Node::Min(a.min(b), a.max(b))),
        }
    }

    /// `max(a, b)`.
    pub fn max(&mut self, a: NodeId, b: NodeId) -> NodeId {
        match self.combined(a, b, |a, b| a.max(b).clone()) {
            Some(greatest) => greatest,
            None if a == b => a,
            None => self.add_node(Node::Max(a.min(b), a.max(b))),
        }
    }

    /// `negative` where `test < 0`, `positive` where `test > 0`, either where it is 0.
    pub fn select(&mut self, test: NodeId, negative: NodeId, positive: NodeId) -> NodeId {
        match self.number(test) {
            Some(value) if value.is_negative() => negative,
            Some(value) if value.is_positive() => positive,
            _ if negative == positive => negative,
            _ => self.add_node(Node::Select(test, negative, positive)),
        }
    }

    /// A function of `a`; exact values of constants are taken.
    pub fn call(&mut self, function: Function, a: NodeId) -> NodeId {
        if let Some(exact) = self.number(a).and_then(|value| exact_value(function, value)) {
            return self.constant(exact);
        }
        self.add_node(Node::Call(function, a))
    }
}

/// The value of a function of a number, where it is a number that can be written down.
fn exact_value(function: Function, x: &Rational) -> Option<Rational> {
    match function {
        Function::Abs => Some(x.abs()),
        Function::Cos | Function::Cosh | Function::Exp if x.is_zero() => Some(Rational::one()),
        Function::Ln if x.is_one() => Some(Rational::zero()),
        Function::Acos if x.is_one() => Some(Rational::zero()),
        Function::Sqrt if !x.is_negative() => {
            let root = |n: &BigInt| Some(n.sqrt()).filter(|root| root * root == *n);
            Some(Rational::new(root(x.numer())?, root(x.denom())?))
        }
        Function::Sin | Function::Tan | Function::Atan | Function::Asin | Function::Sinh | Function::Tanh
            if x.is_zero() =>
        {
            Some(Rational::zero())
        }
        _ => None,
    }
}
