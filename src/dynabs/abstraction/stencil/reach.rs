//! What the successors of rows have at most, without looking at the rows.

use super::{Ground, Stencil};
use crate::landing::{Arrays, Gather, Upper};
use imdp::model::StateId;

/// Boxes around the successors of all rows, dimension after dimension.
#[derive(Debug)]
pub(super) struct Reach {
    along: Vec<Gather>,
    arrays: Arrays,
}

impl Reach {
    /// The boxes of rows with any of these stencils, where coordinates count from the targets of the ground.
    pub(super) fn new(ground: &Ground, stencils: &[Stencil]) -> Self {
        let cells = ground.cells.iter().map(|&cells| cells as usize);
        let mut shape: Vec<usize> = cells.collect();
        let hulls = || stencils.iter().map(|stencil| stencil.runs().hull());
        let along = ground.targets.iter().enumerate().map(|(j, targets)| {
            let below = hulls().map(|hull| hull.lower[j]).min().unwrap_or(0);
            let above = hulls().map(|hull| hull.upper[j]).max().unwrap_or(0);
            let last = ground.cells[j] - 1;
            // A box beyond the grid has no cells there: those at its face do no harm.
            let range = |&target: &i32| {
                let (first, end) = ((target + below).clamp(0, last), (target + above).clamp(0, last));
                (first as u32, (end - first) as u32 + 1)
            };
            let gather = Gather::new(j, &shape, false, targets.iter().map(range).collect());
            shape[j] = targets.len();
            gather
        });
        Self { along: along.collect(), arrays: Arrays::default() }
    }

    /// Per row, at least the largest of these numbers among its successors.
    pub(super) fn most(&self, ground: &Ground, of_states: &[f64]) -> Vec<f64> {
        let of_cells = ground.states.iter().map(|state| of_states[state.index()]).collect();
        let mut most: Vec<f64> = self.along.iter().fold(of_cells, |of_cells: Vec<f64>, along| {
            let next = along.apply::<Upper>(&of_cells, &self.arrays);
            self.arrays.keep(of_cells);
            next
        });
        let again: Vec<f64> = ground.again.iter().map(|&original| most[original.index()]).collect();
        most.extend(again);
        let lost = of_states[StateId(0).index()];
        most.iter_mut().for_each(|most| *most = most.max(lost));
        most
    }
}
