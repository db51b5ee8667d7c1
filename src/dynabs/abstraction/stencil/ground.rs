//! The cells that rows lie on, and what they are to them.

use super::super::cell_box::CellBox;
use super::super::targets::Targets;
use crate::partition::{CellId, Grid};
use crate::problem::TargetId;
use imdp::model::StateId;

/// The grid, and the state of every cell.
#[derive(Clone, Debug)]
pub(in super::super) struct Ground {
    /// Per dimension, the number of cells.
    pub(in super::super) cells: Vec<i32>,
    strides: Vec<i64>,
    /// The state that landing in a cell leads to.
    pub(in super::super) states: Vec<StateId>,
    heads: StateId,
    /// Per dimension, the cell of each coordinate of the targets; nothing where origins are those of the grid.
    pub(super) targets: Vec<Vec<i32>>,
    /// Where targets that stand there again stand, after all others.
    pub(super) again: Vec<TargetId>,
}

impl Ground {
    /// The cells of a grid, with targets that coordinates count from if all sit alike in theirs; the first `heads` states
    /// stand for several cells, or for what is not listed at all.
    pub(in super::super) fn new(
        grid: &Grid,
        shared: Option<&Targets>,
        heads: u32,
        state: impl Fn(CellId) -> StateId,
    ) -> Self {
        Self {
            heads: StateId(heads),
            cells: grid.axes().iter().map(|axis| axis.cells() as i32).collect(),
            strides: grid.strides().iter().map(|&stride| stride.into()).collect(),
            states: (0..grid.num_cells()).map(|cell| state(CellId(cell))).collect(),
            targets: shared.and_then(Targets::cells_along_axes).map_or(vec![], <[_]>::to_vec),
            again: shared.map_or(vec![], |targets| {
                targets.ids().skip(targets.num_originals()).map(|copy| targets.original(copy)).collect()
            }),
        }
    }

    /// Whether rows list a state cell by cell.
    pub(in super::super) fn lists(&self, state: StateId) -> bool {
        state >= self.heads
    }

    /// Whether rows list all of these states one by one.
    pub(super) fn lists_all(&self, states: &[StateId]) -> bool {
        // Without a way out in the middle, so that it is done many at a time.
        states.iter().fold(true, |all, &state| all & self.lists(state))
    }

    /// Writes where the coordinates of an action's row count from into `origin`.
    pub(in super::super) fn origin(&self, target: TargetId, origin: &mut Vec<i32>) {
        let originals: usize = self.targets.iter().map(Vec::len).product();
        let copy = target.index().checked_sub(originals).and_then(|copy| self.again.get(copy));
        let mut target = copy.copied().unwrap_or(target).index();
        origin.clear();
        origin.resize(self.cells.len(), 0);
        for (own, axis) in origin.iter_mut().zip(&self.targets).rev() {
            *own = axis[target % axis.len()];
            target /= axis.len();
        }
    }

    /// How many cell numbers lie between the first cell and the one at some coordinates.
    pub(super) fn number(&self, coordinates: &[i32]) -> i64 {
        coordinates.iter().zip(&self.strides).map(|(&i, stride)| i64::from(i) * stride).sum()
    }

    /// Whether a box at `origin` lies in the grid altogether.
    pub(in super::super) fn contains(&self, hull: &CellBox, origin: &[i32]) -> bool {
        (self.cells.iter().enumerate())
            .all(|(j, &cells)| hull.lower[j] + origin[j] >= 0 && hull.upper[j] + origin[j] < cells)
    }

    /// The state of the cell at `coordinates` from `origin`, if it is in the grid.
    pub(super) fn state(&self, coordinates: &[i32], origin: &[i32]) -> Option<StateId> {
        let mut number = 0;
        for (j, &cells) in self.cells.iter().enumerate() {
            let index = Some(coordinates[j] + origin[j]).filter(|index| (0..cells).contains(index))?;
            number += i64::from(index) * self.strides[j];
        }
        Some(self.states[number as usize])
    }

    /// How many cells of a box at `origin` lie in the grid.
    pub(in super::super) fn volume(&self, hull: &CellBox, origin: &[i32]) -> u32 {
        let along = |(j, &cells): (usize, &i32)| {
            let lower = (hull.lower[j] + origin[j]).max(0);
            ((hull.upper[j] + origin[j]).min(cells - 1) - lower + 1).max(0) as u32
        };
        self.cells.iter().enumerate().map(along).product()
    }
}
