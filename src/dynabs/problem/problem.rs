//! A control problem that is known to make sense.

use super::{Cost, PlantNoise, Probabilities, SampledNoise, Stabilizer};
use crate::Warning;
use crate::geometry::Polytope;
use crate::noise::known::Distribution;
use crate::partition::{CellId, CellLabels, Grid, Region};
use crate::system::{GroupingTrial, LinearSystem};
use crate::task::{Aim, AutomatonTask, CellTask, NamedRegion, Safety};
use imdp::numeric::Rational;
use imdp::property::Probability;

/// A validated control problem: everything that can be said before cells and samples meet.
#[derive(Clone, Debug)]
pub struct Problem {
    pub(super) name: String,
    pub(super) step_system: LinearSystem,
    pub(super) step_input: Polytope,
    pub(super) group_steps: usize,
    pub(super) grouping: Vec<GroupingTrial>,
    pub(super) system: LinearSystem,
    pub(super) input: Polytope,
    pub(super) stabilizer: Option<Stabilizer>,
    pub(super) grid: Grid,
    pub(super) labels: CellLabels,
    pub(super) cell_task: CellTask,
    pub(super) worst_task: CellTask,
    pub(super) objective: Objective,
    pub(super) unsafe_: Vec<Region>,
    pub(super) outside_is_unsafe: bool,
    pub(super) safety: Safety,
    pub(super) actions: Actions,
    pub(super) horizon: Option<u64>,
    pub(super) threshold: Option<Probability>,
    pub(super) initial: Option<InitialState>,
    pub(super) costs: Vec<Cost>,
    pub(super) probabilities: Probabilities,
    pub(super) noise: PlantNoise,
    pub(super) warnings: Vec<Warning>,
}

/// An initial state and its cell.
#[derive(Clone, Debug)]
pub(super) struct InitialState {
    pub(super) state: Vec<f64>,
    pub(super) cell: CellId,
}

/// What is wanted of the closed loop, besides staying out of the unsafe region.
#[derive(Clone, Debug, PartialEq)]
pub enum Objective {
    /// To reach a region.
    Reach {
        /// The goal, a union of boxes.
        goal: Vec<Region>,
    },
    /// To stay in a region.
    Stay {
        /// The region, a union of boxes; empty for the whole partition.
        safe: Vec<Region>,
    },
    /// What an automaton over regions accepts.
    Automaton(Box<AutomatonTask>),
}

impl Objective {
    /// The task in words, if it is more than to reach or to keep something.
    pub fn statement(&self) -> Option<String> {
        match self {
            Self::Reach { .. } | Self::Stay { .. } => None,
            Self::Automaton(task) => Some(task.statement().to_owned()),
        }
    }

    /// The goal, or the region to stay in, which is the whole partition if empty.
    pub fn wanted(&self) -> &[Region] {
        match self {
            Self::Reach { goal: wanted } | Self::Stay { safe: wanted } => wanted,
            Self::Automaton(_) => &[],
        }
    }

    /// The regions that have names.
    pub fn named(&self) -> &[NamedRegion] {
        match self {
            Self::Reach { .. } | Self::Stay { .. } => &[],
            Self::Automaton(task) => task.regions(),
        }
    }

    /// Whether something is to be reached or to be kept.
    pub fn aim(&self) -> Aim {
        match self {
            Self::Reach { .. } => Aim::Reach,
            Self::Stay { .. } => Aim::Stay,
            Self::Automaton(task) => task.aim(),
        }
    }
}

/// What is known of the noise, and how intervals are computed from it.
#[derive(Clone, Copy, Debug)]
pub enum Knowledge<'a> {
    /// Its distribution, by coordinate: intervals enclose its masses.
    Distribution(&'a [Option<Distribution>]),
    /// Samples: intervals hold jointly with probability at least `1 − beta / sweep`.
    Samples {
        /// The samples.
        noise: &'a SampledNoise,
        /// The failure probability of all settings of the sweep together.
        beta: &'a Rational,
        /// How many settings are compiled with these samples.
        sweep: u64,
        /// How many of the farthest samples are left out of the cells that rows list.
        discard: u64,
    },
    /// Samples, and the published tool's intervals.
    Published {
        /// The samples.
        noise: &'a SampledNoise,
        /// The failure probability of one interval.
        beta_per_interval: f64,
    },
}

/// What the controller chooses from in every cell.
#[derive(Clone, Debug)]
pub enum Actions {
    /// Points to steer to.
    Targets(TargetPoints),
}

/// The points that actions steer to.
#[derive(Clone, Debug)]
pub enum TargetPoints {
    /// The centers of all cells.
    Centers,
    /// The centers of the cells of a grid.
    Grid(Grid),
    /// A list of points.
    List(Vec<Vec<Rational>>),
}

impl Problem {
    /// The name of the model.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The system of one step.
    pub fn step_system(&self) -> &LinearSystem {
        &self.step_system
    }

    /// The inputs of one step, `U`.
    pub fn step_input(&self) -> &Polytope {
        &self.step_input
    }

    /// How many steps are grouped, `d`.
    pub fn group_steps(&self) -> usize {
        self.group_steps
    }

    /// What the numbers of steps could do that were thought of, the fewest first.
    pub fn grouping(&self) -> &[GroupingTrial] {
        &self.grouping
    }

    /// The grouped system.
    pub fn system(&self) -> &LinearSystem {
        &self.system
    }

    /// The inputs of the grouped system, `Uᵈ`.
    pub fn input(&self) -> &Polytope {
        &self.input
    }

    /// The lower layer, if there is one.
    pub fn stabilizer(&self) -> Option<&Stabilizer> {
        self.stabilizer.as_ref()
    }

    /// The partition.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// What the cells mean to the task.
    pub fn labels(&self) -> &CellLabels {
        &self.labels
    }

    /// What the memory of the task becomes in each cell.
    pub fn cell_task(&self) -> &CellTask {
        &self.cell_task
    }

    /// The same as models have it: with the worst standing in every cell, and memories that count (grouped) steps if the last
    /// one decides.
    pub fn worst_task(&self) -> &CellTask {
        &self.worst_task
    }

    /// What is wanted.
    pub fn objective(&self) -> &Objective {
        &self.objective
    }

    /// The goal region, empty if nothing is to be reached.
    pub fn goal(&self) -> &[Region] {
        match &self.objective {
            Objective::Reach { goal } => goal,
            Objective::Stay { .. } | Objective::Automaton(_) => &[],
        }
    }

    /// The unsafe region.
    pub fn unsafe_regions(&self) -> &[Region] {
        &self.unsafe_
    }

    /// Whether everything outside the partition is unsafe too. At grouped instants it counts as failed anyway.
    pub fn outside_is_unsafe(&self) -> bool {
        self.outside_is_unsafe
    }

    /// When the unsafe region is avoided.
    pub fn safety(&self) -> Safety {
        self.safety
    }

    /// What the controller chooses from.
    pub fn actions(&self) -> &Actions {
        &self.actions
    }

    /// The number of grouped steps, or `None` for an unbounded task.
    pub fn horizon(&self) -> Option<u64> {
        self.horizon
    }

    /// The probability that is wanted.
    pub fn threshold(&self) -> Option<&Probability> {
        self.threshold.as_ref()
    }

    /// The initial state, if one was given.
    pub fn initial_state(&self) -> Option<&[f64]> {
        self.initial.as_ref().map(|initial| initial.state.as_slice())
    }

    /// The cell of the initial state, if one was given.
    pub fn initial_cell(&self) -> Option<CellId> {
        self.initial.as_ref().map(|initial| initial.cell)
    }

    /// What steps cost.
    pub fn costs(&self) -> &[Cost] {
        &self.costs
    }

    /// What is known of the noise.
    pub fn noise(&self) -> &PlantNoise {
        &self.noise
    }

    /// What is known of the noise, and how intervals are computed from it: the mode of the abstraction.
    pub fn knowledge(&self) -> Knowledge<'_> {
        match (&self.noise, &self.probabilities) {
            (PlantNoise::Known(components), _) => Knowledge::Distribution(components),
            (PlantNoise::Sampled(noise), Probabilities::Pac { beta, sweep, discard }) => {
                Knowledge::Samples { noise, beta, sweep: *sweep, discard: *discard }
            }
            (PlantNoise::Sampled(noise), Probabilities::Reference { beta_per_interval }) => {
                Knowledge::Published { noise, beta_per_interval: *beta_per_interval }
            }
        }
    }

    /// What the user should know.
    pub fn warnings(&self) -> &[Warning] {
        &self.warnings
    }
}
