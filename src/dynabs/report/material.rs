//! What a report is made of.

use super::values::StepValues;
use crate::controller::{Controller, Decision, Noise, Simulation, Tally, Trajectory};
use crate::partition::{CellId, CellKind};
use crate::problem::{Problem, StepNoise};
use crate::run::Run;
use imdp::engines::CrossCheckFile;
use imdp::numeric::to_f64;
use imdp::progress::Progress;
use imdp::solver::Answer;
use std::time::Duration;

/// Runs of unbounded tasks are given up after this many grouped steps.
const MOST_STEPS: u64 = 2000;

/// The most columns of a time axis of an unbounded task.
const MOST_COLUMNS: usize = 60;

/// What to simulate for a report, and what else to show.
#[derive(Clone, Debug)]
pub struct MaterialOptions {
    /// The seed of the simulated runs.
    pub seed: u64,
    /// The number of runs that are counted.
    pub runs: u64,
    /// The number of runs that are drawn: the first of them.
    pub drawn: u64,
    /// How long the phases so far took; empty for a page that is the same every time.
    pub times: Vec<(&'static str, Duration)>,
    /// What other engines said.
    pub cross_checks: Option<CrossCheckFile>,
}

/// A solved run with its controller, simulated: everything a report shows.
pub struct Material<'a> {
    pub(super) run: &'a Run,
    pub(super) answer: &'a Answer,
    pub(super) controller: &'a Controller,
    pub(super) options: MaterialOptions,
    pub(super) values: StepValues,
    /// Where simulated runs start.
    pub(super) start: Vec<f64>,
    pub(super) noise: &'static str,
    pub(super) tally: Tally,
    pub(super) trajectories: Vec<Trajectory>,
    /// The mean of the samples of the grouped noise.
    pub(super) noise_mean: Vec<f64>,
    faces: Vec<Vec<f64>>,
}

impl<'a> Material<'a> {
    /// Simulates, and gathers what a report needs.
    pub fn new(
        run: &'a Run,
        answer: &'a Answer,
        controller: &'a Controller,
        options: MaterialOptions,
        progress: &dyn Progress,
    ) -> Self {
        let problem = &run.problem;
        let values = StepValues::new(run, answer);
        let start = problem
            .initial_state()
            .map(<[f64]>::to_vec)
            .unwrap_or_else(|| typical_state(problem, controller));
        let noise = match &problem.noise().of_one_step {
            StepNoise::Gaussian(_) => "the model's Gaussian noise",
            _ => "the model's samples, drawn with replacement",
        };
        let simulation = Simulation::new(problem, controller, Noise::of(problem.noise()), MOST_STEPS);
        let tally = simulation.tally(&start, options.seed, options.runs, progress);
        let drawn = 0..options.drawn;
        let trajectories = drawn.map(|run| simulation.trajectory(&start, options.seed, run)).collect();
        let faces = problem.grid().axes().iter();
        let faces = faces.map(|axis| (0..=axis.cells()).map(|i| to_f64(&axis.face(i))).collect()).collect();
        let noise_mean = mean(problem);
        Self {
            run,
            answer,
            controller,
            options,
            values,
            start,
            noise,
            tally,
            trajectories,
            noise_mean,
            faces,
        }
    }

    pub(super) fn problem(&self) -> &'a Problem {
        &self.run.problem
    }

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

    /// The last grouped step of a time axis.
    pub(super) fn last_step(&self) -> usize {
        if self.problem().horizon().is_some() {
            return self.values.last_step();
        }
        let longest = self.trajectories.iter().map(|trajectory| trajectory.outcome.steps).max();
        (longest.unwrap_or(1).max(1) as usize).min(MOST_COLUMNS)
    }

    /// What values are called: in reference mode nothing is promised.
    pub(super) fn value_name(&self) -> &'static str {
        if self.run.abstraction.guarantee.confidence().is_some() {
            "promised probability"
        } else {
            "value (nothing is promised)"
        }
    }

    pub(super) fn time_name(&self) -> String {
        match self.problem().group_steps() {
            1 => "step k".to_owned(),
            d => format!("grouped step k ({d} steps each)"),
        }
    }

    /// The mean of the state after the action of `cell` at `step`; `None` if there is none.
    pub(super) fn mean_successor(&self, cell: CellId, step: usize) -> Option<Vec<f64>> {
        let Decision::Act { action } = self.controller.decide_in(cell, step as u64) else {
            return None;
        };
        let point = self.controller.action(action);
        Some(point.iter().zip(&self.noise_mean).map(|(d, mean)| d + mean).collect())
    }
}

/// The center of an ordinary cell from which something is promised: the one with the median promise.
fn typical_state(problem: &Problem, controller: &Controller) -> Vec<f64> {
    let ordinary = problem.labels().iter().filter(|(_, kind)| *kind == CellKind::Ordinary);
    let mut cells: Vec<CellId> = ordinary.map(|(cell, _)| cell).collect();
    cells.sort_by(|&a, &b| controller.bound(a).total_cmp(&controller.bound(b)).then(a.cmp(&b)));
    let first = cells.partition_point(|&cell| controller.bound(cell) <= 0.0);
    let cells = if first < cells.len() { &cells[first..] } else { &cells[..] };
    let cell = cells.get(cells.len() / 2).copied().unwrap_or(CellId(0));
    let coordinates = problem.grid().coordinates(cell);
    problem.grid().axes().iter().zip(coordinates).map(|(axis, i)| to_f64(&axis.center(i))).collect()
}

fn mean(problem: &Problem) -> Vec<f64> {
    let samples = &problem.noise().samples;
    let mut sum = vec![0.0; samples.dimension()];
    for sample in samples.iter() {
        sum.iter_mut().zip(sample).for_each(|(sum, x)| *sum += x);
    }
    sum.iter().map(|sum| sum / samples.len() as f64).collect()
}
