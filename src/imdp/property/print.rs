//! Expressions as text that is read as the same expression, names of constants and formulas resolved.

use super::tree::{
    Asked, BinaryOperator, Filter, FilterOperator, Function, Measured, Node, NodeKind, Operator, RewardPath,
    StepBound, StepBounds, Structure, TemporalOperator, UntilOperator,
};
use std::fmt::{self, Display, Formatter};

/// Every operand stands in parentheses: none of the operators' strengths matter.
impl Display for Node {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match &self.kind {
            NodeKind::True => f.write_str("true"),
            NodeKind::False => f.write_str("false"),
            NodeKind::Integer(value) => write!(f, "{value}"),
            NodeKind::Decimal(text) => f.write_str(text),
            NodeKind::Label(name) => write!(f, "\"{name}\""),
            NodeKind::Variable(name) => f.write_str(name),
            NodeKind::Not(operand) => write!(f, "!({operand})"),
            NodeKind::Negate(operand) => write!(f, "-({operand})"),
            NodeKind::And(operands) => list(f, operands, ")&("),
            NodeKind::Or(operands) => list(f, operands, ")|("),
            NodeKind::Binary(operator, left, right) => write!(f, "({left}){operator}({right})"),
            NodeKind::Conditional(parts) => {
                let [condition, then, otherwise] = &**parts;
                write!(f, "({condition})?({then}):({otherwise})")
            }
            NodeKind::Call(function, arguments) => {
                write!(f, "{}(", name_of(*function))?;
                separated(f, arguments, ",")?;
                f.write_str(")")
            }
            NodeKind::Temporal(operator, bounds, operand) => {
                let operator = match operator {
                    TemporalOperator::Next => "X",
                    TemporalOperator::Finally => "F",
                    TemporalOperator::Globally => "G",
                };
                write!(f, "{operator}{bounds} ({operand})")
            }
            NodeKind::Until(operator, bounds, operands) => {
                let operator = match operator {
                    UntilOperator::Until => "U",
                    UntilOperator::Weak => "W",
                    UntilOperator::Release => "R",
                };
                write!(f, "({}) {operator}{bounds} ({})", operands[0], operands[1])
            }
            NodeKind::Automaton(path) => {
                write!(f, "HOA: {{\"{}\"", path.file.display())?;
                for (name, meaning) in &path.propositions {
                    write!(f, ", \"{name}\" <- {meaning}")?;
                }
                f.write_str("}")
            }
            NodeKind::Operator(operator) => operator.fmt(f),
            NodeKind::Filter(filter) => filter.fmt(f),
        }
    }
}

fn list(f: &mut Formatter<'_>, operands: &[Node], between: &str) -> fmt::Result {
    f.write_str("(")?;
    separated(f, operands, between)?;
    f.write_str(")")
}

fn separated(f: &mut Formatter<'_>, nodes: &[Node], between: &str) -> fmt::Result {
    for (i, node) in nodes.iter().enumerate() {
        f.write_str(if i == 0 { "" } else { between })?;
        node.fmt(f)?;
    }
    Ok(())
}

fn name_of(function: Function) -> &'static str {
    match function {
        Function::Minimum => "min",
        Function::Maximum => "max",
        Function::Modulo => "mod",
        Function::Power => "pow",
        Function::Floor => "floor",
        Function::Ceiling => "ceil",
        Function::Round => "round",
    }
}

impl Display for BinaryOperator {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self {
            Self::Implies => f.write_str("=>"),
            Self::Iff => f.write_str("<=>"),
            Self::Compare(relation) => relation.fmt(f),
            Self::Add => f.write_str("+"),
            Self::Subtract => f.write_str("-"),
            Self::Multiply => f.write_str("*"),
            Self::Divide => f.write_str("/"),
        }
    }
}

impl Display for StepBounds {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let strict = |bound: &StepBound| if bound.is_strict { "" } else { "=" };
        match (&self.lower, &self.upper) {
            (None, None) => Ok(()),
            (None, Some(upper)) => write!(f, "<{}({})", strict(upper), upper.steps),
            (Some(lower), None) => write!(f, ">{}({})", strict(lower), lower.steps),
            (Some(lower), Some(upper)) => write!(f, "[{},{}]", lower.steps, upper.steps),
        }
    }
}

impl Display for Operator {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        f.write_str(if matches!(self.measured, Measured::Reward(..)) { "R" } else { "P" })?;
        match &self.measured {
            Measured::Probability(_) | Measured::Reward(Structure::First, _) => {}
            Measured::Reward(Structure::Name(name), _) => write!(f, "{{\"{name}\"}}")?,
            Measured::Reward(Structure::Number(number), _) => write!(f, "{{{number}}}")?,
        }
        match &self.asked {
            // The letter in front of the directions has been written.
            Asked::Value(optimum) => write!(f, "{}=?", &optimum.to_string()[1..])?,
            Asked::ForAll(comparison, threshold) => write!(f, "{comparison}({threshold})")?,
        }
        match &self.measured {
            Measured::Probability(path) => write!(f, " [ {path} ]"),
            Measured::Reward(_, RewardPath::Reach(path)) => write!(f, " [ {path} ]"),
            Measured::Reward(_, RewardPath::Instantaneous(steps)) => write!(f, " [ I=({steps}) ]"),
            Measured::Reward(_, RewardPath::Cumulative(bound, discount)) => {
                f.write_str(" [ C")?;
                if let Some(bound) = bound {
                    write!(f, "<{}({})", if bound.is_strict { "" } else { "=" }, bound.steps)?;
                }
                if let Some(discount) = discount {
                    write!(f, ", discount={discount}")?;
                }
                f.write_str(" ]")
            }
        }
    }
}

impl Display for Filter {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let operator = match self.operator {
            FilterOperator::Minimum => "min",
            FilterOperator::Maximum => "max",
            FilterOperator::Average => "avg",
            FilterOperator::Sum => "sum",
            FilterOperator::Count => "count",
            FilterOperator::State => "state",
            FilterOperator::First => "first",
            FilterOperator::ForAll => "forall",
            FilterOperator::Exists => "exists",
            FilterOperator::Print => "print",
        };
        write!(f, "filter({operator}, {}", self.operand)?;
        if let Some(states) = &self.states {
            write!(f, ", {states}")?;
        }
        f.write_str(")")
    }
}
