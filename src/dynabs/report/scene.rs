//! What plots show of a closed loop, whatever its actions are.

use super::outlines::Outlined;
use super::over_time::InputAxis;
use super::palette::ColourScale;
use super::values::StepValues;
use crate::controller::{Controller, Tally, Trajectory};
use crate::partition::{CellId, CellKind, Grid, GridAxis, Region};
use crate::problem::Objective;
use crate::task::{Aim, Memory, Safety, Standing};
use imdp::numeric::to_f64;

/// The most columns of a time axis of an unbounded task.
const MOST_COLUMNS: usize = 60;

/// A closed loop, simulated.
pub(super) struct Scene<'a> {
    pub(super) name: &'a str,
    pub(super) grid: &'a Grid,
    /// The names of the coordinates of the state.
    pub(super) names: Vec<String>,
    /// Their units.
    pub(super) units: Vec<Option<String>>,
    /// Their lengths, where they are periodic.
    pub(super) periods: Vec<Option<f64>>,
    pub(super) wanted: &'a [Region],
    /// What these are.
    pub(super) wanted_name: &'static str,
    pub(super) unsafe_: &'a [Region],
    /// The regions that the task names.
    pub(super) named: Vec<Outlined>,
    /// Values on arrival with each memory before, if runs have one; `values` are those at the start.
    pub(super) memories: Vec<StepValues>,
    /// In grouped steps.
    pub(super) horizon: Option<u64>,
    pub(super) group_steps: usize,
    pub(super) safety: Safety,
    pub(super) threshold: Option<f64>,
    /// Whether values are promised: in reference mode nothing is.
    pub(super) is_promised: bool,
    pub(super) values: StepValues,
    /// Where simulated runs start.
    pub(super) start: Vec<f64>,
    /// Whether the model says so.
    pub(super) start_is_given: bool,
    pub(super) start_cell: Option<CellId>,
    pub(super) seed: u64,
    /// What is drawn as noise.
    pub(super) noise: &'static str,
    /// The bound at the start.
    pub(super) bound: f64,
    pub(super) tally: Tally,
    /// How many of them were to be drawn.
    pub(super) wanted_runs: u64,
    pub(super) trajectories: Vec<Trajectory>,
    pub(super) inputs: Vec<InputAxis>,
    /// Samples or draws of the noise of a grouped step.
    pub(super) noise_draws: Vec<Vec<f64>>,
    pub(super) actions: Box<dyn SceneActions + 'a>,
    pub(super) scale: ColourScale,
    pub(super) faces: Vec<Vec<f64>>,
}

/// What a controller does in cells.
pub(super) trait SceneActions {
    /// The controller.
    fn controller(&self) -> &Controller;

    /// What it means to the task to arrive in a cell, with a memory before or at the start.
    fn kind(&self, before: Option<Memory>, cell: CellId) -> CellKind {
        let (controller, task) = (self.controller(), self.controller().task());
        if task.memories() <= 1 {
            return controller.kind(cell);
        }
        let standings = task.standings(before, cell.index());
        if standings.iter().all(|&standing| standing == Standing::Reached) {
            CellKind::Goal
        } else if standings.iter().all(|&standing| standing == Standing::Failed) {
            CellKind::Unsafe
        } else {
            CellKind::Ordinary
        }
    }

    /// The actions on arrival in a cell, with a memory before or at the start, by the number of grouped steps left, ascending.
    fn entries(&self, before: Option<Memory>, cell: CellId) -> Vec<(u64, u32)> {
        let standings = self.controller().task().standings(before, cell.index());
        let open = standings.iter().find_map(|standing| match standing {
            Standing::Open(memory) => Some(*memory),
            Standing::Failed | Standing::Reached => None,
        });
        let entries = open.map_or(&[][..], |memory| self.controller().entries(memory, cell));
        entries.iter().map(|entry| (entry.steps_left, entry.action)).collect()
    }

    /// The mean of the state after an action, from the center of a cell.
    fn successor(&self, cell: CellId, action: u32) -> Vec<f64>;

    /// An action in words.
    fn words(&self, action: u32) -> String;

    /// Whether where an action leads depends on the cell.
    fn leads_by_cell(&self) -> bool;

    /// How many actions are enabled in a cell.
    fn enabled(&self, cell: CellId) -> usize;
}

/// What the wanted region of a task is.
pub(super) fn wanted_name(objective: &Objective) -> &'static str {
    if objective.aim() == Aim::Stay { "safe region" } else { "goal" }
}

/// The faces of the cells in every dimension.
pub(super) fn faces(grid: &Grid) -> Vec<Vec<f64>> {
    let of_axis = |axis: &GridAxis| (0..=axis.cells()).map(|i| to_f64(&axis.face(i))).collect();
    grid.axes().iter().map(of_axis).collect()
}

impl Scene<'_> {
    pub(super) fn dimension(&self) -> usize {
        self.faces.len()
    }

    /// The faces of the cells in every dimension.
    pub(super) fn faces(&self) -> &[Vec<f64>] {
        &self.faces
    }

    /// The sides of the partition in one dimension.
    pub(super) fn range(&self, dimension: usize) -> (f64, f64) {
        let faces = &self.faces[dimension];
        (faces[0], faces[faces.len() - 1])
    }

    /// The center of a cell in one dimension.
    pub(super) fn center(&self, dimension: usize, index: u32) -> f64 {
        let faces = &self.faces[dimension];
        (faces[index as usize] + faces[index as usize + 1]) / 2.0
    }

    /// The name of a coordinate with its unit.
    pub(super) fn title(&self, dimension: usize) -> String {
        let name = &self.names[dimension];
        self.units[dimension].as_ref().map_or_else(|| name.clone(), |unit| format!("{name} [{unit}]"))
    }

    /// The last grouped step of a time axis.
    pub(super) fn last_step(&self) -> usize {
        if self.horizon.is_some() {
            return self.values.last_step();
        }
        let longest = self.trajectories.iter().map(|trajectory| trajectory.outcome.steps).max();
        (longest.unwrap_or(1).max(1) as usize).min(MOST_COLUMNS)
    }

    /// What runs remember on arrival: nothing yet at the start, then each memory if there are several.
    pub(super) fn before(&self) -> impl Iterator<Item = Option<Memory>> + use<> {
        std::iter::once(None).chain((0..self.memories.len() as Memory).map(Some))
    }

    /// All cells at the start, then with each memory before.
    pub(super) fn arrivals(&self) -> impl Iterator<Item = (Option<Memory>, CellId)> + use<> {
        let cells = self.grid.num_cells();
        self.before().flat_map(move |before| (0..cells).map(move |cell| (before, CellId(cell))))
    }

    /// The actions of a cell that are taken at some step of those whose values are kept.
    pub(super) fn shown_entries(&self, before: Option<Memory>, cell: CellId) -> Vec<(u64, u32)> {
        let mut entries = self.actions.entries(before, cell);
        let least = self.horizon.map_or(1, |horizon| horizon.saturating_sub(self.last_step() as u64)).max(1);
        let unseen = entries.partition_point(|(left, _)| *left <= least).saturating_sub(1);
        entries.drain(..unseen);
        entries
    }

    /// What values are called.
    pub(super) fn value_name(&self) -> &'static str {
        if self.is_promised { "promised probability" } else { "value (nothing is promised)" }
    }

    pub(super) fn time_name(&self) -> String {
        match self.group_steps {
            1 => "step k".to_owned(),
            d => format!("grouped step k ({d} steps each)"),
        }
    }

    /// The action of a cell after so many grouped steps; `None` if there is none.
    pub(super) fn action(&self, cell: CellId, step: usize) -> Option<u32> {
        let left = self.horizon.map_or(1, |horizon| horizon.saturating_sub(step as u64));
        if self.actions.kind(None, cell) != CellKind::Ordinary || left == 0 {
            return None;
        }
        let entries = self.actions.entries(None, cell);
        entries.iter().rev().find(|(at_least, _)| *at_least <= left).map(|&(_, action)| action)
    }

    /// The mean of the state after the action of `cell` at `step`; `None` if there is none.
    pub(super) fn mean_successor(&self, cell: CellId, step: usize) -> Option<Vec<f64>> {
        self.action(cell, step).map(|action| self.actions.successor(cell, action))
    }
}
