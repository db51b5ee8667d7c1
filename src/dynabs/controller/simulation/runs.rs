//! One run of the closed loop, and many.

use super::motion::Motion;
use super::witness::Witness;
use super::{End, InputCheck, Noise, ParameterChoice, Plant, RunOutcome, Tally, Violation};
use crate::controller::{Controller, Decision, RunMemory};
use crate::partition::RegionLookup;
use crate::problem::{InputProblem, Problem};
use imdp::progress::Progress;
use rand::SeedableRng;
use rand_chacha::ChaCha12Rng;
use rayon::prelude::*;

/// A closed loop that can be simulated: the true system, controller, noise, task.
#[derive(Clone, Debug)]
pub struct Simulation<'a> {
    controller: &'a Controller,
    motion: Motion<'a>,
    /// The set of inputs, if there is one.
    inputs: Option<InputCheck>,
    witness: Witness<'a>,
    /// What is to be avoided between grouped instants.
    avoid: Vec<RegionLookup>,
    /// Whether the outside of the partition is to be avoided at every step too.
    avoids_outside: bool,
    /// Runs of unbounded tasks end after this many grouped steps.
    most_steps: u64,
}

/// What an observer of a run sees, before every original step and at the end.
#[derive(Clone, Copy, Debug)]
pub struct Moment<'a> {
    /// The number of original steps before it.
    pub step: u64,
    /// The state.
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
    numbers: Vec<f64>,
}

/// Runs per parallel task.
const RUNS_PER_TASK: u64 = 128;

/// After so many grouped steps of a run somebody may have interrupted it.
const STEPS_BETWEEN_QUESTIONS: u64 = 1024;

impl<'a> Simulation<'a> {
    /// The loop of a problem whose actions are targets, closed with its controller; `noise` has the dimension of the state.
    ///
    /// Runs of unbounded tasks are given up after `most_steps` grouped steps.
    pub fn new(problem: &'a Problem, controller: &'a Controller, noise: Noise, most_steps: u64) -> Self {
        assert_eq!(noise.dimension(), controller.state_dimension(), "noise of the state's dimension");
        Self {
            controller,
            motion: Motion::Linear { plant: Plant::new(problem.step_system()), noise },
            inputs: Some(InputCheck::new(problem.step_input())),
            witness: Witness::new(problem.objective(), problem.unsafe_regions()),
            avoid: problem.unsafe_regions().iter().map(RegionLookup::new).collect(),
            avoids_outside: problem.outside_is_unsafe(),
            most_steps: problem.horizon().unwrap_or(most_steps),
        }
    }

    /// The loop of a problem whose actions are inputs, closed with its controller; the noise is the problem's.
    ///
    /// Runs of unbounded tasks are given up after `most_steps` steps.
    pub fn of_inputs(
        problem: &'a InputProblem,
        controller: &'a Controller,
        parameters: ParameterChoice,
        most_steps: u64,
    ) -> Self {
        Self {
            controller,
            motion: Motion::Mode { problem, parameters, noise: Noise::of_inputs(problem.noise()) },
            inputs: problem.set().map(InputCheck::new),
            witness: Witness::new(problem.objective(), problem.unsafe_regions()),
            avoid: vec![],
            avoids_outside: false,
            most_steps: problem.horizon().unwrap_or(most_steps),
        }
    }

    /// Run number `run` from `start`: the same for the same seed.
    pub fn run(&self, start: &[f64], seed: u64, run: u64) -> RunOutcome {
        self.watch(start, seed, run, |_| {})
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
                        tally.add(self.observe(start, (seed, run), scratch, progress, |_| {}));
                    }
                    progress.advance(last - first);
                    tally
                },
            )
            .reduce(Tally::default, Tally::merge);
        progress.finish();
        tally
    }

    /// Run number `run` from `start` with an observer that keeps of it what it wants: the run that [`run`](Self::run) and
    /// [`tally`](Self::tally) count under this number and seed.
    pub fn watch(&self, start: &[f64], seed: u64, run: u64, see: impl FnMut(Moment<'_>)) -> RunOutcome {
        self.observe(start, (seed, run), &mut self.scratch(), &(), see)
    }

    /// The same; it ends early, unfinished, when `progress` is interrupted.
    pub(super) fn watch_until(
        &self,
        start: &[f64],
        numbers: (u64, u64),
        progress: &dyn Progress,
        see: impl FnMut(Moment<'_>),
    ) -> RunOutcome {
        self.observe(start, numbers, &mut self.scratch(), progress, see)
    }

    /// The run from `start` with the noise of every group of steps written by `draw`.
    pub(super) fn with_noise(&self, start: &[f64], run: u64, draw: impl FnMut(&mut [f64])) -> RunOutcome {
        let mut draw = draw;
        let draw = |_: &mut ChaCha12Rng, noise: &mut [f64]| draw(noise);
        self.observe_with(start, (0, run), (&mut self.scratch(), &()), draw, |_| {})
    }

    fn scratch(&self) -> Scratch {
        let (n, d) = (self.controller.state_dimension(), self.controller.group_steps());
        Scratch {
            x: vec![0.0; n],
            next: vec![0.0; n],
            grouped: vec![0.0; n],
            u: vec![0.0; self.controller.inputs()],
            noise: vec![0.0; n * d],
            numbers: vec![],
        }
    }

    fn observe(
        &self,
        start: &[f64],
        numbers: (u64, u64),
        scratch: &mut Scratch,
        progress: &dyn Progress,
        see: impl FnMut(Moment<'_>),
    ) -> RunOutcome {
        let draw = |rng: &mut ChaCha12Rng, noise: &mut [f64]| self.motion.draw(rng, noise);
        self.observe_with(start, numbers, (scratch, progress), draw, see)
    }

    fn observe_with(
        &self,
        start: &[f64],
        (seed, run): (u64, u64),
        (scratch, progress): (&mut Scratch, &dyn Progress),
        mut draw: impl FnMut(&mut ChaCha12Rng, &mut [f64]),
        mut see: impl FnMut(Moment<'_>),
    ) -> RunOutcome {
        let (n, p) = (self.controller.state_dimension(), self.controller.step_inputs());
        let d = self.controller.group_steps();
        let mut rng = ChaCha12Rng::seed_from_u64(seed);
        rng.set_stream(run);
        let Scratch { x, next, grouped, u, noise, numbers } = scratch;
        x.copy_from_slice(start);
        self.controller.wrap(x);
        let (mut seen, mut memory) = (self.witness.start(), RunMemory::default());
        let mut outcome = RunOutcome::begin();
        loop {
            self.witness.see(&mut seen, x);
            let decision = self.controller.control(x, outcome.steps, &mut memory, u);
            let step = outcome.steps * d as u64;
            let is_given_up = outcome.steps >= self.most_steps
                || outcome.steps.is_multiple_of(STEPS_BETWEEN_QUESTIONS) && progress.is_interrupted();
            if !matches!(decision, Decision::Act { .. }) || is_given_up {
                see(Moment { step, x, u: None, decision: Some(decision) });
                outcome.end = End::from(decision);
                outcome.satisfied_at_instants = self.witness.is_satisfied(&seen, outcome.end);
                outcome.satisfied = outcome.satisfied_at_instants && !outcome.unsafe_between;
                return outcome;
            }
            draw(&mut rng, noise);
            grouped.copy_from_slice(x);
            for i in 0..d {
                let u = &u[i * p..(i + 1) * p];
                let step = step + i as u64;
                if let Some((half_space, excess)) = self.inputs.as_ref().and_then(|set| set.violation(u)) {
                    outcome.violations += 1;
                    let (state, input) = (grouped.clone(), u.to_vec());
                    let violation = Violation { run, step, state, input, half_space, excess };
                    outcome.first_violation.get_or_insert(violation);
                }
                let decision = (i == 0).then_some(decision);
                see(Moment { step, x, u: Some(u), decision });
                let noise = &noise[i * n..(i + 1) * n];
                self.motion.step(
                    self.controller,
                    (&x[..], u, noise),
                    &mut rng,
                    (&mut *numbers, &mut next[..]),
                );
                std::mem::swap(x, next);
                outcome.unsafe_between |= !seen.is_decided() && i + 1 < d && self.is_unsafe(x);
            }
            outcome.steps += 1;
        }
    }

    /// Whether a state between grouped instants is unsafe.
    fn is_unsafe(&self, x: &[f64]) -> bool {
        self.avoid.iter().any(|region| region.contains(x))
            || self.avoids_outside && self.controller.cell(x).is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::abstraction::{Abstraction, compile};
    use crate::controller::law::Law;
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
        let noise = Noise::of_plant(problem.noise());
        let tally = |controller: &Controller| {
            Simulation::new(&problem, controller, noise.clone(), 0).tally(&[2.0], 1, 1000, &())
        };
        let sound = tally(&controller);
        assert_eq!((sound.violations, &sound.first_violation), (0, &None));
        let Law::Steering(law) = &mut controller.law else { panic!("actions are targets") };
        law.constant[0] += 0.5;
        let broken = tally(&controller);
        let first = broken.first_violation.unwrap();
        assert!(broken.violations >= 1000 && first.run == 0 && first.step == 0 && first.state == [2.0]);
        assert!(first.input[0] > 1.75 && (first.excess - (first.input[0] - 1.75)).abs() < 1e-15);
    }
}
