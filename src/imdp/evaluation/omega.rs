//! Path formulas of all kinds, by their automata.

use super::expression::Evaluator;
use super::product::Product;
use super::{EvaluationError, Known, Truth};
use crate::automaton::{Acceptor, Automaton, Ltl};
use crate::model::{StateId, StateSet};
use crate::property::Resolution;
use crate::solver::{Event, SolverOptions};

impl Evaluator<'_> {
    /// Bounds on the probability of a formula over propositions.
    pub(super) fn omega(
        &mut self,
        formula: &Ltl,
        propositions: &[Truth],
        resolution: Resolution,
    ) -> Result<Known, EvaluationError> {
        if !resolution.policy_maximises() {
            // A policy that minimises one formula maximises its negation.
            let negation = Ltl::Not(Box::new(formula.clone()));
            return Ok(self.omega(&negation, propositions, resolution.flipped())?.complement());
        }
        self.accepted(&mut Automaton::new(formula)?, propositions, resolution)
    }

    /// Bounds on the probability of a run that is accepted; the policy maximises.
    pub(super) fn accepted(
        &mut self,
        acceptor: &mut dyn Acceptor,
        propositions: &[Truth],
        resolution: Resolution,
    ) -> Result<Known, EvaluationError> {
        let letters = self.letters(propositions)?;
        let product = Product::new(self.model, acceptor, &letters)?;
        let all = {
            let mut all = StateSet::with_capacity(product.model.num_states());
            all.insert_range(..);
            all
        };
        let upper_goal = product.goal(true);
        let lower_goal = if resolution.nature_maximises() { upper_goal.clone() } else { product.goal(false) };
        if let Some(checker) = &self.checker {
            checker.goals(&product, [&lower_goal, &upper_goal], resolution)?;
        }
        let options = SolverOptions { policy: false, ..self.options };
        // Where values are wanted exactly, they are those of where runs begin.
        let exactly = self.exactly.take();
        self.exactly = exactly.as_ref().map(|wanted| {
            let mut starts = StateSet::with_capacity(product.model.num_states());
            wanted.ones().for_each(|state| starts.insert(product.starts[state].index()));
            starts
        });
        let until = |this: &mut Self, goal| {
            let event = Event::Until { safe: &all, goal, steps: None };
            this.solved((&product.model, &options), &event, 0, resolution)
        };
        let lower = until(self, &lower_goal);
        let upper = if lower_goal == upper_goal { None } else { Some(until(self, &upper_goal)) };
        self.exactly = exactly;
        let lower = lower?;
        let of_starts = |values: &[f64]| product.starts.iter().map(|&state| values[state.index()]).collect();
        Ok(match upper.transpose()? {
            None => {
                let exact = |(state, start): (usize, &StateId)| {
                    lower.exact.get(&(start.index())).map(|value| (state, value.clone()))
                };
                let exact = product.starts.iter().enumerate().filter_map(exact).collect();
                let Known { bounds, .. } = &lower;
                Known { exact, ..Known::within(of_starts(&bounds.lower), of_starts(&bounds.upper)) }
            }
            Some(upper) => Known::within(of_starts(&lower.bounds.lower), of_starts(&upper.bounds.upper)),
        })
    }

    /// For every state, the set of the propositions that hold in it.
    pub(super) fn letters(&self, propositions: &[Truth]) -> Result<Vec<u64>, EvaluationError> {
        let mut letters = vec![0u64; self.model.num_states()];
        for (index, proposition) in propositions.iter().enumerate() {
            for state in proposition.decided()?.ones() {
                letters[state] |= 1 << (index % 64);
            }
        }
        Ok(letters)
    }
}
