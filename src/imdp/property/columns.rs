//! Integer expressions, evaluated for all states at once.

use super::closest_name::closest_name;
use super::{IntegerExpression, PropertyError};
use crate::model::{IntervalMdp, StateVariable, VariableValues};

/// The value of an integer expression, by state.
pub(super) enum Column<'a> {
    /// The same in every state.
    Constant(i64),
    /// The values of a variable.
    Variable(&'a [i32]),
    /// Computed values.
    Computed(Vec<i64>),
}

impl Column<'_> {
    /// The value in one state.
    pub(super) fn at(&self, state: usize) -> i64 {
        match self {
            Self::Constant(value) => *value,
            Self::Variable(values) => i64::from(values[state]),
            Self::Computed(values) => values[state],
        }
    }
}

/// The values of an expression.
pub(super) fn evaluate_integer<'a>(
    expression: &IntegerExpression,
    model: &'a IntervalMdp,
) -> Result<Column<'a>, PropertyError> {
    type Operation = fn(i64, i64) -> Option<i64>;
    let (operation, left, right): (Operation, _, _) = match expression {
        IntegerExpression::Literal(value) => return Ok(Column::Constant(i64::from(*value))),
        IntegerExpression::Variable(name) if numbers_states(name, model) => {
            return Ok(Column::Computed((0..model.num_states() as i64).collect()));
        }
        IntegerExpression::Variable(name) => {
            return match &variable(name, model)?.values {
                VariableValues::Int(values) => Ok(Column::Variable(values)),
                VariableValues::Bool(_) => Err(PropertyError::NotInteger { name: name.clone() }),
            };
        }
        IntegerExpression::Negate(operand) => {
            let operand = evaluate_integer(operand, model)?;
            return combine(expression, i64::checked_sub, &Column::Constant(0), &operand, model);
        }
        IntegerExpression::Add(left, right) => (i64::checked_add, left, right),
        IntegerExpression::Subtract(left, right) => (i64::checked_sub, left, right),
        IntegerExpression::Multiply(left, right) => (i64::checked_mul, left, right),
    };
    let (left, right) = (evaluate_integer(left, model)?, evaluate_integer(right, model)?);
    combine(expression, operation, &left, &right, model)
}

/// The variable of this name.
pub(super) fn variable<'a>(name: &str, model: &'a IntervalMdp) -> Result<&'a StateVariable, PropertyError> {
    model.variables().get(name).ok_or_else(|| {
        let known: Vec<_> = model.variables().iter().map(|variable| variable.name.clone()).collect();
        let closest = match model.labels().get(name) {
            Some(_) => Some(format!("\"{name}\"")),
            None => closest_name(name, &known).map(str::to_owned),
        };
        PropertyError::UnknownVariable { name: name.to_owned(), closest, known }
    })
}

/// Whether a name is that of the number of a state: `x`, as for PRISM, if the states have no variables.
pub(crate) fn numbers_states(name: &str, model: &IntervalMdp) -> bool {
    name == "x" && model.variables().is_empty()
}

fn combine<'a>(
    expression: &IntegerExpression,
    operation: fn(i64, i64) -> Option<i64>,
    left: &Column<'_>,
    right: &Column<'_>,
    model: &IntervalMdp,
) -> Result<Column<'a>, PropertyError> {
    let value = |state| {
        operation(left.at(state), right.at(state))
            .ok_or_else(|| PropertyError::Overflow { expression: expression.to_string(), state })
    };
    match (left, right) {
        (Column::Constant(_), Column::Constant(_)) => value(0).map(Column::Constant),
        _ => (0..model.num_states()).map(value).collect::<Result<_, _>>().map(Column::Computed),
    }
}
