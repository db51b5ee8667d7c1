//! What a report of actions that are inputs is made of.

use super::budget::drawn;
use super::choice::{ViewChoice, ViewError};
use super::material::{MOST_STEPS, MaterialOptions};
use super::noise_plots::DRAWN;
use super::numbers::tuple;
use super::outlines::Outlined;
use super::over_time::InputAxis;
use super::palette::ColourScale;
use super::scene::{Scene, SceneActions, faces, wanted_name};
use super::values::StepValues;
use super::view::View;
use crate::controller::{Controller, Noise, ParameterChoice, Simulation};
use crate::geometry::Polytope;
use crate::landing::LandingSolution;
use crate::partition::CellId;
use crate::problem::{InputNoise, InputProblem};
use crate::run::InputRun;
use crate::system::Variable;
use crate::task::Safety;
use imdp::numeric::to_f64;
use imdp::progress::Progress;
use imdp::property::Verdict;

/// A solved run with its controller, simulated: everything a report shows.
pub struct InputMaterial<'a> {
    pub(super) run: &'a InputRun,
    pub(super) solution: &'a LandingSolution,
    pub(super) controller: &'a Controller,
    pub(super) options: MaterialOptions,
    /// Whether the probability asked for is promised, where that is decided.
    pub(super) satisfied: Option<bool>,
    /// The upper bound at the start.
    pub(super) upper: f64,
    pub(super) scene: Scene<'a>,
    pub(super) view: View,
}

impl<'a> InputMaterial<'a> {
    /// Simulates, and gathers what a report needs.
    pub fn new(
        run: &'a InputRun,
        solution: &'a LandingSolution,
        controller: &'a Controller,
        options: MaterialOptions,
        progress: &dyn Progress,
    ) -> Self {
        let problem = &run.problem;
        let start_cell = problem.initial_cell().unwrap_or_else(|| typical_cell(run, controller));
        let center = || {
            let axes = problem.grid().axes().iter().zip(problem.grid().coordinates(start_cell));
            axes.map(|(axis, i)| to_f64(&axis.center(i))).collect()
        };
        let start = problem.initial_state().map_or_else(center, <[f64]>::to_vec);
        let simulation = Simulation::of_inputs(problem, controller, ParameterChoice::Random, MOST_STEPS);
        let tally = simulation.tally(&start, options.seed, options.runs, progress);
        let trajectories = drawn(options.drawn, |run| simulation.trajectory(&start, options.seed, run));
        let upper = solution.values.upper[start_cell.index()];
        let states = problem.mode().states();
        let scene = Scene {
            name: problem.name(),
            grid: problem.grid(),
            names: states.iter().map(|state| state.name.clone()).collect(),
            units: states.iter().map(|state| state.unit.clone()).collect(),
            periods: periods(problem),
            wanted_name: wanted_name(problem.objective()),
            wanted: problem.objective().wanted(),
            named: Outlined::of(problem.objective().named()),
            unsafe_: problem.unsafe_regions(),
            memories: StepValues::of_lattice_memories(run, solution),
            horizon: problem.horizon(),
            group_steps: 1,
            safety: Safety::EveryStep,
            threshold: problem.threshold().map(|threshold| threshold.to_f64()),
            is_promised: true,
            values: StepValues::of_lattice(solution),
            start_is_given: problem.initial_state().is_some(),
            start_cell: Some(start_cell),
            seed: options.seed,
            noise: match problem.noise() {
                InputNoise::Sampled(_) => "the model's noise, or its samples drawn with replacement",
                _ => "the model's distributions",
            },
            bound: controller.bound_at(&start),
            start,
            tally,
            wanted_runs: options.drawn,
            trajectories,
            actions: Box::new(Applying { run, controller, noise_mean: mean(problem.noise(), states.len()) }),
            inputs: inputs(problem),
            noise_draws: match problem.noise() {
                InputNoise::Sampled(samples) => {
                    samples.noise.samples.iter().take(DRAWN).map(<[f64]>::to_vec).collect()
                }
                known => Noise::of_inputs(known).sample(DRAWN, options.seed),
            },
            scale: ColourScale { from: 0.0, to: 1.0 },
            faces: faces(problem.grid()),
        };
        let scene = scene.finished();
        let satisfied = run.abstraction.verdict(problem, &solution.values).and_then(Verdict::decided);
        let view = View::first(&scene);
        Self { run, solution, controller, options, satisfied, upper, scene, view }
    }

    /// The same with another plane in the first view.
    ///
    /// # Errors
    /// [`ViewError`] if there is no such plane.
    pub fn seen(self, choice: &ViewChoice) -> Result<Self, ViewError> {
        Ok(Self { view: View::chosen(&self.scene, choice)?, ..self })
    }
}

/// The inputs, with the sides of the smallest box around U, or of those that there are.
fn inputs(problem: &InputProblem) -> Vec<InputAxis> {
    let limits = problem.set().and_then(Polytope::bounding_box);
    let listed = |j: usize| {
        let values = || problem.inputs().iter().map(|input| to_f64(&input[j]));
        (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max))
    };
    let axis = |(j, input): (usize, &Variable)| InputAxis {
        title: input
            .unit
            .as_ref()
            .map_or_else(|| input.name.clone(), |unit| format!("{} [{unit}]", input.name)),
        limits: Some(
            limits.as_ref().map_or_else(|| listed(j), |sides| (to_f64(&sides[j].0), to_f64(&sides[j].1))),
        ),
    };
    problem.mode().inputs().iter().enumerate().map(axis).collect()
}

/// The lengths of periodic coordinates.
fn periods(problem: &InputProblem) -> Vec<Option<f64>> {
    let axes = problem.grid().axes().iter().zip(problem.periodic());
    axes.map(|(axis, periodic)| periodic.then(|| to_f64(axis.upper()) - to_f64(axis.lower()))).collect()
}

/// The mean of the noise, for arrows.
fn mean(noise: &InputNoise, dimension: usize) -> Vec<f64> {
    match noise {
        InputNoise::Components(components) => {
            components.iter().map(|one| one.as_ref().map_or(0.0, |one| one.center())).collect()
        }
        InputNoise::Gaussian(joint) => joint.draws.mean().to_vec(),
        InputNoise::Sampled(samples) => {
            let samples = &samples.noise.samples;
            let mut sum = vec![0.0; dimension];
            samples.iter().for_each(|sample| sum.iter_mut().zip(sample).for_each(|(sum, x)| *sum += x));
            sum.iter().map(|sum| sum / samples.len() as f64).collect()
        }
    }
}

/// The cell with the median of the bounds that are positive.
fn typical_cell(run: &InputRun, controller: &Controller) -> CellId {
    let mut cells: Vec<CellId> = run.abstraction.decided().into_iter().map(CellId).collect();
    cells.sort_by(|&a, &b| controller.bound(a).total_cmp(&controller.bound(b)).then(a.cmp(&b)));
    let first = cells.partition_point(|&cell| controller.bound(cell) <= 0.0);
    let cells = if first < cells.len() { &cells[first..] } else { &cells[..] };
    cells.get(cells.len() / 2).copied().unwrap_or(CellId(0))
}

/// Actions that apply inputs.
struct Applying<'a> {
    run: &'a InputRun,
    controller: &'a Controller,
    noise_mean: Vec<f64>,
}

impl SceneActions for Applying<'_> {
    fn controller(&self) -> &Controller {
        self.controller
    }

    fn successor(&self, cell: CellId, action: u32) -> Vec<f64> {
        let mode = self.run.problem.mode();
        let grid = self.run.problem.grid();
        let axes = grid.axes().iter().zip(grid.coordinates(cell));
        let center: Vec<f64> = axes.map(|(axis, i)| to_f64(&axis.center(i))).collect();
        let parameters: Vec<f64> = mode.parameters().iter().map(|p| p.middle()).collect();
        let mut next = vec![0.0; center.len()];
        mode.step(&center, self.controller.action(action), &parameters, &mut Vec::new(), &mut next);
        // As exactly as pages have it.
        next.iter().zip(&self.noise_mean).map(|(x, mean)| f64::from((x + mean) as f32)).collect()
    }

    fn words(&self, action: u32) -> String {
        let names: Vec<&str> =
            self.run.problem.mode().inputs().iter().map(|input| input.name.as_str()).collect();
        match names[..] {
            [] => "none to choose".to_owned(),
            [one] => format!("{one} = {}", super::numbers::short(self.controller.action(action)[0])),
            _ => format!("({}) = {}", names.join(", "), tuple(self.controller.action(action))),
        }
    }

    fn leads_by_cell(&self) -> bool {
        true
    }

    fn enabled(&self, _: CellId) -> usize {
        self.run.problem.inputs().len()
    }
}
