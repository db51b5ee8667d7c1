//! Rows that are translations of a few stencils, computed when they are needed.
//!
//! Where all targets sit alike in their cells, the interval of a cell depends only on where it lies from the target's: a row
//! is a stencil of intervals, shifted to its target and cut off at the border of the grid. What is kept per row is which
//! stencil it is and what its special states get.

mod box_count;
mod ground;
mod hits;
mod reach;
mod rows;
mod runs;

use super::cell_box::CellBox;
pub(super) use box_count::BoxCount;
pub(super) use ground::Ground;
pub(super) use hits::Hits;
use imdp::model::{Row, RowEntries, StateId};
pub(super) use rows::{Chosen, StencilRows};
pub(super) use runs::Runs;

/// The intervals of cells around an origin.
#[derive(Clone, Debug)]
pub(super) struct Stencil {
    runs: Runs,
    /// By position in the runs, after the interval that the first special state mostly has.
    lower: Vec<f64>,
    upper: Vec<f64>,
}

/// The intervals of the special states in a row: the first one, and all goal cells together if it meets some.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Special {
    pub(super) first: (f64, f64),
    pub(super) reached: Option<(f64, f64)>,
}

impl Stencil {
    /// The stencil of all cells of a box that have an interval, given by their row-major position in the box; `usual` is the
    /// interval that the first special state mostly has.
    pub(super) fn new(
        hull: &CellBox,
        ground: &Ground,
        usual: (f64, f64),
        interval: impl Fn(usize) -> Option<(f64, f64)>,
    ) -> Self {
        let volume = hull.volume();
        let (lower, upper) = std::iter::once(usual).chain((0..volume).filter_map(&interval)).unzip();
        Self { runs: Runs::new(hull, ground, |position| interval(position).is_some()), lower, upper }
    }

    /// The cells.
    pub(super) fn runs(&self) -> &Runs {
        &self.runs
    }

    /// The lower bound at a position in the runs.
    pub(super) fn lower(&self, position: usize) -> f64 {
        self.lower[position + 1]
    }

    /// The upper bound at a position in the runs.
    pub(super) fn upper(&self, position: usize) -> f64 {
        self.upper[position + 1]
    }

    /// The interval that the first special state mostly has.
    pub(super) fn usual(&self) -> (f64, f64) {
        (self.lower[0], self.upper[0])
    }

    /// The row at `origin`.
    pub(super) fn row<'a>(
        &'a self,
        ground: &Ground,
        origin: &[i32],
        special: Special,
        entries: &'a mut RowEntries,
    ) -> Row<'a> {
        let RowEntries { successors, lower, upper } = entries;
        let room = self.runs.len() + 2;
        successors.resize(room, StateId(0));
        lower.resize(room, 0.0);
        upper.resize(room, 0.0);
        let mut end = 0;
        let specials = [Some((StateId(0), special.first)), special.reached.map(|b| (StateId(1), b))];
        for (state, bounds) in specials.into_iter().flatten() {
            (successors[end], lower[end], upper[end]) = (state, bounds.0, bounds.1);
            end += 1;
        }
        self.runs.for_each(ground, origin, |first, position, length| {
            let states = &ground.states[first..first + length];
            let own = position + 1..position + 1 + length;
            let bounds = self.lower[own.clone()].iter().zip(&self.upper[own]);
            for (&state, (&low, &high)) in states.iter().zip(bounds) {
                // What is not listed is overwritten by what comes next.
                (successors[end], lower[end], upper[end]) = (state, low, high);
                end += usize::from(ground.lists(state));
            }
        });
        Row { successors: &successors[..end], lower: &lower[..end], upper: &upper[..end], exact: &[] }
    }

    /// Whether a row with so many entries lists all cells, with the usual interval before them.
    fn is_whole(&self, entries: usize, special: Special) -> bool {
        let Special { first, reached } = special;
        reached.is_none() && entries == self.lower.len() && first == self.usual()
    }

    /// The same for a row of which it is known that it lists all cells of the stencil, and has the usual interval before them.
    fn whole_row<'a>(&'a self, ground: &Ground, origin: &[i32], entries: &'a mut RowEntries) -> Row<'a> {
        let successors = &mut entries.successors;
        successors.clear();
        successors.push(StateId(0));
        self.runs.for_each(ground, origin, |first, _, length| {
            successors.extend_from_slice(&ground.states[first..first + length]);
        });
        Row { successors, lower: &self.lower, upper: &self.upper, exact: &[] }
    }
}

#[cfg(test)]
mod tests;
