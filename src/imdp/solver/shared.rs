//! What is known of a whole model while its components are solved one after the other.

use super::query::Players;
use super::range_optimum::RangeOptimum;
use crate::model::{IntervalMdp, StateId, StateSet};
use std::collections::BTreeMap;

/// Bounds in units of `2⁻¹²⁰`, by state, where doubles do not reproduce themselves.
pub(super) type Precise = BTreeMap<StateId, u128>;

/// The bounds of the whole model, as far as they are known.
pub(super) struct Shared<'a> {
    pub model: &'a IntervalMdp,
    pub players: Players,
    pub lower: Vec<f64>,
    pub upper: Vec<f64>,
    pub lower_rows: RangeOptimum,
    pub upper_rows: RangeOptimum,
    /// A maximising policy: the choice by which each state's lower bound was last improved.
    pub choices: Vec<u32>,
    /// Whether anybody will ask for it.
    pub wants_policy: bool,
    /// Bounds that are no doubles; those in `lower` and `upper` are rounded to the safe side.
    pub precise_lower: Precise,
    pub precise_upper: Precise,
    /// After so many sweeps it is time for linear equations.
    pub patience: u64,
    /// The rows of the component being solved.
    pub own_rows: StateSet,
}
