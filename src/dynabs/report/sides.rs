//! Sides of regions as numbers.

use crate::partition::Region;
use imdp::numeric::{Rational, to_f64};

/// A side of a region in one dimension, open sides as infinite numbers.
pub(super) fn sides(region: &Region, dimension: usize) -> (f64, f64) {
    let side = |side: &Option<Rational>, open: f64| side.as_ref().map_or(open, to_f64);
    (side(&region.lower[dimension], f64::NEG_INFINITY), side(&region.upper[dimension], f64::INFINITY))
}
