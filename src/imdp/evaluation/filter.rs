//! Filters: one value from those of many states.

use super::expression::{Evaluator, bounds};
use super::interval;
use super::{EvaluationError, Numbers, Truth, Values};
use crate::property::{BinaryOperator, Filter, FilterOperator, Verdict};

impl Evaluator<'_> {
    /// What a filter comes to: the same in every state, unless it only selects what is printed.
    pub(super) fn filter(&mut self, filter: &Filter) -> Result<Values, EvaluationError> {
        let states = self.model.num_states();
        let selected = match &filter.states {
            Some(node) => self.truth(node)?,
            None => Truth::constant(true, states),
        };
        let selected: Vec<usize> = selected.decided()?.ones().collect();
        let value = self.values(&filter.operand)?;
        if selected.is_empty() && filter.operator != FilterOperator::Print {
            return Err(EvaluationError::NoState);
        }
        match value {
            Values::Truth(truth) => Ok(of_truth(filter.operator, truth, &selected, states)?),
            Values::Numbers(numbers) => of_numbers(filter.operator, numbers, &selected, states),
        }
    }
}

fn of_truth(
    operator: FilterOperator,
    truth: Truth,
    selected: &[usize],
    states: usize,
) -> Result<Values, EvaluationError> {
    let verdicts = || selected.iter().map(|&state| truth.verdict(state));
    let constant = |verdict: Verdict| Values::Truth(Truth::of_verdicts(vec![verdict; states].into_iter()));
    Ok(match operator {
        FilterOperator::Count => {
            let count =
                |holds: fn(Verdict) -> bool| verdicts().filter(|verdict| holds(*verdict)).count() as f64;
            let certain = count(|verdict| verdict == Verdict::Holds);
            let possible = count(|verdict| verdict != Verdict::Fails);
            Values::Numbers(Numbers::constant_bounds((certain, possible), states))
        }
        FilterOperator::ForAll => constant(Verdict::in_all(verdicts())),
        FilterOperator::Exists => {
            let flipped = verdicts().map(flip);
            constant(flip(Verdict::in_all(flipped)))
        }
        FilterOperator::State | FilterOperator::First => constant(truth.verdict(only(operator, selected)?)),
        _ => Values::Truth(truth),
    })
}

fn flip(verdict: Verdict) -> Verdict {
    match verdict {
        Verdict::Holds => Verdict::Fails,
        Verdict::Fails => Verdict::Holds,
        Verdict::Unknown => Verdict::Unknown,
    }
}

fn of_numbers(
    operator: FilterOperator,
    numbers: Numbers,
    selected: &[usize],
    states: usize,
) -> Result<Values, EvaluationError> {
    let all = || selected.iter().map(|&state| numbers.bounds(state));
    let fold = |combine: fn(f64, f64) -> f64| {
        all()
            .reduce(|a, b| (combine(a.0, b.0), combine(a.1, b.1)))
            .unwrap_or((f64::NEG_INFINITY, f64::INFINITY))
    };
    let sum = || all().reduce(|a, b| interval::arithmetic(BinaryOperator::Add, a, b)).unwrap_or((0.0, 0.0));
    let value = match operator {
        FilterOperator::Minimum => fold(f64::min),
        FilterOperator::Maximum => fold(f64::max),
        FilterOperator::Sum => sum(),
        FilterOperator::Average => {
            let count = selected.len() as f64;
            interval::arithmetic(BinaryOperator::Divide, sum(), (count, count))
        }
        FilterOperator::State | FilterOperator::First => numbers.bounds(only(operator, selected)?),
        _ => return Ok(Values::Numbers(numbers)),
    };
    Ok(Values::Numbers(bounds(std::iter::repeat_n(value, states))))
}

/// The state that is meant.
fn only(operator: FilterOperator, selected: &[usize]) -> Result<usize, EvaluationError> {
    match selected {
        [state] => Ok(*state),
        [first, ..] if operator == FilterOperator::First => Ok(*first),
        _ => Err(EvaluationError::NotOneState { found: selected.len() }),
    }
}
