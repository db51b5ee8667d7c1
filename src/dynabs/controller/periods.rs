//! Coordinates that come round again.

use crate::partition::{CellLookup, Grid, GridAxis};
use imdp::numeric::to_f64;
use std::borrow::Cow;

/// The period of every coordinate: the partition covers one.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Periods {
    /// 0 where a coordinate is not periodic.
    pub(super) lengths: Vec<f64>,
}

impl Periods {
    pub(super) fn new(grid: &Grid, periodic: &[bool]) -> Self {
        let length = |(axis, &periodic): (&GridAxis, &bool)| {
            if periodic { to_f64(&(axis.upper() - axis.lower())) } else { 0.0 }
        };
        Self { lengths: grid.axes().iter().zip(periodic).map(length).collect() }
    }

    /// Moves periodic coordinates into the partition: `x − period · ⌊(x − lower) / period⌋`.
    pub(super) fn wrap(&self, lookup: &CellLookup, x: &mut [f64]) {
        for ((x, &period), faces) in x.iter_mut().zip(&self.lengths).zip(lookup.faces()) {
            let (lower, upper) = (faces[0], faces[faces.len() - 1]);
            if period > 0.0 && x.is_finite() {
                let turns = ((*x - lower) / period).floor();
                *x -= turns * period;
                // Rounding may put it on either end.
                if *x < lower || *x >= upper {
                    *x = lower;
                }
            }
        }
    }

    /// The state with its periodic coordinates in the partition.
    pub(super) fn wrapped<'x>(&self, lookup: &CellLookup, x: &'x [f64]) -> Cow<'x, [f64]> {
        if self.lengths.iter().all(|&period| period == 0.0) {
            return Cow::Borrowed(x);
        }
        let mut wrapped = x.to_vec();
        self.wrap(lookup, &mut wrapped);
        Cow::Owned(wrapped)
    }
}
