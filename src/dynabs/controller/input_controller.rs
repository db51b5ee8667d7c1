//! The controller of a problem whose actions are inputs.

use super::memory::MemoryUpdate;
use super::schedule::{Entry, Schedule};
use super::{Decision, RunMemory};
use crate::abstraction::inputs::InputAbstraction;
use crate::guarantee::{Bound, Event, Guarantee};
use crate::landing::LandingSolution;
use crate::partition::{CellId, CellKind, CellLookup};
use crate::problem::InputProblem;
use crate::system::Feedback;
use crate::task::{CellTask, Memory, Standing};
use imdp::model::StateId;
use imdp::numeric::to_f64;

/// The feedback law `u = ū − K (x − c)`: the cell of `x`, with center `c`, and the number `k` of steps elapsed decide on `ū`.
///
/// `u ∈ U` wherever it is defined, up to the rounding of doubles.
#[derive(Clone, Debug, PartialEq)]
pub struct InputController {
    pub(super) lookup: CellLookup,
    /// Per coordinate the period, 0 where it is not periodic.
    pub(super) periods: Vec<f64>,
    pub(super) memory: MemoryUpdate,
    pub(super) horizon: Option<u64>,
    /// The nominal inputs one after the other, `p` numbers each.
    pub(super) inputs: Vec<f64>,
    pub(super) num_inputs: usize,
    pub(super) feedback: Feedback,
    /// Per coordinate, the centers of the cells.
    pub(super) centers: Vec<Vec<f64>>,
    pub(super) schedule: Schedule,
    bounds: Vec<f64>,
    guarantee: Guarantee,
    initial: Bound,
}

impl InputController {
    /// Refines the policy of `solution` to a problem.
    pub fn new(problem: &InputProblem, abstraction: &InputAbstraction, solution: &LandingSolution) -> Self {
        let grid = problem.grid();
        let cells = grid.num_cells();
        let pairs = problem.cell_task().memories() * cells;
        // Where the task is taken for lost nothing is decided.
        let changes = |pair: u32| match problem.cell_task().kind(CellId(pair % cells)) {
            CellKind::Unsafe => &[],
            CellKind::Ordinary | CellKind::Goal => solution.policy.changes(StateId(pair)),
        };
        let period = |(axis, &periodic): (&crate::partition::GridAxis, &bool)| {
            if periodic { to_f64(&(axis.upper() - axis.lower())) } else { 0.0 }
        };
        let lower = &solution.values.lower;
        let initial = abstraction.initial(problem.initial_cell());
        let guarantee =
            Guarantee { event: Event::of_inputs(problem), evidence: abstraction.evidence.clone() };
        Self {
            lookup: CellLookup::new(grid),
            periods: grid.axes().iter().zip(problem.periodic()).map(period).collect(),
            memory: MemoryUpdate::of_inputs(problem),
            horizon: problem.horizon(),
            inputs: problem.inputs().iter().flatten().map(to_f64).collect(),
            num_inputs: problem.mode().num_inputs(),
            feedback: problem.feedback().clone(),
            centers: grid.axes().iter().map(|axis| axis.centers()).collect(),
            schedule: Schedule::of_cells((0..pairs).map(changes)),
            initial: Bound {
                initial_state: problem.initial_state().map(<[f64]>::to_vec),
                bound: initial.iter().map(|&cell| lower[cell as usize]).fold(1.0, f64::min),
            },
            guarantee,
            bounds: lower.clone(),
        }
    }

    /// The dimension `n` of the state.
    pub fn state_dimension(&self) -> usize {
        self.centers.len()
    }

    /// The number of inputs, `p`.
    pub fn num_inputs(&self) -> usize {
        self.num_inputs
    }

    /// The number of steps, or `None` for a stationary controller of an unbounded task.
    pub fn horizon(&self) -> Option<u64> {
        self.horizon
    }

    /// The number of cells.
    pub fn num_cells(&self) -> u32 {
        self.memory.task().num_cells() as u32
    }

    /// What a cell means to the task.
    pub fn kind(&self, cell: CellId) -> CellKind {
        self.memory.task().kind(cell)
    }

    /// What the task makes of the cells.
    pub fn task(&self) -> &CellTask {
        self.memory.task()
    }

    /// The actions of a cell with a memory by the number of steps left, ascending.
    pub fn entries(&self, memory: Memory, cell: CellId) -> &[Entry] {
        self.schedule.of(self.pair(memory, cell))
    }

    fn pair(&self, memory: Memory, cell: CellId) -> usize {
        memory as usize * self.memory.task().num_cells() + cell.index()
    }

    /// The guaranteed probability of success from a cell, at the start.
    pub fn bound(&self, cell: CellId) -> f64 {
        self.bounds[cell.index()]
    }

    /// The guaranteed probability of success from a state, at the start: 0 outside the partition.
    pub fn bound_at(&self, x: &[f64]) -> f64 {
        let mut wrapped = x.to_vec();
        self.wrap(&mut wrapped);
        self.lookup.locate(&wrapped).map_or(0.0, |cell| self.bound(cell))
    }

    /// Moves periodic coordinates into the partition: `x − period · ⌊(x − lower) / period⌋`.
    pub fn wrap(&self, x: &mut [f64]) {
        for ((x, &period), faces) in x.iter_mut().zip(&self.periods).zip(self.lookup.faces()) {
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

    /// What is promised about the closed loop, as sentences of plain ASCII.
    pub fn promise(&self) -> Vec<String> {
        self.guarantee.sentences(&self.initial)
    }

    /// The guarantee.
    pub fn guarantee(&self) -> &Guarantee {
        &self.guarantee
    }

    /// The bound that is promised.
    pub fn promised(&self) -> &Bound {
        &self.initial
    }

    /// The nominal input of an action.
    pub fn nominal(&self, action: u32) -> &[f64] {
        &self.inputs[action as usize * self.num_inputs..(action as usize + 1) * self.num_inputs]
    }

    /// What to do in a cell after `elapsed` steps, where a run stands there with its task.
    pub fn decide_in(&self, standing: Standing, cell: CellId, elapsed: u64) -> Decision {
        let memory = match standing {
            Standing::Reached => return Decision::Reached,
            Standing::Failed => return Decision::Unsafe,
            Standing::Open(memory) => memory,
        };
        let left = self.horizon.map_or(1, |horizon| horizon.saturating_sub(elapsed));
        if left == 0 {
            return Decision::Over;
        }
        let input = self.schedule.target(self.pair(memory, cell), left);
        input.map_or(Decision::NoAction, |input| Decision::Apply { input })
    }

    /// `c(x, k)`: looks at the state, remembers what it means to the task, decides and, if that is to go on, writes the
    /// input into `u`.
    ///
    /// A run begins with [`RunMemory::default`]; every state of it is looked at, in order.
    pub fn control(&self, x: &[f64], elapsed: u64, memory: &mut RunMemory, u: &mut [f64]) -> Decision {
        let mut wrapped = x.to_vec();
        self.wrap(&mut wrapped);
        let Some(cell) = self.lookup.locate(&wrapped) else {
            memory.fail();
            return Decision::Outside;
        };
        let decision = self.decide_in(self.memory.look(memory, cell, &wrapped), cell, elapsed);
        if let Decision::Apply { input } = decision {
            self.feedback.input(self.nominal(input), &wrapped, &self.center(cell), u);
        }
        decision
    }

    fn center(&self, cell: CellId) -> Vec<f64> {
        let strides = self.lookup.strides();
        let center =
            |(centers, stride): (&Vec<f64>, &u32)| centers[(cell.0 / stride) as usize % centers.len()];
        self.centers.iter().zip(strides).map(center).collect()
    }
}
