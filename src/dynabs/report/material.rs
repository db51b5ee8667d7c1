//! What a report of actions that are targets is made of.

use super::budget::drawn;
use super::choice::{ViewChoice, ViewError};
use super::noise_plots::DRAWN;
use super::numbers::{subscripted, tuple};
use super::outlines::Outlined;
use super::over_time::InputAxis;
use super::palette::ColourScale;
use super::scene::{Scene, SceneActions, faces, wanted_name};
use super::values::StepValues;
use super::view::View;
use crate::controller::{Controller, Noise, Simulation};
use crate::partition::{CellId, CellKind};
use crate::problem::{PlantNoise, Problem, StepNoise};
use crate::run::Run;
use imdp::engines::CrossCheckFile;
use imdp::numeric::to_f64;
use imdp::progress::Progress;
use imdp::solver::Answer;
use std::time::Duration;

/// Runs of unbounded tasks are given up after this many grouped steps.
pub(super) const MOST_STEPS: u64 = 2000;

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
    /// The mean of the samples of the grouped noise.
    pub(super) noise_mean: Vec<f64>,
    pub(super) scene: Scene<'a>,
    pub(super) view: View,
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
        let start = problem
            .initial_state()
            .map(<[f64]>::to_vec)
            .unwrap_or_else(|| typical_state(problem, controller));
        let noise = match problem.noise() {
            PlantNoise::Known(_) => "the model's noise",
            PlantNoise::Sampled(noise) if matches!(noise.of_one_step, StepNoise::Gaussian(_)) => {
                "the model's Gaussian noise"
            }
            PlantNoise::Sampled(_) => "the model's samples, drawn with replacement",
        };
        let simulation = Simulation::new(problem, controller, Noise::of_plant(problem.noise()), MOST_STEPS);
        let tally = simulation.tally(&start, options.seed, options.runs, progress);
        let trajectories = drawn(options.drawn, |run| simulation.trajectory(&start, options.seed, run));
        let noise_mean = problem.noise().mean();
        let n = problem.grid().dimension();
        let scene = Scene {
            name: problem.name(),
            grid: problem.grid(),
            names: (1..=n).map(|j| subscripted("x", j)).collect(),
            units: vec![None; n],
            periods: vec![None; n],
            wanted_name: wanted_name(problem.objective()),
            wanted: problem.objective().wanted(),
            named: Outlined::of(problem.objective().named()),
            unsafe_: problem.unsafe_regions(),
            memories: StepValues::of_memories(run, answer),
            horizon: problem.horizon(),
            group_steps: problem.group_steps(),
            safety: problem.safety(),
            threshold: problem.threshold().map(|threshold| threshold.to_f64()),
            is_promised: run.abstraction.guarantee.confidence().is_some(),
            values: StepValues::of_answer(run, answer),
            start_is_given: problem.initial_state().is_some(),
            start_cell: controller.cell(&start),
            seed: options.seed,
            noise,
            bound: controller.bound_at(&start),
            start,
            tally,
            wanted_runs: options.drawn,
            trajectories,
            actions: Box::new(Steering { run, controller, noise_mean: noise_mean.clone() }),
            inputs: inputs(problem),
            noise_draws: match problem.noise() {
                PlantNoise::Sampled(noise) => noise.samples.iter().take(DRAWN).map(<[f64]>::to_vec).collect(),
                known @ PlantNoise::Known(_) => Noise::of_plant(known).sample(DRAWN, options.seed),
            },
            scale: ColourScale { from: 0.0, to: 1.0 },
            faces: faces(problem.grid()),
        };
        let scene = scene.finished();
        let view = View::first(&scene);
        Self { run, answer, controller, options, noise_mean, scene, view }
    }

    /// The same with another plane in the first view.
    ///
    /// # Errors
    /// [`ViewError`] if there is no such plane.
    pub fn seen(self, choice: &ViewChoice) -> Result<Self, ViewError> {
        Ok(Self { view: View::chosen(&self.scene, choice)?, ..self })
    }

    pub(super) fn problem(&self) -> &'a Problem {
        &self.run.problem
    }
}

/// The inputs, with the sides of the smallest box around U.
fn inputs(problem: &Problem) -> Vec<InputAxis> {
    let limits = problem.step_input().bounding_box();
    let axis = |j: usize| InputAxis {
        title: subscripted("u", j + 1),
        limits: limits.as_ref().map(|sides| (to_f64(&sides[j].0), to_f64(&sides[j].1))),
    };
    (0..problem.step_input().dimension()).map(axis).collect()
}

/// Actions that steer to targets.
struct Steering<'a> {
    run: &'a Run,
    controller: &'a Controller,
    noise_mean: Vec<f64>,
}

impl SceneActions for Steering<'_> {
    fn controller(&self) -> &Controller {
        self.controller
    }

    fn successor(&self, _: CellId, action: u32) -> Vec<f64> {
        let point = self.controller.action(action);
        point.iter().zip(&self.noise_mean).map(|(d, mean)| d + mean).collect()
    }

    fn words(&self, action: u32) -> String {
        format!("steer to d = {}", tuple(self.controller.action(action)))
    }

    fn leads_by_cell(&self) -> bool {
        false
    }

    fn enabled(&self, cell: CellId) -> usize {
        let abstraction = &self.run.abstraction;
        abstraction.ranges(cell).iter().map(|range| range.len()).sum()
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
