//! The states in which a formula holds.

use super::columns::{Column, evaluate_integer, numbers_states, variable};
use super::{IntegerExpression, PropertyError, Relation, StateFormula, closest_name::closest_name};
use crate::model::{IntervalMdp, StateId, StateSet, VariableValues};

impl StateFormula {
    /// The states of `model` in which the formula holds.
    ///
    /// `"init"` are the initial states. `"deadlock"` is the label of that name if the model has one, else
    /// the states without choices.
    ///
    /// # Errors
    /// [`PropertyError`] if a label or variable does not exist, or if a variable has the wrong type.
    pub fn evaluate(&self, model: &IntervalMdp) -> Result<StateSet, PropertyError> {
        match self {
            Self::True => Ok(all_states(model)),
            Self::False => Ok(no_states(model)),
            Self::Label(name) => label(name, model),
            Self::Variable(name) => match &variable(name, model)?.values {
                VariableValues::Bool(states) => Ok(states.clone()),
                VariableValues::Int(_) => Err(PropertyError::NotBoolean { name: name.clone() }),
            },
            Self::Not(operand) => Ok(complement(operand.evaluate(model)?)),
            Self::And(operands) => operands.iter().try_fold(all_states(model), |mut states, operand| {
                states.intersect_with(&operand.evaluate(model)?);
                Ok(states)
            }),
            Self::Or(operands) => operands.iter().try_fold(no_states(model), |mut states, operand| {
                states.union_with(&operand.evaluate(model)?);
                Ok(states)
            }),
            Self::Implies(left, right) => {
                let mut states = complement(left.evaluate(model)?);
                states.union_with(&right.evaluate(model)?);
                Ok(states)
            }
            Self::Iff(left, right) => Ok(same(left.evaluate(model)?, &right.evaluate(model)?)),
            Self::Differ(left, right) => Ok(complement(same(left.evaluate(model)?, &right.evaluate(model)?))),
            Self::Compare(left, comparison, right) => compare(left, *comparison, right, model),
        }
    }
}

/// All states of the model.
pub(super) fn all_states(model: &IntervalMdp) -> StateSet {
    complement(no_states(model))
}

fn no_states(model: &IntervalMdp) -> StateSet {
    StateSet::with_capacity(model.num_states())
}

pub(super) fn complement(mut states: StateSet) -> StateSet {
    states.toggle_range(..);
    states
}

/// The states that are in both sets or in neither.
fn same(mut left: StateSet, right: &StateSet) -> StateSet {
    left.symmetric_difference_with(right);
    complement(left)
}

fn label(name: &str, model: &IntervalMdp) -> Result<StateSet, PropertyError> {
    if name == "init" {
        return Ok(model.initial().clone());
    }
    if let Some(states) = model.labels().get(name) {
        return Ok(states.clone());
    }
    if name == "deadlock" {
        let mut states = no_states(model);
        let is_deadlock = |state: &usize| model.choices().is_deadlock(StateId::from_index(*state));
        states.extend((0..model.num_states()).filter(is_deadlock));
        return Ok(states);
    }
    let always = ["init", "deadlock"];
    let declared = model.labels().iter().map(|(label, _)| label).filter(|label| !always.contains(label));
    let known: Vec<_> = always.into_iter().chain(declared).map(str::to_owned).collect();
    let closest = match model.variables().get(name) {
        Some(_) => Some(name.to_owned()),
        None => closest_name(name, &known).map(|label| format!("\"{label}\"")),
    };
    Err(PropertyError::UnknownLabel { name: name.to_owned(), closest, known })
}

fn compare(
    left: &IntegerExpression,
    comparison: Relation,
    right: &IntegerExpression,
    model: &IntervalMdp,
) -> Result<StateSet, PropertyError> {
    // Only here is it known what type a variable has.
    if let (Some(left), Some(right)) = (boolean(left, model)?, boolean(right, model)?) {
        match comparison {
            Relation::Equal => return Ok(same(left.clone(), right)),
            Relation::NotEqual => return Ok(complement(same(left.clone(), right))),
            _ => {}
        }
    }
    let (left, right) = (evaluate_integer(left, model)?, evaluate_integer(right, model)?);
    let compares: fn(i64, i64) -> bool = match comparison {
        Relation::Equal => |a, b| a == b,
        Relation::NotEqual => |a, b| a != b,
        Relation::Less => |a, b| a < b,
        Relation::LessEqual => |a, b| a <= b,
        Relation::Greater => |a, b| a > b,
        Relation::GreaterEqual => |a, b| a >= b,
    };
    if let (Column::Constant(a), Column::Constant(b)) = (&left, &right) {
        return Ok(if compares(*a, *b) { all_states(model) } else { no_states(model) });
    }
    let mut states = no_states(model);
    states.extend((0..model.num_states()).filter(|&state| compares(left.at(state), right.at(state))));
    Ok(states)
}

fn boolean<'a>(
    expression: &IntegerExpression,
    model: &'a IntervalMdp,
) -> Result<Option<&'a StateSet>, PropertyError> {
    let IntegerExpression::Variable(name) = expression else { return Ok(None) };
    if numbers_states(name, model) {
        return Ok(None);
    }
    Ok(match &variable(name, model)?.values {
        VariableValues::Bool(states) => Some(states),
        VariableValues::Int(_) => None,
    })
}
