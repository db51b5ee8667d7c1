//! Expressions without variables, evaluated exactly.

use super::Relation;
use super::tree::{BinaryOperator, Function, Node, NodeKind};
use crate::numeric::Rational;
use num_bigint::BigInt;
use num_traits::{One, Pow, Signed, ToPrimitive, Zero};

/// Larger exponents could fill the memory.
const MAX_EXPONENT: u32 = 1000;

/// The value of an expression without variables.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Constant {
    Boolean(bool),
    Number(Rational),
}

impl Constant {
    /// The number, if it is one.
    pub(crate) fn number(self) -> Option<Rational> {
        match self {
            Self::Number(number) => Some(number),
            Self::Boolean(_) => None,
        }
    }
}

/// The value of an expression; `None` if it depends on the state, or has none.
pub(crate) fn constant(node: &Node) -> Option<Constant> {
    let number = |node: &Node| constant(node)?.number();
    let truth = |node: &Node| match constant(node)? {
        Constant::Boolean(value) => Some(value),
        Constant::Number(_) => None,
    };
    Some(match &node.kind {
        NodeKind::True => Constant::Boolean(true),
        NodeKind::False => Constant::Boolean(false),
        NodeKind::Integer(value) => Constant::Number(Rational::from_integer((*value).into())),
        NodeKind::Decimal(text) => Constant::Number(decimal(text)?),
        NodeKind::Negate(operand) => Constant::Number(-number(operand)?),
        NodeKind::Not(operand) => Constant::Boolean(!truth(operand)?),
        NodeKind::And(operands) => Constant::Boolean(all(operands.iter().map(truth), |value| *value)?),
        NodeKind::Or(operands) => Constant::Boolean(!all(operands.iter().map(truth), |value| !*value)?),
        NodeKind::Binary(operator, left, right) => match operator {
            BinaryOperator::Implies => Constant::Boolean(!truth(left)? || truth(right)?),
            BinaryOperator::Iff => Constant::Boolean(truth(left)? == truth(right)?),
            BinaryOperator::Compare(comparison) => {
                Constant::Boolean(comparison.compares(&constant(left)?.number()?, &number(right)?))
            }
            _ => Constant::Number(arithmetic(*operator, number(left)?, number(right)?)?),
        },
        NodeKind::Conditional(parts) => {
            let [condition, then, otherwise] = &**parts;
            constant(if truth(condition)? { then } else { otherwise })?
        }
        NodeKind::Call(function, arguments) => {
            let arguments = arguments.iter().map(number).collect::<Option<Vec<_>>>()?;
            Constant::Number(call(*function, &arguments)?)
        }
        _ => return None,
    })
}

fn all(values: impl Iterator<Item = Option<bool>>, holds: impl Fn(&bool) -> bool) -> Option<bool> {
    let values = values.collect::<Option<Vec<_>>>()?;
    Some(values.iter().all(holds))
}

/// `+ - * /`; `None` for anything else, and for a division by 0.
pub(crate) fn arithmetic(operator: BinaryOperator, left: Rational, right: Rational) -> Option<Rational> {
    match operator {
        BinaryOperator::Add => Some(left + right),
        BinaryOperator::Subtract => Some(left - right),
        BinaryOperator::Multiply => Some(left * right),
        BinaryOperator::Divide if !right.is_zero() => Some(left / right),
        _ => None,
    }
}

/// A function of numbers; `None` where it has no value.
pub(crate) fn call(function: Function, arguments: &[Rational]) -> Option<Rational> {
    let two = || Some((arguments.first()?, arguments.get(1)?));
    Some(match function {
        Function::Minimum => arguments.iter().min()?.clone(),
        Function::Maximum => arguments.iter().max()?.clone(),
        Function::Floor => arguments.first()?.floor(),
        Function::Ceiling => arguments.first()?.ceil(),
        Function::Round => (arguments.first()? + Rational::new(1.into(), 2.into())).floor(),
        Function::Modulo => {
            let (value, modulus) = two()?;
            if !value.is_integer() || !modulus.is_integer() || !modulus.is_positive() {
                return None;
            }
            value - modulus * (value / modulus).floor()
        }
        Function::Power => {
            let (base, exponent) = two()?;
            if !exponent.is_integer() {
                return None;
            }
            let magnitude = exponent.abs().to_integer().to_u32().filter(|n| *n <= MAX_EXPONENT)?;
            let power = Rational::new(base.numer().pow(magnitude), base.denom().pow(magnitude));
            match exponent.is_negative() {
                true if power.is_zero() => return None,
                true => Rational::one() / power,
                false => power,
            }
        }
    })
}

/// The exact value of an unsigned decimal.
pub(crate) fn decimal(text: &str) -> Option<Rational> {
    let (mantissa, exponent) = match text.find(['e', 'E']) {
        Some(at) => (&text[..at], text[at + 1..].parse::<i32>().ok()?),
        None => (text, 0),
    };
    let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
    if exponent.unsigned_abs() > MAX_EXPONENT || mantissa.len() > MAX_EXPONENT as usize {
        return None;
    }
    let digits: BigInt = format!("0{whole}{fraction}").parse().ok()?;
    let power = exponent - fraction.len() as i32;
    let scale = BigInt::from(10).pow(power.unsigned_abs());
    Some(if power >= 0 { Rational::from_integer(digits * scale) } else { Rational::new(digits, scale) })
}

impl Relation {
    /// Whether two numbers compare like this.
    pub(crate) fn compares<T: PartialOrd>(self, left: &T, right: &T) -> bool {
        match self {
            Self::Equal => left == right,
            Self::NotEqual => left != right,
            Self::Less => left < right,
            Self::LessEqual => left <= right,
            Self::Greater => left > right,
            Self::GreaterEqual => left >= right,
        }
    }
}
