//! Which window a row is made with.

use super::super::stencil::{Chosen, Stencil};
use super::{Action, PacRows};
use imdp::model::{Row, RowBuffer, RowSet};
use imdp::solver::WorstExpectation;

/// What is preferred of two windows; of equal ones, the larger.
#[derive(Clone, Copy)]
pub(in super::super) enum Preference<'v> {
    /// That with which less mass may fail.
    LeastFailing,
    /// That with which the worst expectation of these values is larger.
    ///
    /// A window with less mass outside may list more cells, each of which may get some mass: which of the two
    /// costs more depends on what these cells are worth.
    Worth(&'v Worth),
}

/// What it is worth to be in a state.
pub(in super::super) struct Worth {
    values: Vec<f64>,
    /// Per row, at least the largest value among its successors, whatever the window.
    most: Vec<f64>,
}

impl Worth {
    /// With these values, for rows that differ from `rows` in their windows only.
    pub(in super::super) fn new(values: Vec<f64>, rows: &RowSet) -> Self {
        Self { most: rows.most_of_successors(&values), values }
    }
}

/// Chooses windows, row after row.
pub(super) struct Chooser<'a> {
    rows: &'a PacRows<'a>,
    preference: Preference<'a>,
    /// The windows that may be chosen.
    rivals: &'a [usize],
    buffer: RowBuffer,
    expectation: WorstExpectation,
}

impl<'a> Chooser<'a> {
    pub(super) fn new(rows: &'a PacRows<'a>, preference: Preference<'a>, rivals: &'a [usize]) -> Self {
        Self {
            rows,
            preference,
            rivals,
            buffer: RowBuffer::default(),
            expectation: WorstExpectation::default(),
        }
    }

    /// The window of an action's row, and what follows from it.
    pub(super) fn choose(&mut self, stencils: &[Stencil], action: Action<'_>) -> Chosen {
        let Self { rows, preference, rivals, buffer: RowBuffer { entries, coordinates }, expectation } = self;
        action.ground.origin(action.target, coordinates);
        let first = rows.first_stencil(action.target);
        let stencils = &stencils[first..first + rows.windows()];
        let windows = rivals.iter().copied();
        let best = match preference {
            Preference::Worth(Worth { most, .. }) if most[action.row.index()] == 0.0 => 0,
            Preference::LeastFailing => {
                first_best(windows, |window| -rows.failed(&stencils[window], action, coordinates, window))
            }
            Preference::Worth(Worth { values, .. }) => first_best(windows, |window| {
                let stencil = &stencils[window];
                let special = rows.special(stencil, action, coordinates, window);
                let length = rows.length(stencil, action, coordinates, special) as usize;
                expectation.of(stencil.row(action.ground, coordinates, (special, length), entries), values)
            }),
        };
        let stencil = &stencils[best];
        let special = rows.special(stencil, action, coordinates, best);
        let length = rows.length(stencil, action, coordinates, special);
        Chosen { stencil: (first + best) as u32, special, length }
    }

    /// The row chosen last.
    pub(super) fn row<'b>(
        &'b mut self,
        stencils: &'b [Stencil],
        chosen: &Chosen,
        action: Action<'_>,
    ) -> Row<'b> {
        let RowBuffer { entries, coordinates } = &mut self.buffer;
        let of_row = (chosen.special, chosen.length as usize);
        stencils[chosen.stencil as usize].row(action.ground, coordinates, of_row, entries)
    }
}

/// The first of those for which the worth is greatest.
fn first_best(candidates: impl Iterator<Item = usize>, mut worth: impl FnMut(usize) -> f64) -> usize {
    let mut best = (0, f64::NEG_INFINITY);
    for candidate in candidates {
        let own = worth(candidate);
        if own > best.1 {
            best = (candidate, own);
        }
    }
    best.0
}
