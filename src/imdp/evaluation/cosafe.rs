//! Rewards until a co-safe formula holds: one that, where it holds, a beginning of the run shows it.

use super::EvaluationError;
use super::expression::Evaluator;
use super::product::Product;
use crate::automaton::Automaton;
use crate::model::RewardStructure;
use crate::property::{Node, Resolution};
use crate::solver::ValueBounds;
use crate::verify::RewardTask;

impl Evaluator<'_> {
    /// Bounds on what is earned before the automaton of the formula knows that it holds; infinite where it may never know.
    pub(super) fn cosafe_reward(
        &mut self,
        rewards: &RewardStructure,
        path: &Node,
        resolution: Resolution,
    ) -> Result<ValueBounds, EvaluationError> {
        let mut propositions = vec![];
        let formula = self.formula(path, &mut propositions)?;
        let letters = self.letters(&propositions)?;
        let product = Product::new(self.model, &mut Automaton::new(&formula)?, &letters)?;
        let rewards = product.rewards(self.model, rewards);
        let task = RewardTask::Reach(&product.satisfied);
        let values = self.earned(&product.model, &rewards, &task, resolution)?;
        // The policy is one of the product.
        self.policy = None;
        let of_starts = |values: &[f64]| product.starts.iter().map(|&state| values[state.index()]).collect();
        Ok(ValueBounds { lower: of_starts(&values.lower), upper: of_starts(&values.upper) })
    }
}
