//! The confidence budget: which events the failure probability was spent on.

use imdp::numeric::{Rational, to_f64, to_f64_down};
use num_bigint::BigInt;
use serde::{Deserialize, Serialize};

/// A total failure probability `β`, handed out to families of events and never overspent.
///
/// If every event of every family fails with probability at most its level, then by the union bound all
/// of them hold together with probability at least `1 − β`.
#[derive(Clone, Debug)]
pub struct ConfidenceBudget {
    total: Rational,
    spent: Rational,
    allocations: Vec<Allocation>,
}

/// One family of events and what it was given.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Allocation {
    /// What the events are about.
    pub family: String,
    /// The number of events, rounded if beyond 2⁵³.
    pub events: f64,
    /// The failure probability given to the family.
    pub beta: f64,
}

/// What a family of events may spend, to be divided among its events by weight.
#[derive(Clone, Debug)]
pub struct Grant {
    per_weight: Rational,
}

/// The budget does not cover an allocation.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("the confidence budget of {total} is overspent by \"{family}\"")]
pub struct BudgetError {
    /// The family that asked for too much.
    pub family: String,
    /// The whole budget.
    pub total: f64,
}

impl ConfidenceBudget {
    /// A budget of `β`.
    pub fn new(total: Rational) -> Self {
        Self { total, spent: Rational::from_integer(0.into()), allocations: vec![] }
    }

    /// Gives `share · β` to a family of events whose weights sum to at most `weight`.
    ///
    /// Weights are fixed before any sample is looked at. An event, or a tail of one, with weight `w` may then
    /// fail with probability `share · β · w / weight`: [`Grant::level`].
    ///
    /// # Errors
    /// [`BudgetError`] if more than `β` would be spent in all.
    pub fn spend(
        &mut self,
        family: &str,
        share: &Rational,
        events: &BigInt,
        weight: &BigInt,
    ) -> Result<Grant, BudgetError> {
        let beta = &self.total * share;
        let spent = &self.spent + &beta;
        if spent > self.total {
            return Err(BudgetError { family: family.to_owned(), total: to_f64(&self.total) });
        }
        self.spent = spent;
        self.allocations.push(Allocation {
            family: family.to_owned(),
            events: to_f64(&Rational::from_integer(events.clone())),
            beta: to_f64(&beta),
        });
        Ok(Grant { per_weight: beta / Rational::from_integer(weight.clone()) })
    }

    /// What it was spent on.
    pub fn allocations(&self) -> &[Allocation] {
        &self.allocations
    }
}

impl Grant {
    /// The level of an event of this weight, rounded down.
    pub fn level(&self, weight: u64) -> f64 {
        to_f64_down(&(&self.per_weight * Rational::from_integer(weight.into())))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ratio(n: i64, d: i64) -> Rational {
        Rational::new(n.into(), d.into())
    }

    #[test]
    fn a_budget_is_spent_once() {
        let mut budget = ConfidenceBudget::new(ratio(1, 100));
        let grant = budget.spend("cells", &ratio(9, 10), &BigInt::from(2), &BigInt::from(10)).unwrap();
        let (level, rest) = (grant.level(3), grant.level(7));
        assert!(level <= 0.0027 && level > 0.002_699_999);
        assert!(level + rest <= 0.009);
        let one = BigInt::from(1);
        assert!(budget.spend("goal", &ratio(1, 10), &one, &one).is_ok());
        let error = budget.spend("more", &ratio(1, 1_000_000), &one, &one).unwrap_err();
        assert_eq!(error.family, "more");
        assert_eq!(budget.allocations().len(), 2);
    }
}
