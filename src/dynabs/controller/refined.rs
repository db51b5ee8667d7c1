//! The controller `c(x, k)`.

use super::law::InputLaw;
use super::schedule::{Entry, Schedule};
use crate::abstraction::{Abstraction, Targets};
use crate::guarantee::{Bound, Guarantee};
use crate::partition::{CellId, CellKind, CellLookup};
use crate::problem::Problem;
use imdp::model::StateId;
use imdp::solver::Answer;

/// A policy of the interval MDP refined to the system: piecewise affine feedback `c(x, k)`.
///
/// The cell of `x` decides on a target `d`, which may depend on the number `k` of grouped steps elapsed, and
/// the inputs of the next `d` steps follow from the law that the enabling of actions was tested with:
/// `u = B†(d − A x − q)`, or `−K(x − x̄) + B†(d − A_cl x − q_cl)` for two layers, on the grouped system.
/// Hence `u ∈ Uᵈ` wherever it is defined.
#[derive(Clone, Debug, PartialEq)]
pub struct Controller {
    pub(super) lookup: CellLookup,
    pub(super) kinds: Vec<CellKind>,
    pub(super) horizon: Option<u64>,
    pub(super) group_steps: usize,
    /// The number of inputs of one step, `p`.
    pub(super) step_inputs: usize,
    pub(super) law: InputLaw,
    /// The points steered to, target after target.
    points: Vec<f64>,
    pub(super) schedule: Schedule,
    /// The guaranteed probability of success from every cell at the start.
    bounds: Vec<f64>,
    guarantee: Guarantee,
    promised: Bound,
}

/// What the controller does in a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Decision {
    /// It steers to a target.
    Steer {
        /// The target.
        target: u32,
    },
    /// It applies an input, with feedback about the center of the cell.
    Apply {
        /// The input.
        input: u32,
    },
    /// The goal is reached: the task is done.
    Reached,
    /// The cell meets the unsafe region: the task has failed.
    Unsafe,
    /// The state is outside the partition: the task has failed.
    Outside,
    /// No action is enabled in this cell.
    NoAction,
    /// The horizon has passed.
    Over,
}

/// Why a policy cannot be refined.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ControllerError {
    /// The answer was computed without one.
    #[error("the solution has no policy; ask the solver for one")]
    NoPolicy,
}

impl Controller {
    /// Refines the policy of `answer` to a problem and its abstraction.
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
        let ordinary = problem.labels().iter().filter(|(_, kind)| *kind == CellKind::Ordinary);
        let promised = Bound {
            initial_state: problem.initial_state().map(<[f64]>::to_vec),
            bound: match problem.initial_cell() {
                Some(cell) => bounds[cell.index()],
                None => ordinary.map(|(cell, _)| bounds[cell.index()]).fold(1.0, f64::min),
            },
        };
        Ok(Self {
            lookup: CellLookup::new(problem.grid()),
            kinds: problem.labels().iter().map(|(_, kind)| kind).collect(),
            horizon: problem.horizon(),
            group_steps: problem.group_steps(),
            step_inputs: problem.step_system().input_dimension(),
            law: InputLaw::new(&abstraction.law),
            points: points(&abstraction.targets),
            schedule: Schedule::new(abstraction, policy),
            bounds,
            guarantee: abstraction.guarantee.clone(),
            promised,
        })
    }

    /// The dimension `n` of the state.
    pub fn state_dimension(&self) -> usize {
        self.lookup.faces().len()
    }

    /// The number of inputs of one step, `p`.
    pub fn step_inputs(&self) -> usize {
        self.step_inputs
    }

    /// The number of steps, `d`, between two looks at the state.
    pub fn group_steps(&self) -> usize {
        self.group_steps
    }

    /// The number of inputs decided at once: `d p`, the inputs of the first step first.
    pub fn inputs(&self) -> usize {
        self.law.constant.len()
    }

    /// The number of grouped steps, or `None` for a stationary controller of an unbounded task.
    pub fn horizon(&self) -> Option<u64> {
        self.horizon
    }

    /// The number of cells.
    pub fn num_cells(&self) -> u32 {
        self.kinds.len() as u32
    }

    /// The cell of a state; `None` outside the partition.
    pub fn cell(&self, x: &[f64]) -> Option<CellId> {
        self.lookup.locate(x)
    }

    /// What a cell means to the task.
    pub fn kind(&self, cell: CellId) -> CellKind {
        self.kinds[cell.index()]
    }

    /// The point that a target is.
    pub fn target_point(&self, target: u32) -> &[f64] {
        let n = self.state_dimension();
        &self.points[target as usize * n..(target as usize + 1) * n]
    }

    /// The targets of a cell by the number of steps left, ascending.
    pub fn entries(&self, cell: CellId) -> &[Entry] {
        self.schedule.of(cell.index())
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

    /// What to do in state `x` after `elapsed` grouped steps.
    pub fn decide(&self, x: &[f64], elapsed: u64) -> Decision {
        self.cell(x).map_or(Decision::Outside, |cell| self.decide_in(cell, elapsed))
    }

    /// What to do in a cell after `elapsed` grouped steps.
    pub fn decide_in(&self, cell: CellId, elapsed: u64) -> Decision {
        match self.kind(cell) {
            CellKind::Goal => return Decision::Reached,
            CellKind::Unsafe => return Decision::Unsafe,
            CellKind::Ordinary => {}
        }
        let left = self.horizon.map_or(1, |horizon| horizon.saturating_sub(elapsed));
        if left == 0 {
            return Decision::Over;
        }
        self.schedule
            .target(cell.index(), left)
            .map_or(Decision::NoAction, |target| Decision::Steer { target })
    }

    /// Writes the inputs that steer from `x` to `target`, those of the first step first, into `u`.
    ///
    /// They are in `U` only where [`decide`](Self::decide) chose the target (or it is enabled otherwise).
    pub fn steer(&self, x: &[f64], target: u32, u: &mut [f64]) {
        self.law.evaluate(self.target_point(target), x, u);
    }

    /// `c(x, k)`: decides and, if that is to steer, writes the inputs of the next `d` steps into `u`.
    pub fn control(&self, x: &[f64], elapsed: u64, u: &mut [f64]) -> Decision {
        let decision = self.decide(x, elapsed);
        if let Decision::Steer { target } = decision {
            self.steer(x, target, u);
        }
        decision
    }
}

fn points(targets: &Targets) -> Vec<f64> {
    let n = targets.dimension();
    let mut points = vec![0.0; targets.len() * n];
    points.chunks_exact_mut(n).enumerate().for_each(|(target, point)| targets.point(target, point));
    points
}
