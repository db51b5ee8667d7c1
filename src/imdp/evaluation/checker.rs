//! Proofs in place of computations.

use super::EvaluationError;
use super::product::Product;
use crate::certificate::Evidence;
use crate::model::{IntervalMdp, RewardStructure, StateSet};
use crate::numeric::Rational;
use crate::property::{QueryKind, Resolution};
use crate::solver::{Acceptance, Event, SolveError, ValueBounds};
use crate::verify::{
    OmegaCondition, ProvedBounds, Rejection, RewardTask, prove, prove_accepting, prove_nothing_missed,
    prove_rewards,
};
use num_traits::One;

fn condition(acceptance: &Acceptance) -> OmegaCondition<'_> {
    OmegaCondition { finitely: &acceptance.finitely, infinitely: &acceptance.infinitely }
}

/// The proofs that are left, and how much was checked.
pub(super) struct Checker<'a> {
    proofs: std::slice::Iter<'a, Evidence>,
    /// How many steps were checked.
    pub(super) steps: u64,
    /// How many rows.
    pub(super) rows: u64,
}

impl<'a> Checker<'a> {
    /// Nothing checked yet.
    pub(super) fn new(proofs: &'a [Evidence]) -> Self {
        Self { proofs: proofs.iter(), steps: 0, rows: 0 }
    }

    /// How many proofs have not been asked for.
    pub(super) fn num_left(&self) -> usize {
        self.proofs.len()
    }

    /// What the next proof proves about the probability of an event.
    pub(super) fn event(
        &mut self,
        model: &IntervalMdp,
        event: &Event<'_>,
        first: u64,
        resolution: Resolution,
    ) -> Result<ValueBounds, EvaluationError> {
        if first > 0 {
            let problem =
                "found an event that begins after some steps; expected one that has proofs".to_owned();
            return Err(Rejection::Expression { problem }.into());
        }
        let kind = match *event {
            Event::Until { safe, goal, steps } => {
                QueryKind::Until { safe: safe.clone(), goal: goal.clone(), steps }
            }
            Event::Next { goal } => QueryKind::Next { goal: goal.clone() },
        };
        let evidence = self.next()?;
        Ok(self.note(prove(model, kind, resolution, evidence)?))
    }

    /// What the next proof proves about an expected reward.
    pub(super) fn rewards(
        &mut self,
        model: &IntervalMdp,
        rewards: &RewardStructure,
        task: &RewardTask<'_>,
        resolution: Resolution,
    ) -> Result<ValueBounds, EvaluationError> {
        if matches!(task, RewardTask::Cumulative { steps: None, discount } if *discount >= Rational::one()) {
            return Err(SolveError::Undiscounted.into());
        }
        let evidence = self.next()?;
        Ok(self.note(prove_rewards(model, rewards, task, resolution, evidence)?))
    }

    /// Checks where runs of a product satisfy the path formula: for certain, and perhaps.
    pub(super) fn goals(
        &self,
        product: &Product,
        [lower, upper]: [&StateSet; 2],
        resolution: Resolution,
    ) -> Result<(), Rejection> {
        let conditions: Vec<_> = product.conditions.iter().map(condition).collect();
        let (model, satisfied) = (&product.model, &product.satisfied);
        prove_accepting(model, &conditions, (lower, satisfied), resolution.nature_maximises())?;
        prove_nothing_missed(model, &conditions, (upper, satisfied))
    }

    fn next(&mut self) -> Result<&'a Evidence, Rejection> {
        let missing = || Rejection::Expression {
            problem: "found fewer proofs than operators; expected one for each".to_owned(),
        };
        self.proofs.next().ok_or_else(missing)
    }

    fn note(&mut self, proved: ProvedBounds) -> ValueBounds {
        self.steps += proved.steps;
        self.rows += proved.rows;
        ValueBounds { lower: proved.lower, upper: proved.upper }
    }
}
