//! Which window a row is made with.

use super::super::stencil::{Chosen, Stencil};
use super::{Action, PacRows};
use imdp::model::{Row, RowBuffer};
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
    Worth(&'v [f64]),
}

/// Chooses windows, row after row.
pub(super) struct Chooser<'a> {
    rows: &'a PacRows<'a>,
    preference: Preference<'a>,
    buffer: RowBuffer,
    expectation: WorstExpectation,
}

impl<'a> Chooser<'a> {
    pub(super) fn new(rows: &'a PacRows<'a>, preference: Preference<'a>) -> Self {
        Self { rows, preference, buffer: RowBuffer::default(), expectation: WorstExpectation::default() }
    }

    /// The window of an action's row, and what follows from it.
    pub(super) fn choose(&mut self, stencils: &[Stencil], action: Action<'_>) -> Chosen {
        let Self { rows, preference, buffer: RowBuffer { entries, coordinates }, expectation } = self;
        action.ground.origin(action.target, coordinates);
        let (first, windows) = (rows.first_stencil(action.target), 0..rows.windows());
        let stencils = &stencils[first..first + windows.len()];
        let best = match preference {
            Preference::LeastFailing => {
                first_best(windows, |window| -rows.failed(&stencils[window], action, coordinates, window))
            }
            Preference::Worth(values) => first_best(windows, |window| {
                let stencil = &stencils[window];
                let special = rows.special(stencil, action, coordinates, window);
                let row = stencil.row(action.ground, coordinates, special, entries);
                expectation.of(row, values)
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
        stencils[chosen.stencil as usize].row(action.ground, coordinates, chosen.special, entries)
    }
}

/// The first of those for which the worth is greatest.
fn first_best(candidates: std::ops::Range<usize>, mut worth: impl FnMut(usize) -> f64) -> usize {
    let mut best = (candidates.start, f64::NEG_INFINITY);
    for candidate in candidates {
        let own = worth(candidate);
        if own > best.1 {
            best = (candidate, own);
        }
    }
    best.0
}
