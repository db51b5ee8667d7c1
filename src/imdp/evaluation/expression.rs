//! Evaluating expressions.

use super::checker::Checker;
use super::{EvaluationError, Known, Numbers, Truth, Values, interval};
use crate::certificate::Evidence;
use crate::model::{IntervalMdp, StateSet, VariableValues};
use crate::numeric::{Rational, to_f64_down, to_f64_up};
use crate::property::{
    BinaryOperator, Constant, Function, Nature, Node, NodeKind, Relation, Verdict, arithmetic, call,
    constant, formula, is_formula,
};
use crate::solver::{Inexact, Policy, SolverOptions, Status};
use num_traits::{One, Zero};
use std::collections::HashMap;

/// Evaluates expressions on a model.
pub(super) struct Evaluator<'a> {
    pub(super) model: &'a IntervalMdp,
    pub(super) nature: Option<Nature>,
    pub(super) options: SolverOptions<'a>,
    pub(super) status: Status,
    pub(super) iterations: u64,
    pub(super) policy: Option<Policy>,
    /// How many operators were solved.
    pub(super) operators: usize,
    /// The states in which probabilities are wanted exactly, and nowhere else; none if bounds are wanted.
    pub(super) exactly: Option<StateSet>,
    /// Whether anything between 0 and 1 may stand for a probability there that is neither.
    pub(super) extremes: bool,
    /// Why a probability could not be had exactly, if so.
    pub(super) inexact: Option<Inexact>,
    /// What proves the values of operators, in the order of their evaluation, if that was asked for.
    pub(super) evidence: Vec<Evidence>,
    /// Whether there is something among them that nothing proves.
    pub(super) is_unproved: bool,
    /// Proofs to be checked in place of computing anything.
    pub(super) checker: Option<Checker<'a>>,
    /// Formulas with operators that have been evaluated, by where they stand.
    truths: HashMap<*const Node, Truth>,
}

impl<'a> Evaluator<'a> {
    pub(super) fn new(model: &'a IntervalMdp, nature: Option<Nature>, options: SolverOptions<'a>) -> Self {
        Self {
            model,
            nature,
            options,
            status: Status::HorizonReached,
            iterations: 0,
            policy: None,
            operators: 0,
            exactly: None,
            extremes: false,
            inexact: None,
            evidence: vec![],
            is_unproved: false,
            checker: None,
            truths: HashMap::new(),
        }
    }

    /// The policy, if there is one for all that was asked.
    pub(super) fn finish(self) -> Option<Policy> {
        self.policy.filter(|_| self.operators == 1)
    }

    /// What an expression comes to, formula or number.
    pub(super) fn values(&mut self, node: &Node) -> Result<Values, EvaluationError> {
        let is_truth = match &node.kind {
            NodeKind::Variable(name) => self.is_boolean(name),
            _ => is_formula(node),
        };
        match is_truth {
            true => self.truth(node).map(Values::Truth),
            false => self.numbers(node).map(Values::Numbers),
        }
    }

    fn is_boolean(&self, name: &str) -> bool {
        let variable = self.model.variables().get(name);
        variable.is_some_and(|variable| matches!(variable.values, VariableValues::Bool(_)))
    }

    /// Where a formula holds.
    pub(super) fn truth(&mut self, node: &Node) -> Result<Truth, EvaluationError> {
        if let Some(formula) = formula(node) {
            return Ok(Truth::exact(formula.evaluate(self.model)?));
        }
        if let Some(truth) = self.truths.get(&std::ptr::from_ref(node)) {
            return Ok(truth.clone());
        }
        let (exactly, extremes) = (self.exactly.take(), std::mem::take(&mut self.extremes));
        let truth = self.new_truth(node);
        (self.exactly, self.extremes) = (exactly, extremes);
        let truth = truth?;
        self.truths.insert(node, truth.clone());
        Ok(truth)
    }

    /// The same for a formula that has not been evaluated before.
    fn new_truth(&mut self, node: &Node) -> Result<Truth, EvaluationError> {
        let states = self.model.num_states();
        Ok(match &node.kind {
            NodeKind::Not(operand) => self.truth(operand)?.not(),
            NodeKind::And(operands) => {
                let mut all = Truth::constant(true, states);
                for operand in operands {
                    all = all.and(&self.truth(operand)?);
                }
                all
            }
            NodeKind::Or(operands) => {
                let mut any = Truth::constant(false, states);
                for operand in operands {
                    any = any.or(&self.truth(operand)?);
                }
                any
            }
            NodeKind::Binary(BinaryOperator::Implies, left, right) => {
                let left = self.truth(left)?.not();
                left.or(&self.truth(right)?)
            }
            NodeKind::Binary(BinaryOperator::Iff, left, right) => {
                let left = self.truth(left)?;
                left.iff(&self.truth(right)?)
            }
            NodeKind::Binary(BinaryOperator::Compare(comparison), left, right) => {
                self.comparison(*comparison, left, right)?
            }
            NodeKind::Conditional(parts) => {
                let condition = self.truth(&parts[0])?;
                let then = self.truth(&parts[1])?.and(&condition);
                then.or(&self.truth(&parts[2])?.and(&condition.not()))
            }
            NodeKind::Operator(operator) => self.bounded_operator(operator)?,
            NodeKind::Filter(filter) => match self.filter(filter)? {
                Values::Truth(truth) => truth,
                Values::Numbers(numbers) => Truth::constant(false, numbers.len()),
            },
            // The others are formulas that need no solver, or have been checked not to stand here.
            _ => Truth::constant(false, states),
        })
    }

    fn comparison(
        &mut self,
        comparison: Relation,
        left: &Node,
        right: &Node,
    ) -> Result<Truth, EvaluationError> {
        let boolean = |node: &Node| match &node.kind {
            NodeKind::Variable(name) => self.is_boolean(name),
            _ => is_formula(node),
        };
        let is_equality = matches!(comparison, Relation::Equal | Relation::NotEqual);
        if is_equality && (boolean(left) || boolean(right)) {
            let left = self.truth(left)?;
            let same = left.iff(&self.truth(right)?);
            return Ok(if comparison == Relation::Equal { same } else { same.not() });
        }
        let is_operator = |node: &Node| matches!(node.kind, NodeKind::Operator(_));
        let is_extreme =
            is_operator(left) && is_zero_or_one(right) || is_operator(right) && is_zero_or_one(left);
        self.compared(comparison, is_extreme, |evaluator| {
            Ok((evaluator.numbers(left)?, evaluator.numbers(right)?))
        })
    }

    /// Where two numbers compare like this; where their bounds do not tell, their exact values are asked for, or at first, for
    /// probabilities compared with 0 or 1, whether they are those.
    pub(super) fn compared(
        &mut self,
        comparison: Relation,
        is_extreme: bool,
        mut numbers: impl FnMut(&mut Self) -> Result<(Numbers, Numbers), EvaluationError>,
    ) -> Result<Truth, EvaluationError> {
        let (left, right) = numbers(self)?;
        let mut truth = compare(comparison, &left, &right);
        for extremes in [true, false] {
            let stopped =
                matches!(self.status, Status::IterationLimit | Status::TimeLimit | Status::Interrupted);
            // Certificates have no proofs of exact values.
            let proofs_only = self.options.evidence || self.checker.is_some();
            if truth.is_exact() || stopped || proofs_only {
                break;
            }
            if extremes && !is_extreme {
                continue;
            }
            let mut open = truth.may.clone();
            open.difference_with(&truth.must);
            (self.exactly, self.extremes) = (Some(open), extremes);
            let exact = numbers(self);
            (self.exactly, self.extremes) = (None, false);
            let (left, right) = exact?;
            truth = truth.refined(&compare(comparison, &left, &right));
        }
        Ok(truth)
    }

    /// The value of a number in every state.
    pub(super) fn numbers(&mut self, node: &Node) -> Result<Numbers, EvaluationError> {
        let states = self.model.num_states();
        if let Some(Constant::Number(value)) = constant(node) {
            return Ok(Numbers::Constant(value, states));
        }
        match &node.kind {
            NodeKind::Variable(name) => self.variable(name),
            NodeKind::Negate(operand) => {
                let zero = Numbers::Constant(Rational::from_integer(0.into()), states);
                let operand = self.numbers(operand)?;
                self.combine(BinaryOperator::Subtract, &zero, &operand)
            }
            NodeKind::Binary(operator, left, right) => {
                let (left, right) = (self.numbers(left)?, self.numbers(right)?);
                self.combine(*operator, &left, &right)
            }
            NodeKind::Call(function, arguments) => {
                let arguments =
                    arguments.iter().map(|node| self.numbers(node)).collect::<Result<Vec<_>, _>>()?;
                self.function(*function, &arguments)
            }
            NodeKind::Conditional(parts) => {
                let condition = self.truth(&parts[0])?;
                let (then, otherwise) = (self.numbers(&parts[1])?, self.numbers(&parts[2])?);
                let choose = |state| match condition.verdict(state) {
                    Verdict::Holds => then.bounds(state),
                    Verdict::Fails => otherwise.bounds(state),
                    Verdict::Unknown => {
                        let (a, b) = (then.bounds(state), otherwise.bounds(state));
                        (a.0.min(b.0), a.1.max(b.1))
                    }
                };
                if condition.is_exact() && [&then, &otherwise].iter().all(|part| part.is_exact()) {
                    self.require_numbers(states)?;
                    let exact = |state: usize| {
                        let part = if condition.must.contains(state) { &then } else { &otherwise };
                        part.exact(state).cloned()
                    };
                    return Ok(Numbers::Exact((0..states).filter_map(exact).collect()));
                }
                let exact = |state| match condition.verdict(state) {
                    Verdict::Holds => then.exact(state).cloned(),
                    Verdict::Fails => otherwise.exact(state).cloned(),
                    Verdict::Unknown => None,
                };
                Ok(self.known((0..states).map(choose), exact))
            }
            NodeKind::Operator(operator) => self.operator(operator).map(Numbers::Bounds),
            NodeKind::Filter(filter) => match self.filter(filter)? {
                Values::Numbers(numbers) => Ok(numbers),
                Values::Truth(_) => Ok(Numbers::constant_bounds((0.0, 0.0), states)),
            },
            _ => Ok(Numbers::constant_bounds((f64::NEG_INFINITY, f64::INFINITY), states)),
        }
    }

    fn combine(
        &self,
        operator: BinaryOperator,
        left: &Numbers,
        right: &Numbers,
    ) -> Result<Numbers, EvaluationError> {
        let states = left.len();
        if left.is_exact() && right.is_exact() {
            self.require_numbers(states)?;
            let value = |state: usize| {
                let operands = left.exact(state).cloned().zip(right.exact(state).cloned());
                let value = operands.and_then(|(left, right)| arithmetic(operator, left, right));
                value.ok_or(EvaluationError::Undefined { state, problem: "a division by 0" })
            };
            return (0..states).map(value).collect::<Result<_, _>>().map(Numbers::Exact);
        }
        let value = |state| interval::arithmetic(operator, left.bounds(state), right.bounds(state));
        let exact =
            |state: usize| arithmetic(operator, left.exact(state)?.clone(), right.exact(state)?.clone());
        Ok(self.known((0..states).map(value), exact))
    }

    /// Bounds state by state, with exact numbers where they are wanted and known.
    fn known(
        &self,
        values: impl Iterator<Item = (f64, f64)>,
        exact: impl Fn(usize) -> Option<Rational>,
    ) -> Numbers {
        let (lower, upper) = values.unzip();
        let wanted = self.exactly.iter().flat_map(StateSet::ones);
        let exact = wanted.filter_map(|state| exact(state).map(|value| (state, value))).collect();
        Numbers::Bounds(Known { exact, ..Known::within(lower, upper) })
    }

    fn function(&self, function: Function, arguments: &[Numbers]) -> Result<Numbers, EvaluationError> {
        let states = self.model.num_states();
        if arguments.iter().all(Numbers::is_exact) {
            self.require_numbers(states)?;
            let value = |state: usize| {
                let values: Option<Vec<_>> =
                    arguments.iter().map(|argument| argument.exact(state).cloned()).collect();
                let value = values.and_then(|values| call(function, &values));
                value.ok_or(EvaluationError::Undefined {
                    state,
                    problem: "mod or pow of numbers that are not whole, or mod by one that is not positive",
                })
            };
            return (0..states).map(value).collect::<Result<_, _>>().map(Numbers::Exact);
        }
        let fold = |state: usize, combine: fn(f64, f64) -> f64| {
            let all = arguments.iter().map(|argument| argument.bounds(state));
            all.reduce(|a, b| (combine(a.0, b.0), combine(a.1, b.1)))
                .unwrap_or((f64::NEG_INFINITY, f64::INFINITY))
        };
        let value = |state| match function {
            Function::Minimum => fold(state, f64::min),
            Function::Maximum => fold(state, f64::max),
            Function::Floor => interval::monotone(f64::floor, fold(state, f64::min)),
            Function::Ceiling => interval::monotone(f64::ceil, fold(state, f64::min)),
            Function::Round => interval::monotone(interval::half_up, fold(state, f64::min)),
            Function::Modulo | Function::Power => (f64::NEG_INFINITY, f64::INFINITY),
        };
        let exact = |state: usize| {
            let values = arguments.iter().map(|argument| argument.exact(state).cloned());
            call(function, &values.collect::<Option<Vec<_>>>()?)
        };
        Ok(self.known((0..states).map(value), exact))
    }
}

/// Whether a number is 0 or 1, with which all probabilities in between compare in the same way.
pub(super) fn is_zero_or_one(node: &Node) -> bool {
    matches!(constant(node), Some(Constant::Number(value)) if value.is_zero() || value.is_one())
}

/// Where numbers compare like this.
pub(super) fn compare(comparison: Relation, left: &Numbers, right: &Numbers) -> Truth {
    let verdict = |state| match (left.exact(state), right.exact(state)) {
        (Some(left), Some(right)) => {
            decide(comparison.compares(left, right), !comparison.compares(left, right))
        }
        (None, Some(right)) => against(comparison, left.bounds(state), right),
        (Some(left), None) => against(mirrored(comparison), right.bounds(state), left),
        (None, None) => {
            let ((a, b), (c, d)) = (left.bounds(state), right.bounds(state));
            match comparison {
                Relation::Less => decide(b < c, a >= d),
                Relation::LessEqual => decide(b <= c, a > d),
                Relation::Greater => decide(a > d, b <= c),
                Relation::GreaterEqual => decide(a >= d, b < c),
                Relation::Equal => decide(a == b && a == c && a == d, b < c || a > d),
                Relation::NotEqual => decide(b < c || a > d, a == b && a == c && a == d),
            }
        }
    };
    Truth::of_verdicts((0..left.len()).map(verdict))
}

/// A number within bounds compared with one that is known exactly.
fn against(comparison: Relation, (lower, upper): (f64, f64), exact: &Rational) -> Verdict {
    // A double is at least a number if and only if it is at least the next double above it.
    let (down, up) = (to_f64_down(exact), to_f64_up(exact));
    let is_point = lower == upper && down == up && lower == down;
    match comparison {
        Relation::GreaterEqual => decide(lower >= up, upper < up),
        Relation::Greater => decide(lower > down, upper <= down),
        Relation::LessEqual => decide(upper <= down, lower > down),
        Relation::Less => decide(upper < up, lower >= up),
        Relation::Equal => decide(is_point, lower > down || upper < up),
        Relation::NotEqual => decide(lower > down || upper < up, is_point),
    }
}

fn decide(holds: bool, fails: bool) -> Verdict {
    match (holds, fails) {
        (true, _) => Verdict::Holds,
        (_, true) => Verdict::Fails,
        _ => Verdict::Unknown,
    }
}

fn mirrored(comparison: Relation) -> Relation {
    match comparison {
        Relation::Less => Relation::Greater,
        Relation::LessEqual => Relation::GreaterEqual,
        Relation::Greater => Relation::Less,
        Relation::GreaterEqual => Relation::LessEqual,
        other => other,
    }
}
