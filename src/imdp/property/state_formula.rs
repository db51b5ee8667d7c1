//! Formulas that hold in a state or do not.

use std::fmt;

use super::IntegerExpression;

/// A formula that holds in a state or does not.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum StateFormula {
    /// Holds everywhere.
    True,
    /// Holds nowhere.
    False,
    /// Holds where the label does; `"init"` and `"deadlock"` always exist.
    Label(String),
    /// Holds where the Boolean variable is true.
    Variable(String),
    /// Holds where the operand does not.
    Not(Box<Self>),
    /// Holds where all operands do. At least two, to be printed.
    And(Vec<Self>),
    /// Holds where some operand does. At least two, to be printed.
    Or(Vec<Self>),
    /// `a => b`: holds where `a` does not or `b` does.
    Implies(Box<Self>, Box<Self>),
    /// `a <=> b`: holds where both or neither do. PRISM's `a=b` of Boolean formulas is this.
    Iff(Box<Self>, Box<Self>),
    /// `a != b` of formulas: holds where exactly one of them does.
    Differ(Box<Self>, Box<Self>),
    /// Compares two integers; also `=` and `!=` of two Boolean variables, which look the same.
    Compare(IntegerExpression, Relation, IntegerExpression),
}

/// How two integers are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    /// `=`
    Equal,
    /// `!=`
    NotEqual,
    /// `<`
    Less,
    /// `<=`
    LessEqual,
    /// `>`
    Greater,
    /// `>=`
    GreaterEqual,
}

// How tightly PRISM's operators bind; see `grammar`.
const IMPLIES: u8 = 0;
const IFF: u8 = 1;
const OR: u8 = 2;
const AND: u8 = 3;
const NOT: u8 = 4;
const ATOM: u8 = 5;

impl StateFormula {
    /// The label of this name.
    pub fn label(name: impl Into<String>) -> Self {
        Self::Label(name.into())
    }

    /// `!operand`
    pub fn negation(operand: Self) -> Self {
        Self::Not(Box::new(operand))
    }

    fn level(&self) -> u8 {
        match self {
            Self::Implies(..) => IMPLIES,
            Self::Iff(..) => IFF,
            Self::Or(_) => OR,
            Self::And(_) => AND,
            // `!x=1` is `!(x=1)` in PRISM, but not to every reader; with parentheses it is to all.
            Self::Not(_) | Self::Compare(..) | Self::Differ(..) => NOT,
            _ => ATOM,
        }
    }

    /// Prints with parentheses if the operator binds weaker than `level`.
    fn print(&self, level: u8, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.level() < level {
            f.write_str("(")?;
            self.print_bare(f)?;
            f.write_str(")")
        } else {
            self.print_bare(f)
        }
    }

    fn print_bare(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::True => f.write_str("true"),
            Self::False => f.write_str("false"),
            Self::Label(name) => write!(f, "\"{name}\""),
            Self::Variable(name) => f.write_str(name),
            Self::Not(operand) => {
                f.write_str("!")?;
                let is_negation = matches!(**operand, Self::Not(_));
                operand.print(if is_negation { NOT } else { ATOM }, f)
            }
            Self::And(operands) => print_chain(operands, " & ", AND + 1, f),
            Self::Or(operands) => print_chain(operands, " | ", OR + 1, f),
            Self::Implies(left, right) => {
                left.print(IMPLIES + 1, f)?;
                f.write_str(" => ")?;
                right.print(IMPLIES, f)
            }
            Self::Iff(left, right) => {
                left.print(IFF, f)?;
                f.write_str(" <=> ")?;
                right.print(IFF + 1, f)
            }
            Self::Differ(left, right) => {
                left.print(ATOM, f)?;
                f.write_str(" != ")?;
                right.print(ATOM, f)
            }
            // The blanks matter: `x<-1` is no comparison in PRISM, which has an operator `<-`.
            Self::Compare(left, comparison, right) => write!(f, "{left} {comparison} {right}"),
        }
    }
}

fn print_chain(
    operands: &[StateFormula],
    symbol: &str,
    level: u8,
    f: &mut fmt::Formatter<'_>,
) -> fmt::Result {
    for (i, operand) in operands.iter().enumerate() {
        if i > 0 {
            f.write_str(symbol)?;
        }
        operand.print(level, f)?;
    }
    Ok(())
}

impl fmt::Display for StateFormula {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.print(IMPLIES, f)
    }
}

impl fmt::Display for Relation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Equal => "=",
            Self::NotEqual => "!=",
            Self::Less => "<",
            Self::LessEqual => "<=",
            Self::Greater => ">",
            Self::GreaterEqual => ">=",
        })
    }
}
