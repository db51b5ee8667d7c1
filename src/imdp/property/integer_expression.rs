//! Integer expressions over the variables of a state.

use std::fmt;

/// An integer, depending on the state.
///
/// Arithmetic is that of the integers: overflow is an error, not a wrapped number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum IntegerExpression {
    /// A number; what is negative is a [`Self::Negate`], as in PRISM, which reads literals up to `2³¹ − 1`.
    Literal(u32),
    /// The value of a variable.
    Variable(String),
    /// `-a`
    Negate(Box<Self>),
    /// `a + b`
    Add(Box<Self>, Box<Self>),
    /// `a - b`
    Subtract(Box<Self>, Box<Self>),
    /// `a * b`
    Multiply(Box<Self>, Box<Self>),
}

const SUM: u8 = 0;
const PRODUCT: u8 = 1;
const UNARY: u8 = 2;

impl IntegerExpression {
    /// Prints with parentheses if the operator binds weaker than `level`.
    fn print(&self, level: u8, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (own, symbol, operands) = match self {
            Self::Literal(value) => return write!(f, "{value}"),
            Self::Variable(name) => return f.write_str(name),
            Self::Negate(operand) => {
                f.write_str("-")?;
                return operand.print(UNARY, f);
            }
            Self::Add(left, right) => (SUM, "+", (left, right)),
            Self::Subtract(left, right) => (SUM, "-", (left, right)),
            Self::Multiply(left, right) => (PRODUCT, "*", (left, right)),
        };
        if own < level {
            f.write_str("(")?;
        }
        operands.0.print(own, f)?;
        f.write_str(symbol)?;
        // All three are read from the left.
        operands.1.print(own + 1, f)?;
        if own < level { f.write_str(")") } else { Ok(()) }
    }
}

impl fmt::Display for IntegerExpression {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.print(SUM, f)
    }
}
