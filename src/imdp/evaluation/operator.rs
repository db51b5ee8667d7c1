//! The operators `P` and `R`.

use super::expression::{Evaluator, is_zero_or_one};
use super::syntax::{is_path, number, steps};
use super::{EvaluationError, Known, Numbers, Truth, directions};
use crate::model::{IntervalMdp, RewardStructure};
use crate::numeric::{Rational, to_f64};
use crate::property::{
    Asked, Constant, Measured, NodeKind, Operator, Relation, Resolution, RewardPath, Structure,
    TemporalOperator, ThresholdComparison, constant,
};
use crate::solver::{RewardQuery, Solution, Status, ValueBounds, solve_rewards};
use crate::verify::RewardTask;
use num_traits::{One, ToPrimitive};

impl Evaluator<'_> {
    /// `P>=p […]`: whether it holds whatever policy and nature do.
    pub(super) fn bounded_operator(&mut self, operator: &Operator) -> Result<Truth, EvaluationError> {
        let Asked::ForAll(comparison, threshold) = &operator.asked else {
            return Ok(Truth::constant(false, self.model.num_states()));
        };
        let resolution = if comparison.is_lower_bound() { Resolution::Pminmin } else { Resolution::Pmaxmax };
        let comparison = match comparison {
            ThresholdComparison::AtLeast => Relation::GreaterEqual,
            ThresholdComparison::Above => Relation::Greater,
            ThresholdComparison::AtMost => Relation::LessEqual,
            ThresholdComparison::Below => Relation::Less,
        };
        let is_extreme = is_zero_or_one(threshold);
        self.compared(comparison, is_extreme, |evaluator| {
            let values = Numbers::Bounds(evaluator.measured(&operator.measured, resolution)?);
            Ok((values, evaluator.numbers(threshold)?))
        })
    }

    /// `Pmaxmin=? […]` and the like: bounds on the value.
    pub(super) fn operator(&mut self, operator: &Operator) -> Result<Known, EvaluationError> {
        let Asked::Value(optimum) = operator.asked else { return Ok(self.nothing_known()) };
        let resolution = directions::resolution(optimum, self.model, self.nature)?;
        self.measured(&operator.measured, resolution)
    }

    fn measured(&mut self, measured: &Measured, resolution: Resolution) -> Result<Known, EvaluationError> {
        self.operators += usize::from(self.exactly.is_none());
        match measured {
            Measured::Probability(path) => self.probability(path, resolution),
            // Rewards are known within bounds only.
            Measured::Reward(..) if self.exactly.is_some() => Ok(self.nothing_known()),
            Measured::Reward(structure, path) => {
                let bounds = self.reward(structure, path, resolution)?;
                Ok(Known::within(bounds.lower, bounds.upper))
            }
        }
    }

    fn reward(
        &mut self,
        structure: &Structure,
        path: &RewardPath,
        resolution: Resolution,
    ) -> Result<ValueBounds, EvaluationError> {
        let model = self.model;
        let rewards = find(model.rewards(), structure)?;
        match path {
            RewardPath::Reach(node) => {
                let operand = match &node.kind {
                    NodeKind::Temporal(TemporalOperator::Finally, bounds, operand)
                        if bounds.is_none() && !is_path(operand) =>
                    {
                        operand
                    }
                    _ => return self.cosafe_reward(rewards, node, resolution),
                };
                let goal = self.truth(operand)?;
                if goal.is_exact() {
                    return self.earned(model, rewards, &RewardTask::Reach(&goal.must), resolution);
                }
                // The later the goal is met, the more is earned.
                let lower = self.earned(model, rewards, &RewardTask::Reach(&goal.may), resolution)?;
                let upper = self.earned(model, rewards, &RewardTask::Reach(&goal.must), resolution)?;
                Ok(ValueBounds { lower: lower.lower, upper: upper.upper })
            }
            RewardPath::Cumulative(bound, factor) => {
                let discount = factor.as_ref().and_then(constant).and_then(Constant::number);
                let discount = discount.unwrap_or_else(Rational::one);
                let task = RewardTask::Cumulative { steps: bound.as_ref().map(steps), discount };
                self.earned(model, rewards, &task, resolution)
            }
            RewardPath::Instantaneous(node) => {
                self.earned(model, rewards, &RewardTask::Instantaneous(number(node) as u64), resolution)
            }
        }
    }

    /// Bounds on an expected reward of a model, computed or proved.
    pub(super) fn earned(
        &mut self,
        model: &IntervalMdp,
        rewards: &RewardStructure,
        task: &RewardTask<'_>,
        resolution: Resolution,
    ) -> Result<ValueBounds, EvaluationError> {
        if let Some(checker) = &mut self.checker {
            return checker.rewards(model, rewards, task, resolution);
        }
        let query = match task {
            RewardTask::Reach(goal) => RewardQuery::Reach(goal),
            RewardTask::Cumulative { steps, discount } => {
                RewardQuery::Cumulative { steps: *steps, discount: to_f64(discount) }
            }
            RewardTask::Instantaneous(step) => RewardQuery::Instantaneous(*step),
        };
        let solution = solve_rewards(model, rewards, &query, resolution, &self.options)?;
        Ok(self.note(solution))
    }

    /// Takes note of how a computation ended, and hands on its values.
    pub(super) fn note(&mut self, solution: Solution) -> ValueBounds {
        self.iterations += solution.iterations;
        if rank(solution.status) > rank(self.status) {
            self.status = solution.status;
        }
        self.policy = solution.policy;
        match solution.evidence {
            Some(evidence) => self.evidence.push(evidence),
            None => self.is_unproved = true,
        }
        solution.values
    }

    pub(super) fn nothing_known(&self) -> Known {
        let states = self.model.num_states();
        Known::within(vec![0.0; states], vec![f64::INFINITY; states])
    }
}

/// How unsatisfactory an ending is.
fn rank(status: Status) -> u8 {
    match status {
        Status::HorizonReached => 0,
        Status::Converged => 1,
        Status::PrecisionLimit => 2,
        Status::IterationLimit => 3,
        Status::TimeLimit => 4,
        Status::Interrupted => 5,
    }
}

fn find<'m>(
    rewards: &'m crate::model::Rewards,
    structure: &Structure,
) -> Result<&'m RewardStructure, EvaluationError> {
    let (found, text) = match structure {
        Structure::First => (rewards.nth(0), "at all".to_owned()),
        Structure::Name(name) => (rewards.get(name), format!("\"{name}\"")),
        Structure::Number(node) => {
            let number =
                constant(node).and_then(Constant::number).and_then(|value| value.to_integer().to_usize());
            let number = number.unwrap_or(0);
            (number.checked_sub(1).and_then(|index| rewards.nth(index)), number.to_string())
        }
    };
    found.ok_or_else(|| {
        let known: Vec<_> = rewards.iter().map(|structure| format!("\"{}\"", structure.name)).collect();
        let known = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
        EvaluationError::UnknownRewards { found: text, known }
    })
}
