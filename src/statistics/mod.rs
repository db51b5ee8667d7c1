//! What samples prove: binomial confidence bounds, the mass they have not seen, the confidence budget.
//!
//! Everything is distribution-free and finite-sample: the only assumption is that samples are independent
//! and identically distributed.

mod binomial;
mod budget;
mod clopper_pearson;
mod reference;
mod unseen_mass;

pub use budget::{Allocation, BudgetError, ConfidenceBudget};
pub use clopper_pearson::{lower_bound, upper_bound};
pub use reference::ReferenceIntervals;
pub use unseen_mass::unseen_mass;
