//! Filters: one value from those of many states.

use super::expression::Evaluator;
use super::interval;
use super::{EvaluationError, Numbers, Truth, Values};
use crate::numeric::Rational;
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
        // What is wanted of a filter in any state is wanted of its operand in those that the filter selects.
        let exactly = self.exactly.take();
        if exactly.is_some() {
            let mut wanted = crate::model::StateSet::with_capacity(states);
            selected.iter().for_each(|&state| wanted.insert(state));
            self.exactly = Some(wanted);
        }
        let value = self.values(&filter.operand);
        self.exactly = exactly;
        let value = value?;
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
    if let Some(value) = exact_number(operator, &numbers, selected) {
        return Ok(Values::Numbers(Numbers::Constant(value, states)));
    }
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
    Ok(Values::Numbers(Numbers::constant_bounds(value, states)))
}

/// The same if it is known exactly in all selected states.
fn exact_number(operator: FilterOperator, numbers: &Numbers, selected: &[usize]) -> Option<Rational> {
    let selected = if operator == FilterOperator::First { selected.get(..1)? } else { selected };
    let all = selected.iter().map(|&state| numbers.exact(state).cloned()).collect::<Option<Vec<_>>>()?;
    let count = Rational::from_integer(all.len().into());
    match operator {
        FilterOperator::Minimum => all.into_iter().min(),
        FilterOperator::Maximum => all.into_iter().max(),
        FilterOperator::Sum => Some(all.into_iter().sum()),
        FilterOperator::Average if !all.is_empty() => Some(all.into_iter().sum::<Rational>() / count),
        FilterOperator::State | FilterOperator::First if all.len() == 1 => all.into_iter().next(),
        _ => None,
    }
}

/// The state that is meant.
fn only(operator: FilterOperator, selected: &[usize]) -> Result<usize, EvaluationError> {
    match selected {
        [state] => Ok(*state),
        [first, ..] if operator == FilterOperator::First => Ok(*first),
        _ => Err(EvaluationError::NotOneState { found: selected.len() }),
    }
}
