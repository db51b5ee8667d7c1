//! Which states there are and what they mean.

use crate::partition::{CellId, CellKind, CellLabels, Grid};
use crate::task::{CellTask, Memory, Standing};
use imdp::model::{Labels, StateId, StateSet, StateVariables, VariableValues};

/// The states of a compiled model: a few special ones, then cells in row-major order, with the memories that the task may have
/// there.
///
/// Cells come first, so that the successors of a row are ascending whatever the memory before is.
#[derive(Clone, Debug)]
pub(super) struct StateSpace {
    /// The number of special states, numbered first.
    heads: u32,
    /// Per cell, how many states come before its own; one more entry than cells.
    starts: Vec<u32>,
    /// The memory and the cell of every state after the special ones.
    pairs: Vec<(Memory, CellId)>,
    /// The memories that some state has, ascending.
    memories: Vec<Memory>,
    /// Whether cells in which the task ends share a state.
    is_merged: bool,
    /// The state that each cell is at the start.
    at_start: Vec<StateId>,
}

/// In `pac` mode: the state for everything that may have gone wrong.
pub(super) const FAILED: StateId = StateId(0);
/// In `pac` mode: the state for everything that is done.
pub(super) const REACHED: StateId = StateId(1);

impl StateSpace {
    /// `pac`: state 0 is `failed`, 1 is `reached` if the task can be done, then the memories that are open in cells.
    pub(super) fn of_task(task: &CellTask) -> Self {
        let heads = if task.is_done_somewhere() { 2 } else { 1 };
        let cells = 0..task.num_cells() as u32;
        let pairs = |cell: u32| task.open(cell as usize).iter().map(move |&memory| (memory, CellId(cell)));
        let mut states = Self::new((heads, true), task.num_cells(), cells.clone().flat_map(pairs).collect());
        states.at_start = cells.map(|cell| states.arrival(task, None, CellId(cell))).collect();
        states
    }

    /// `reference`: state 0 is outside, 1 and 2 are unused, then all cells.
    pub(super) fn complete(grid: &Grid) -> Self {
        let cells = (0..grid.num_cells()).map(|cell| (0, CellId(cell)));
        let mut states = Self::new((3, false), grid.num_cells() as usize, cells.collect());
        states.at_start = (3..3 + grid.num_cells()).map(StateId).collect();
        states
    }

    fn new((heads, is_merged): (u32, bool), cells: usize, pairs: Vec<(Memory, CellId)>) -> Self {
        let mut starts = vec![0; cells + 1];
        pairs.iter().for_each(|(_, cell)| starts[cell.index() + 1] += 1);
        (0..cells).for_each(|cell| starts[cell + 1] += starts[cell]);
        let mut memories: Vec<Memory> = pairs.iter().map(|(memory, _)| *memory).collect();
        memories.sort_unstable();
        memories.dedup();
        if memories.is_empty() {
            // There is a row for every action even if nothing is open anywhere.
            memories.push(0);
        }
        Self { heads, starts, pairs, memories, is_merged, at_start: vec![] }
    }

    pub(super) fn len(&self) -> usize {
        self.heads as usize + self.pairs.len()
    }

    pub(super) fn heads(&self) -> u32 {
        self.heads
    }

    /// The memories that some state has, ascending.
    pub(super) fn memories(&self) -> &[Memory] {
        &self.memories
    }

    /// The state of a cell at the start.
    pub(super) fn at_start(&self, cell: CellId) -> StateId {
        self.at_start[cell.index()]
    }

    /// The state with a memory in a cell, if there is one.
    pub(super) fn state(&self, memory: Memory, cell: CellId) -> Option<StateId> {
        let (from, to) = (self.starts[cell.index()] as usize, self.starts[cell.index() + 1] as usize);
        let own = self.pairs[from..to].binary_search_by_key(&memory, |(memory, _)| *memory).ok()?;
        Some(StateId::from_index(self.heads as usize + from + own))
    }

    /// The state of a cell with the first of its memories, if it has any.
    pub(super) fn first(&self, cell: CellId) -> Option<StateId> {
        let (from, to) = (self.starts[cell.index()], self.starts[cell.index() + 1]);
        (from < to).then(|| StateId(self.heads + from))
    }

    /// The state on arrival in a cell, with a memory before or at the start.
    pub(super) fn arrival(&self, task: &CellTask, before: Option<Memory>, cell: CellId) -> StateId {
        match task.standings(before, cell.index()) {
            _ if !self.is_merged => self.at_start(cell),
            [Standing::Open(memory)] => self.state(*memory, cell).unwrap_or(FAILED),
            [Standing::Reached] => REACHED,
            _ => FAILED,
        }
    }

    /// The memory and the cell of a state, or `None` for a special one.
    pub(super) fn pair(&self, state: StateId) -> Option<(Memory, CellId)> {
        (state.0.checked_sub(self.heads)).map(|i| self.pairs[i as usize])
    }

    /// The cell of a state, or `None` for a special one.
    pub(super) fn cell(&self, state: StateId) -> Option<CellId> {
        self.pair(state).map(|(_, cell)| cell)
    }

    /// The states that are cells, with their memories and cells, ascending.
    pub(super) fn pairs(&self) -> impl Iterator<Item = (StateId, (Memory, CellId))> + '_ {
        (self.heads..).map(StateId).zip(self.pairs.iter().copied())
    }

    /// The number of a memory among those that some state has.
    pub(super) fn layer(&self, memory: Memory) -> usize {
        self.memories.partition_point(|&other| other < memory)
    }

    /// The states that this function accepts.
    pub(super) fn select(&self, accepts: impl Fn(StateId) -> bool) -> StateSet {
        let mut set = StateSet::with_capacity(self.len());
        set.extend((0..self.len()).filter(|&state| accepts(StateId::from_index(state))));
        set
    }

    /// One variable per dimension, `x1`, `x2`, …: the cell's index; special states get −1, −2, …. If there are several
    /// memories, another one for them.
    pub(super) fn variables(&self, grid: &Grid) -> StateVariables {
        let mut variables = StateVariables::default();
        let mut push = |name: String, of_pair: &dyn Fn(&(Memory, CellId)) -> i32| {
            let special = (1..=self.heads).map(|i| -(i as i32));
            let values = special.chain(self.pairs.iter().map(of_pair));
            variables.push(name, VariableValues::Int(values.collect()));
        };
        for j in 0..grid.dimension() {
            push(format!("x{}", j + 1), &|(_, cell)| grid.coordinate(*cell, j) as i32);
        }
        if self.memories.len() > 1 {
            push("memory".to_owned(), &|(memory, _)| *memory as i32);
        }
        variables
    }

    /// The initial states: the given cell's, or those of all ordinary cells in which the task is open.
    pub(super) fn initial(&self, given: Option<CellId>, labels: &CellLabels) -> StateSet {
        let mut initial = StateSet::with_capacity(self.len());
        match given {
            Some(cell) => initial.insert(self.at_start(cell).index()),
            None => {
                let ordinary = labels.iter().filter(|(_, kind)| *kind == CellKind::Ordinary);
                let starts = ordinary.map(|(cell, _)| self.at_start(cell));
                initial.extend(starts.filter(|state| state.0 >= self.heads).map(StateId::index));
            }
        }
        if initial.is_clear() {
            // Every cell is goal or unsafe: the task is over before it starts.
            initial.extend(self.at_start.iter().map(|&state| state.index()));
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
