//! Which states there are and what they mean.

use crate::partition::{CellId, CellKind, CellLabels, Grid};
use imdp::model::{Labels, StateId, StateSet, StateVariables, VariableValues};

/// The states of a compiled model: a few special ones, then cells in row-major order.
#[derive(Clone, Debug)]
pub(super) struct StateSpace {
    /// The number of special states, numbered first.
    heads: u32,
    /// The state of every cell.
    of_cell: Vec<StateId>,
    /// The cell of every state after the special ones.
    cells: Vec<CellId>,
}

/// In `pac` mode: the state for everything that may have gone wrong.
pub(super) const FAILED: StateId = StateId(0);
/// In `pac` mode: the state for all goal cells.
pub(super) const REACHED: StateId = StateId(1);

impl StateSpace {
    /// `pac`: state 0 is `failed`, 1 is `reached` if there is a goal, then the ordinary cells.
    pub(super) fn merged(labels: &CellLabels) -> Self {
        let heads: u32 = if labels.count(CellKind::Goal) > 0 { 2 } else { 1 };
        let mut cells = Vec::with_capacity(labels.count(CellKind::Ordinary));
        let of_cell = labels
            .iter()
            .map(|(cell, kind)| match kind {
                CellKind::Unsafe => FAILED,
                CellKind::Goal => REACHED,
                CellKind::Ordinary => {
                    cells.push(cell);
                    StateId::from_index(heads as usize - 1 + cells.len())
                }
            })
            .collect();
        Self { heads, of_cell, cells }
    }

    /// `reference`: state 0 is outside, 1 and 2 are unused, then all cells.
    pub(super) fn complete(grid: &Grid) -> Self {
        let cells: Vec<_> = (0..grid.num_cells()).map(CellId).collect();
        Self { heads: 3, of_cell: cells.iter().map(|cell| StateId(3 + cell.0)).collect(), cells }
    }

    pub(super) fn len(&self) -> usize {
        self.heads as usize + self.cells.len()
    }

    pub(super) fn heads(&self) -> u32 {
        self.heads
    }

    pub(super) fn of_cell(&self, cell: CellId) -> StateId {
        self.of_cell[cell.index()]
    }

    /// The cell of a state, or `None` for a special one.
    pub(super) fn cell(&self, state: StateId) -> Option<CellId> {
        (state.0.checked_sub(self.heads)).map(|i| self.cells[i as usize])
    }

    /// The states that are cells, with their cells, ascending.
    pub(super) fn cells(&self) -> impl Iterator<Item = (StateId, CellId)> + '_ {
        (self.heads..).map(StateId).zip(self.cells.iter().copied())
    }

    /// The states that this function accepts.
    pub(super) fn select(&self, accepts: impl Fn(StateId) -> bool) -> StateSet {
        let mut set = StateSet::with_capacity(self.len());
        set.extend((0..self.len()).filter(|&state| accepts(StateId::from_index(state))));
        set
    }

    /// One variable per dimension, `x1`, `x2`, …: the cell's index; special states get −1, −2, ….
    pub(super) fn variables(&self, grid: &Grid) -> StateVariables {
        let mut variables = StateVariables::default();
        for j in 0..grid.dimension() {
            let special = (1..=self.heads).map(|i| -(i as i32));
            let cells = self.cells.iter().map(|&cell| grid.coordinate(cell, j) as i32);
            variables.push(format!("x{}", j + 1), VariableValues::Int(special.chain(cells).collect()));
        }
        variables
    }

    /// The initial states: the given cell's, or those of all ordinary cells.
    pub(super) fn initial(&self, given: Option<CellId>, labels: &CellLabels) -> StateSet {
        let mut initial = StateSet::with_capacity(self.len());
        match given {
            Some(cell) => initial.insert(self.of_cell(cell).index()),
            None => {
                let ordinary = self.cells().filter(|&(_, cell)| labels.kind(cell) == CellKind::Ordinary);
                initial.extend(ordinary.map(|(state, _)| state.index()));
            }
        }
        if initial.is_clear() {
            // Every cell is goal or unsafe: the task is over before it starts.
            initial.extend(self.of_cell.iter().map(|&state| state.index()));
        }
        initial
    }
}

/// The labels of a compiled model.
pub(super) fn labels(deadlock: StateSet, reached: StateSet, failed: StateSet) -> Labels {
    let mut labels = Labels::default();
    labels.insert("deadlock", deadlock);
    labels.insert("reached", reached);
    labels.insert("failed", failed);
    labels
}
