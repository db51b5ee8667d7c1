//! The confidence budget: which events the failure probability was spent on.

use crate::numeric::{Rational, to_f64, to_f64_down};
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
    /// The number of events, as a decimal integer.
    pub events: f64,
    /// The failure probability given to the family.
    pub beta: f64,
    /// The one-sided tails per event that share its level.
    pub tails: u32,
    /// The one-sided level per tail, rounded down.
    pub level: f64,
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

    /// Spends `share · β` on `events` events with `tails` one-sided tails each; returns the level per tail.
    ///
    /// # Errors
    /// [`BudgetError`] if more than `β` would be spent in all.
    pub fn spend(
        &mut self,
        family: &str,
        share: &Rational,
        events: &BigInt,
        tails: u32,
    ) -> Result<f64, BudgetError> {
        let beta = &self.total * share;
        let spent = &self.spent + &beta;
        if spent > self.total {
            return Err(BudgetError { family: family.to_owned(), total: to_f64(&self.total) });
        }
        self.spent = spent;
        let per_tail = &beta / Rational::from_integer(events * BigInt::from(tails));
        let level = to_f64_down(&per_tail);
        self.allocations.push(Allocation {
            family: family.to_owned(),
            events: to_f64(&Rational::from_integer(events.clone())),
            beta: to_f64(&beta),
            tails,
            level,
        });
        Ok(level)
    }

    /// The whole budget.
    pub fn total(&self) -> f64 {
        to_f64(&self.total)
    }

    /// What it was spent on.
    pub fn allocations(&self) -> &[Allocation] {
        &self.allocations
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
        let level = budget.spend("cells", &ratio(9, 10), &BigInt::from(81), 2).unwrap();
        assert!(level <= 0.009 / 162.0 && level > 0.008_999_999 / 162.0);
        assert!(budget.spend("goal", &ratio(1, 10), &BigInt::from(1), 1).is_ok());
        let error = budget.spend("more", &ratio(1, 1_000_000), &BigInt::from(1), 1).unwrap_err();
        assert_eq!(error.family, "more");
        assert_eq!(budget.allocations().len(), 2);
    }
}
