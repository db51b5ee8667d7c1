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
use std::sync::Arc;

/// Runs from this length on are copied as a whole, if all of their cells are listed.
const WORTH_COPYING: usize = 16;

/// Shorter runs are copied together with what comes after them: always so many cells, which takes less time than to count them.
const SHORT: usize = 8;

/// The intervals of cells around an origin.
#[derive(Clone, Debug)]
pub(super) struct Stencil {
    runs: Arc<Runs>,
    /// The interval that the first special state mostly has.
    usual: (f64, f64),
    lower: Lower,
    /// By position in the runs, after that of the first special state.
    upper: Arc<[f64]>,
}

/// The lower bounds of a stencil.
#[derive(Clone, Debug)]
enum Lower {
    /// By position in the runs, after that of the first special state.
    InOrder(Arc<[f64]>),
    /// By place, and the place of every position in the runs: what stencils of several shapes have in common.
    At(Arc<[f64]>, Arc<[u32]>),
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
        let (lower, upper): (Vec<f64>, Vec<f64>) =
            std::iter::once(usual).chain((0..volume).filter_map(&interval)).unzip();
        let runs = Runs::new(hull, ground, |position| interval(position).is_some());
        Self { runs: Arc::new(runs), usual, lower: Lower::InOrder(lower.into()), upper: upper.into() }
    }

    /// The same cells with other lower bounds, of which the cells have those at their places, and another usual interval.
    pub(super) fn with_lower(&self, usual: (f64, f64), of_places: Arc<[f64]>, places: Arc<[u32]>) -> Self {
        Self { usual, lower: Lower::At(of_places, places), ..self.clone() }
    }

    /// The cells.
    pub(super) fn runs(&self) -> &Runs {
        &self.runs
    }

    /// The interval that the first special state mostly has.
    pub(super) fn usual(&self) -> (f64, f64) {
        self.usual
    }

    /// Whether these are the cells of another stencil, with lower bounds nowhere above its own; upper bounds are the same.
    pub(super) fn is_within(&self, other: &Self) -> bool {
        let (runs, others) = (&self.runs, &other.runs);
        runs.hull() == others.hull()
            && runs.len() == others.len()
            && self.upper[1..] == other.upper[1..]
            && (0..runs.len()).all(|position| self.lower(position) <= other.lower(position))
    }

    /// The lower bound at a position in the runs.
    pub(super) fn lower(&self, position: usize) -> f64 {
        match &self.lower {
            Lower::InOrder(lower) => lower[position + 1],
            Lower::At(of_places, places) => of_places[places[position] as usize],
        }
    }

    /// The upper bound at a position in the runs.
    pub(super) fn upper(&self, position: usize) -> f64 {
        self.upper[position + 1]
    }

    /// The row at `origin`, if it has so many entries.
    pub(super) fn row<'a>(
        &'a self,
        ground: &Ground,
        origin: &[i32],
        (special, length): (Special, usize),
        entries: &'a mut RowEntries,
    ) -> Row<'a> {
        if self.is_whole(length, special) {
            return self.whole_row(ground, origin, special, entries);
        }
        let RowEntries { successors, lower, upper } = entries;
        // More than that, for what is written and not listed.
        let room = length.min(self.runs.len() + 1) + SHORT;
        if successors.len() < room {
            successors.resize(room, StateId(0));
        }
        for bounds in [&mut *lower, &mut *upper] {
            if bounds.len() < room {
                bounds.resize(room, 0.0);
            }
        }
        let mut end = 0;
        let specials = [Some((StateId(0), special.first)), special.reached.map(|b| (StateId(1), b))];
        for (state, bounds) in specials.into_iter().flatten() {
            (successors[end], lower[end], upper[end]) = (state, bounds.0, bounds.1);
            end += 1;
        }
        let lists_whole_box = self.lists_whole_box(ground, origin, length - end);
        self.runs.for_each(ground, origin, |first, position, length| {
            let states = &ground.states[first..];
            if lists_whole_box || length >= WORTH_COPYING && ground.lists_all(&states[..length]) {
                copy_run(states, &mut successors[end..], length);
                copy_run(&self.upper[position + 1..], &mut upper[end..], length);
                match &self.lower {
                    Lower::InOrder(own) => copy_run(&own[position + 1..], &mut lower[end..], length),
                    Lower::At(of_places, places) => {
                        let places = places[position..position + length].iter();
                        lower[end..]
                            .iter_mut()
                            .zip(places)
                            .for_each(|(low, &i)| *low = of_places[i as usize]);
                    }
                }
                end += length;
                return;
            }
            let highs = &self.upper[position + 1..position + 1 + length];
            for ((&state, &high), position) in states.iter().zip(highs).zip(position..) {
                // What is not listed is overwritten by what comes next.
                (successors[end], lower[end], upper[end]) = (state, self.lower(position), high);
                end += usize::from(ground.lists(state));
            }
        });
        Row { successors: &successors[..end], lower: &lower[..end], upper: &upper[..end], exact: &[] }
    }

    /// Whether a row that lists so many cells lists all of the stencil's box that are in the grid.
    fn lists_whole_box(&self, ground: &Ground, origin: &[i32], cells: usize) -> bool {
        let hull = self.runs.hull();
        self.runs.len() == hull.volume() && ground.volume(hull, origin) as usize == cells
    }

    /// Whether a row with so many entries lists all cells, with nothing else before them than is at hand.
    fn is_whole(&self, entries: usize, special: Special) -> bool {
        let is_usual = matches!(self.lower, Lower::At(..)) || special.first == self.usual;
        special.reached.is_none() && entries == self.upper.len() && is_usual
    }

    /// The same for a row of which it is known that it lists all cells of the stencil.
    fn whole_row<'a>(
        &'a self,
        ground: &Ground,
        origin: &[i32],
        special: Special,
        entries: &'a mut RowEntries,
    ) -> Row<'a> {
        let RowEntries { successors, lower, upper } = entries;
        successors.clear();
        successors.push(StateId(0));
        self.runs.for_each(ground, origin, |first, _, length| {
            successors.extend_from_slice(&ground.states[first..first + length]);
        });
        let (lower, upper) = match &self.lower {
            Lower::InOrder(lower) => (&lower[..], &self.upper[..]),
            Lower::At(of_places, places) => {
                lower.clear();
                lower.push(special.first.0);
                lower.extend(places.iter().map(|&place| of_places[place as usize]));
                upper.clear();
                upper.push(special.first.1);
                upper.extend_from_slice(&self.upper[1..]);
                (&lower[..], &upper[..])
            }
        };
        Row { successors, lower, upper, exact: &[] }
    }
}

/// Copies so many numbers from the beginning of one array to that of another; what comes after them is overwritten later.
fn copy_run<T: Copy>(from: &[T], to: &mut [T], length: usize) {
    match (from.first_chunk::<SHORT>(), to.first_chunk_mut::<SHORT>()) {
        (Some(from), Some(to)) if length <= SHORT => *to = *from,
        _ => to[..length].copy_from_slice(&from[..length]),
    }
}

#[cfg(test)]
mod tests;
