//! One run of the closed loop, and many.

use super::input_check::{InputCheck, Violation};
use super::{Noise, Plant, Tally};
use crate::controller::{Controller, Decision};
use crate::partition::RegionLookup;
use crate::problem::Problem;
use crate::task::Aim;
use imdp::progress::Progress;
use rand::SeedableRng;
use rand_chacha::ChaCha12Rng;
use rayon::prelude::*;
use serde::Serialize;

/// A closed loop that can be simulated: plant, controller, noise, task.
#[derive(Clone, Debug)]
pub struct Simulation<'a> {
    controller: &'a Controller,
    plant: Plant,
    inputs: InputCheck,
    /// The goal, or the region to stay in.
    wanted: Vec<RegionLookup>,
    aim: Aim,
    avoid: Vec<RegionLookup>,
    /// Whether the outside of the partition is to be avoided at every step too.
    avoids_outside: bool,
    noise: Noise,
    /// Runs of unbounded tasks end after this many grouped steps.
    most_steps: u64,
}

/// How a run ended, as the abstraction sees it: at grouped instants, in cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// In a goal cell.
    Reached,
    /// In a cell that meets the unsafe region.
    Unsafe,
    /// Outside the partition.
    Outside,
    /// In a cell without an enabled action.
    NoAction,
    /// The horizon passed.
    Over,
    /// An unbounded task was given up.
    Unfinished,
}

/// What one run came to.
#[derive(Clone, Debug, PartialEq)]
pub struct RunOutcome {
    /// How it ended.
    pub end: End,
    /// Whether the goal region itself was met at a grouped instant, and nothing unsafe at any original step before.
    pub satisfied: bool,
    /// Whether the goal region itself was met at a grouped instant, the unsafe region at no such instant before.
    pub satisfied_at_instants: bool,
    /// Whether something unsafe was met between grouped instants, before the goal.
    pub unsafe_between: bool,
    /// The number of grouped steps taken.
    pub steps: u64,
    /// How many inputs, of one step each, were outside `U`.
    pub violations: u64,
    /// The first of them.
    pub first_violation: Option<Violation>,
}

/// What an observer of a run sees, before every original step and at the end.
pub(super) struct Moment<'a> {
    pub step: u64,
    pub x: &'a [f64],
    /// The input of the step, unless this is the end.
    pub u: Option<&'a [f64]>,
    /// The decision, at grouped instants.
    pub decision: Option<Decision>,
}

/// What the runs of one thread reuse.
struct Scratch {
    x: Vec<f64>,
    next: Vec<f64>,
    /// The state at the last grouped instant.
    grouped: Vec<f64>,
    u: Vec<f64>,
    noise: Vec<f64>,
}

/// Runs per parallel task.
const RUNS_PER_TASK: u64 = 256;

impl<'a> Simulation<'a> {
    /// The loop of a problem, closed with its controller; `noise` has the dimension of the state.
    ///
    /// Runs of unbounded tasks are given up after `most_steps` grouped steps.
    pub fn new(problem: &Problem, controller: &'a Controller, noise: Noise, most_steps: u64) -> Self {
        assert_eq!(noise.dimension(), controller.state_dimension(), "noise of the state's dimension");
        let lookups = |regions: &[_]| regions.iter().map(RegionLookup::new).collect();
        Self {
            controller,
            plant: Plant::new(problem.step_system()),
            inputs: InputCheck::new(problem.step_input()),
            wanted: lookups(problem.wanted()),
            aim: problem.objective().aim(),
            avoid: lookups(problem.unsafe_regions()),
            avoids_outside: problem.outside_is_unsafe(),
            noise,
            most_steps: problem.horizon().unwrap_or(most_steps),
        }
    }

    /// Run number `run` from `start`: the same for the same seed.
    pub fn run(&self, start: &[f64], seed: u64, run: u64) -> RunOutcome {
        self.observe(start, seed, run, &mut self.scratch(), |_| {})
    }

    /// Runs `0 .. runs` from `start`, in parallel; the result does not depend on the number of threads.
    ///
    /// Stops early, with fewer runs, when `progress` is interrupted.
    pub fn tally(&self, start: &[f64], seed: u64, runs: u64, progress: &dyn Progress) -> Tally {
        progress.start("simulation", runs);
        let tasks = (0..runs.div_ceil(RUNS_PER_TASK)).into_par_iter();
        let tally = tasks
            .map_init(
                || self.scratch(),
                |scratch, task| {
                    let mut tally = Tally::default();
                    if progress.is_interrupted() {
                        return tally;
                    }
                    let first = task * RUNS_PER_TASK;
                    let last = (first + RUNS_PER_TASK).min(runs);
                    for run in first..last {
                        tally.add(self.observe(start, seed, run, scratch, |_| {}));
                    }
                    progress.advance(last - first);
                    tally
                },
            )
            .reduce(Tally::default, Tally::merge);
        progress.finish();
        tally
    }

    pub(super) fn watch(
        &self,
        start: &[f64],
        seed: u64,
        run: u64,
        see: impl FnMut(Moment<'_>),
    ) -> RunOutcome {
        self.observe(start, seed, run, &mut self.scratch(), see)
    }

    fn scratch(&self) -> Scratch {
        let (n, d) = (self.controller.state_dimension(), self.controller.group_steps());
        Scratch {
            x: vec![0.0; n],
            next: vec![0.0; n],
            grouped: vec![0.0; n],
            u: vec![0.0; self.controller.inputs()],
            noise: vec![0.0; n * d],
        }
    }

    fn observe(
        &self,
        start: &[f64],
        seed: u64,
        run: u64,
        scratch: &mut Scratch,
        mut see: impl FnMut(Moment<'_>),
    ) -> RunOutcome {
        let (n, p) = (self.controller.state_dimension(), self.controller.step_inputs());
        let d = self.controller.group_steps();
        let mut rng = ChaCha12Rng::seed_from_u64(seed);
        rng.set_stream(run);
        scratch.x.copy_from_slice(start);
        let mut outcome = RunOutcome {
            end: End::Unfinished,
            satisfied: false,
            satisfied_at_instants: false,
            unsafe_between: false,
            steps: 0,
            violations: 0,
            first_violation: None,
        };
        let mut decided = false;
        loop {
            if !decided && (contains(&self.avoid, &scratch.x) || self.has_left(&scratch.x)) {
                decided = true;
            } else if !decided && self.aim == Aim::Reach && contains(&self.wanted, &scratch.x) {
                (decided, outcome.satisfied_at_instants) = (true, true);
                outcome.satisfied = !outcome.unsafe_between;
            }
            let decision = self.controller.control(&scratch.x, outcome.steps, &mut scratch.u);
            let step = outcome.steps * d as u64;
            let end = match decision {
                Decision::Steer { .. } | Decision::Apply { .. } if outcome.steps < self.most_steps => None,
                Decision::Steer { .. } | Decision::Apply { .. } => Some(End::Unfinished),
                Decision::Reached => Some(End::Reached),
                Decision::Unsafe => Some(End::Unsafe),
                Decision::Outside => Some(End::Outside),
                Decision::NoAction => Some(End::NoAction),
                Decision::Over => Some(End::Over),
            };
            if let Some(end) = end {
                see(Moment { step, x: &scratch.x, u: None, decision: Some(decision) });
                if self.aim == Aim::Stay && end == End::Over && !decided {
                    outcome.satisfied_at_instants = true;
                    outcome.satisfied = !outcome.unsafe_between;
                }
                return RunOutcome { end, ..outcome };
            }
            self.noise.draw(&mut rng, &mut scratch.noise);
            scratch.grouped.copy_from_slice(&scratch.x);
            for i in 0..d {
                let u = &scratch.u[i * p..(i + 1) * p];
                let step = step + i as u64;
                if let Some((half_space, excess)) = self.inputs.violation(u) {
                    outcome.violations += 1;
                    outcome.first_violation.get_or_insert_with(|| Violation {
                        run,
                        step,
                        state: scratch.grouped.clone(),
                        input: u.to_vec(),
                        half_space,
                        excess,
                    });
                }
                let decision = (i == 0).then_some(decision);
                see(Moment { step, x: &scratch.x, u: Some(u), decision });
                self.plant.step(&scratch.x, u, &scratch.noise[i * n..(i + 1) * n], &mut scratch.next);
                std::mem::swap(&mut scratch.x, &mut scratch.next);
                outcome.unsafe_between |= !decided && i + 1 < d && self.is_unsafe(&scratch.x);
            }
            outcome.steps += 1;
        }
    }
}

impl Simulation<'_> {
    /// Whether a state is outside of the region to stay in, if there is one.
    fn has_left(&self, x: &[f64]) -> bool {
        self.aim == Aim::Stay && !self.wanted.is_empty() && !contains(&self.wanted, x)
    }

    /// Whether a state between grouped instants is unsafe.
    fn is_unsafe(&self, x: &[f64]) -> bool {
        contains(&self.avoid, x) || self.avoids_outside && self.controller.cell(x).is_none()
    }
}

fn contains(regions: &[RegionLookup], x: &[f64]) -> bool {
    regions.iter().any(|region| region.contains(x))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::abstraction::{Abstraction, compile};
    use crate::model_file::Document;
    use imdp::solver::{Answer, SolverOptions};
    use std::path::Path;

    fn room() -> (Problem, Controller) {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/room_temperature.json");
        let document = Document::parse(&path, &std::fs::read_to_string(&path).unwrap()).unwrap();
        let problem = document.problem().unwrap();
        let abstraction: Abstraction = compile(&problem, &()).unwrap();
        let options = SolverOptions { policy: true, ..SolverOptions::default() };
        let answer = Answer::new(&abstraction.model, &abstraction.property, &options).unwrap();
        let controller = Controller::new(&problem, &abstraction, &answer).unwrap();
        (problem, controller)
    }

    #[test]
    fn a_broken_law_is_noticed() {
        let (problem, mut controller) = room();
        let noise = Noise::of(problem.noise());
        let tally = |controller: &Controller| {
            Simulation::new(&problem, controller, noise.clone(), 0).tally(&[2.0], 1, 1000, &())
        };
        let sound = tally(&controller);
        assert_eq!((sound.violations, &sound.first_violation), (0, &None));
        controller.law.constant[0] += 0.5;
        let broken = tally(&controller);
        let first = broken.first_violation.unwrap();
        assert!(broken.violations >= 1000 && first.run == 0 && first.step == 0 && first.state == [2.0]);
        assert!(first.input[0] > 1.75 && (first.excess - (first.input[0] - 1.75)).abs() < 1e-15);
    }
}
