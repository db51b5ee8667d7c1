//! What samples prove: binomial confidence bounds, and the confidence budget that pays for them.
//!
//! Everything is distribution-free and finite-sample: the only assumption is that samples are independent
//! and identically distributed.

mod binomial;
mod budget;
mod clopper_pearson;
mod independence;
mod reference;

pub use budget::{Allocation, BudgetError, ConfidenceBudget, Grant};
pub use clopper_pearson::{lower_bound, upper_bound};
pub use independence::{Departure, Trend, departures};
pub use reference::ReferenceIntervals;
