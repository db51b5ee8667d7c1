//! What expressions come to.

use super::{Numbers, Truth};
use crate::certificate::Claim;
use crate::model::IntervalMdp;
use crate::property::Verdict;

/// What an expression comes to in every state.
#[derive(Clone, Debug)]
pub enum Values {
    /// A formula: where it holds.
    Truth(Truth),
    /// A number.
    Numbers(Numbers),
}

impl Values {
    /// What is known of the initial states.
    pub(super) fn claim(&self, model: &IntervalMdp) -> Claim {
        let initial = || model.initial().ones();
        match self {
            Self::Truth(truth) => Claim::Verdict(Verdict::in_all(initial().map(|s| truth.verdict(s)))),
            Self::Numbers(numbers) => {
                let all: Vec<_> = initial().map(|s| numbers.bounds(s)).collect();
                let lower = all.iter().map(|bounds| bounds.0).fold(f64::INFINITY, f64::min);
                let upper = all.iter().map(|bounds| bounds.1).fold(f64::NEG_INFINITY, f64::max);
                Claim::Between(lower, upper)
            }
        }
    }
}
