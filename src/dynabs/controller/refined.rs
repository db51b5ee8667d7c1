//! The controller `c(x, k)`.

use super::law::{CenteredLaw, Law, SteeringLaw};
use super::memory::MemoryUpdate;
use super::periods::Periods;
use super::schedule::{Entry, Schedule};
use super::{Decision, RunMemory};
use crate::abstraction::inputs::InputAbstraction;
use crate::abstraction::{Abstraction, Targets};
use crate::guarantee::{Bound, Event, Guarantee};
use crate::landing::LandingSolution;
use crate::partition::{CellId, CellKind, CellLookup};
use crate::problem::{InputProblem, Problem};
use crate::task::{CellTask, Memory, Standing};
use imdp::model::StateId;
use imdp::numeric::to_f64;
use imdp::solver::Answer;

/// A policy of the interval MDP refined to the system: piecewise affine feedback `c(x, k)`.
///
/// The cell of `x`, what the run has done for its task so far, and the number `k` of (grouped) steps elapsed decide on an
/// action; the action and `x` give the inputs of the next steps by the law that the enabling of actions was tested with, so
/// that `u ∈ U` wherever it is defined:
///
/// - a target `d`: `u = B†(d − A x − q)`, or `−K(x − x̄) + B†(d − A_cl x − q_cl)` for two layers, on the grouped system;
/// - an input `ū`: `u = ū − K (x − c)`, `c` being the center of the cell.
#[derive(Clone, Debug, PartialEq)]
pub struct Controller {
    pub(super) lookup: CellLookup,
    pub(super) periods: Periods,
    pub(super) memory: MemoryUpdate,
    pub(super) horizon: Option<u64>,
    pub(super) group_steps: usize,
    pub(super) law: Law,
    /// By `memory · cells + cell`.
    pub(super) schedule: Schedule,
    /// The guaranteed probability of success from every cell at the start.
    bounds: Vec<f64>,
    guarantee: Guarantee,
    promised: Bound,
}

/// Why a policy cannot be refined.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ControllerError {
    /// The answer was computed without one.
    #[error("found a solution without a policy; expected one\n  Ask the solver for it.")]
    NoPolicy,
}

impl Controller {
    /// Refines the policy of `answer` to a problem whose actions are targets, and its abstraction.
    ///
    /// # Errors
    /// [`ControllerError::NoPolicy`] if the solver was not asked for a policy.
    pub fn new(
        problem: &Problem,
        abstraction: &Abstraction,
        answer: &Answer,
    ) -> Result<Self, ControllerError> {
        let policy = answer.solution.policy.as_ref().ok_or(ControllerError::NoPolicy)?;
        let bound = |state: &StateId| answer.values.lower[state.index()];
        let bounds: Vec<f64> = abstraction.state_of_cell.iter().map(bound).collect();
        let is_open = |cell: CellId| abstraction.pair(abstraction.state_of_cell[cell.index()]).is_some();
        let ordinary = problem.labels().iter().filter(|(_, kind)| *kind == CellKind::Ordinary);
        let bound = match problem.initial_cell() {
            Some(cell) => bounds[cell.index()],
            None => {
                let starts = ordinary.map(|(cell, _)| cell).filter(|&cell| is_open(cell));
                starts.map(|cell| bounds[cell.index()]).fold(1.0, f64::min)
            }
        };
        let grid = problem.grid();
        Ok(Self {
            lookup: CellLookup::new(grid),
            periods: Periods::new(grid, &vec![false; grid.dimension()]),
            memory: MemoryUpdate::new(problem.cell_task(), problem.objective()),
            horizon: problem.horizon(),
            group_steps: problem.group_steps(),
            law: Law::Steering(SteeringLaw::new(&abstraction.law, points(&abstraction.targets))),
            schedule: Schedule::new(problem, abstraction, policy),
            bounds,
            guarantee: abstraction.guarantee.clone(),
            promised: Bound { initial_state: problem.initial_state().map(<[f64]>::to_vec), bound },
        })
    }

    /// Refines the policy of `solution` to a problem whose actions are inputs.
    pub fn of_inputs(
        problem: &InputProblem,
        abstraction: &InputAbstraction,
        solution: &LandingSolution,
    ) -> Self {
        let (grid, task) = (problem.grid(), problem.cell_task());
        let cells = grid.num_cells();
        // Where the task is taken for lost nothing is decided.
        let changes = |pair: u32| match task.kind(CellId(pair % cells)) {
            CellKind::Unsafe => &[],
            CellKind::Ordinary | CellKind::Goal => solution.policy.changes(StateId(pair)),
        };
        let nominal = problem.inputs().iter().flatten().map(to_f64).collect();
        let lower = &solution.values.lower;
        let initial = abstraction.initial(problem.initial_cell());
        let bound = initial.iter().map(|&cell| lower[cell as usize]).fold(1.0, f64::min);
        Self {
            lookup: CellLookup::new(grid),
            periods: Periods::new(grid, problem.periodic()),
            memory: MemoryUpdate::new(task, problem.objective()),
            horizon: problem.horizon(),
            group_steps: 1,
            law: Law::Centered(CenteredLaw::new(nominal, problem.mode(), problem.feedback().clone(), grid)),
            schedule: Schedule::of_pairs((0..task.memories() * cells).map(changes)),
            bounds: lower.clone(),
            guarantee: Guarantee { event: Event::of_inputs(problem), evidence: abstraction.evidence.clone() },
            promised: Bound { initial_state: problem.initial_state().map(<[f64]>::to_vec), bound },
        }
    }

    /// The dimension `n` of the state.
    pub fn state_dimension(&self) -> usize {
        self.lookup.faces().len()
    }

    /// The number of inputs of one step, `p`.
    pub fn step_inputs(&self) -> usize {
        self.inputs() / self.group_steps
    }

    /// The number of steps, `d`, between two looks at the state.
    pub fn group_steps(&self) -> usize {
        self.group_steps
    }

    /// The number of inputs decided at once: `d p`, the inputs of the first step first.
    pub fn inputs(&self) -> usize {
        self.law.inputs()
    }

    /// The number of grouped steps, or `None` for a stationary controller of an unbounded task.
    pub fn horizon(&self) -> Option<u64> {
        self.horizon
    }

    /// The number of cells.
    pub fn num_cells(&self) -> u32 {
        self.task().num_cells() as u32
    }

    /// What the task makes of the cells.
    pub fn task(&self) -> &CellTask {
        self.memory.task()
    }

    /// The cell of a state; `None` outside the partition.
    pub fn cell(&self, x: &[f64]) -> Option<CellId> {
        self.lookup.locate(&self.periods.wrapped(&self.lookup, x))
    }

    /// Moves periodic coordinates into the partition: `x − period · ⌊(x − lower) / period⌋`.
    pub fn wrap(&self, x: &mut [f64]) {
        self.periods.wrap(&self.lookup, x);
    }

    /// What a cell means to the task.
    pub fn kind(&self, cell: CellId) -> CellKind {
        self.task().kind(cell)
    }

    /// The point that a target is, `n` numbers; or the nominal input, `p` numbers, where actions are inputs.
    pub fn action(&self, action: u32) -> &[f64] {
        self.law.action(action, self.state_dimension())
    }

    /// The actions of a cell with a memory by the number of steps left, ascending.
    pub fn entries(&self, memory: Memory, cell: CellId) -> &[Entry] {
        self.schedule.of(self.pair(memory, cell))
    }

    fn pair(&self, memory: Memory, cell: CellId) -> usize {
        memory as usize * self.task().num_cells() + cell.index()
    }

    /// The guaranteed probability of success from a cell, at the start.
    pub fn bound(&self, cell: CellId) -> f64 {
        self.bounds[cell.index()]
    }

    /// The guaranteed probability of success from a state, at the start: 0 outside the partition.
    pub fn bound_at(&self, x: &[f64]) -> f64 {
        self.cell(x).map_or(0.0, |cell| self.bound(cell))
    }

    /// What holds for this controller, and what that rests on.
    pub fn guarantee(&self) -> &Guarantee {
        &self.guarantee
    }

    /// The bound on the probability of success that is promised.
    pub fn promised(&self) -> &Bound {
        &self.promised
    }

    /// What is promised, as sentences of plain ASCII.
    pub fn promise(&self) -> Vec<String> {
        self.guarantee.sentences(&self.promised)
    }

    /// What to do in a cell after `elapsed` (grouped) steps, where a run stands there with its task.
    pub fn decide(&self, standing: Standing, cell: CellId, elapsed: u64) -> Decision {
        let memory = match standing {
            Standing::Reached => return Decision::Reached,
            Standing::Failed => return Decision::Unsafe,
            Standing::Open(memory) => memory,
        };
        let left = self.horizon.map_or(1, |horizon| horizon.saturating_sub(elapsed));
        if left == 0 {
            return Decision::Over;
        }
        let action = self.schedule.action(self.pair(memory, cell), left);
        action.map_or(Decision::NoAction, |action| Decision::Act { action })
    }

    /// What to do in a cell after `elapsed` (grouped) steps if the task has no memory but that.
    pub fn decide_in(&self, cell: CellId, elapsed: u64) -> Decision {
        let standing = match self.kind(cell) {
            CellKind::Ordinary => Standing::Open(0),
            CellKind::Goal => Standing::Reached,
            CellKind::Unsafe => Standing::Failed,
        };
        self.decide(standing, cell, elapsed)
    }

    /// `c(x, k)`: looks at the state, remembers what it means to the task, decides and, if that is to go on, writes the
    /// inputs of the next `d` steps into `u`.
    ///
    /// A run begins with [`RunMemory::default`]; every state of it at which the controller is asked is looked at, in order.
    pub fn control(&self, x: &[f64], elapsed: u64, memory: &mut RunMemory, u: &mut [f64]) -> Decision {
        let x = self.periods.wrapped(&self.lookup, x);
        let Some(cell) = self.lookup.locate(&x) else {
            memory.fail();
            return Decision::Outside;
        };
        let decision = self.decide(self.memory.look(memory, cell, &x), cell, elapsed);
        if let Decision::Act { action } = decision {
            self.law.evaluate(action, (cell, &self.lookup), &x, u);
        }
        decision
    }
}

fn points(targets: &Targets) -> Vec<f64> {
    let n = targets.dimension();
    let mut points = vec![0.0; targets.len() * n];
    points.chunks_exact_mut(n).zip(targets.ids()).for_each(|(point, target)| targets.point(target, point));
    points
}
