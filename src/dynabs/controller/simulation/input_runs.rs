//! The closed loop of a problem whose actions are inputs: the true system, with noise drawn from its distributions.

use super::input_check::{InputCheck, Violation};
use super::runs::{End, RunOutcome};
use super::witness::Witness;
use super::{Tally, Trajectory, TrajectoryStep};
use crate::controller::{Decision, InputController, RunMemory};
use crate::problem::InputProblem;
use imdp::progress::Progress;
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha12Rng;
use rayon::prelude::*;

/// How parameters are picked at every step, each from its interval.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ParameterChoice {
    /// Uniformly.
    #[default]
    Random,
    /// Either end of each interval, by chance.
    Corners,
    /// The ends that lead, with the noise of the step, to the state with the least bound.
    Adversarial,
}

/// A closed loop that can be simulated.
#[derive(Clone, Debug)]
pub struct InputSimulation<'a> {
    problem: &'a InputProblem,
    controller: &'a InputController,
    inputs: Option<InputCheck>,
    witness: Witness<'a>,
    parameters: ParameterChoice,
    most_steps: u64,
}

/// Runs per parallel task.
const RUNS_PER_TASK: u64 = 64;

/// With more parameters an adversary looks at this many of them only.
const MOST_ADVERSARIAL: usize = 8;

impl<'a> InputSimulation<'a> {
    /// The loop of a problem, closed with its controller; runs of unbounded tasks are given up after `most_steps`.
    pub fn new(
        problem: &'a InputProblem,
        controller: &'a InputController,
        parameters: ParameterChoice,
        most_steps: u64,
    ) -> Self {
        Self {
            problem,
            controller,
            inputs: problem.set().map(InputCheck::new),
            witness: Witness::new(problem.objective(), problem.unsafe_regions()),
            parameters,
            most_steps: problem.horizon().unwrap_or(most_steps),
        }
    }

    /// Runs `0 .. runs` from `start`, in parallel; the result does not depend on the number of threads.
    ///
    /// Stops early, with fewer runs, when `progress` is interrupted.
    pub fn tally(&self, start: &[f64], seed: u64, runs: u64, progress: &dyn Progress) -> Tally {
        progress.start("simulation", runs);
        let task = |task: u64| {
            let mut tally = Tally::default();
            if progress.is_interrupted() {
                return tally;
            }
            let first = task * RUNS_PER_TASK;
            let last = (first + RUNS_PER_TASK).min(runs);
            (first..last).for_each(|run| tally.add(self.observe(start, seed, run, |_| {})));
            progress.advance(last - first);
            tally
        };
        let tasks = (0..runs.div_ceil(RUNS_PER_TASK)).into_par_iter();
        let tally = tasks.map(task).reduce(Tally::default, Tally::merge);
        progress.finish();
        tally
    }

    /// Run number `run` from `start`, step by step: the one that [`tally`](Self::tally) counts under this number and seed.
    pub fn trajectory(&self, start: &[f64], seed: u64, run: u64) -> Trajectory {
        let mut steps = Vec::new();
        let outcome = self.observe(start, seed, run, |step| steps.push(step));
        Trajectory { run, steps, outcome }
    }

    fn observe(&self, start: &[f64], seed: u64, run: u64, mut see: impl FnMut(TrajectoryStep)) -> RunOutcome {
        let mut rng = ChaCha12Rng::seed_from_u64(seed);
        rng.set_stream(run);
        let mut x = start.to_vec();
        self.controller.wrap(&mut x);
        let mut u = vec![0.0; self.controller.num_inputs()];
        let mut scratch = Vec::new();
        let (mut seen, mut memory) = (self.witness.start(), RunMemory::default());
        let mut outcome = RunOutcome {
            end: End::Unfinished,
            satisfied: false,
            satisfied_at_instants: false,
            unsafe_between: false,
            steps: 0,
            violations: 0,
            first_violation: None,
        };
        loop {
            self.witness.see(&mut seen, &x);
            let decision = self.controller.control(&x, outcome.steps, &mut memory, &mut u);
            let goes_on = matches!(decision, Decision::Apply { .. });
            let applied = goes_on && outcome.steps < self.most_steps;
            let input = applied.then(|| u.clone());
            see(TrajectoryStep { step: outcome.steps, state: x.clone(), input, decision: Some(decision) });
            if !applied {
                let end = match decision {
                    Decision::Apply { .. } | Decision::Steer { .. } => End::Unfinished,
                    Decision::Reached => End::Reached,
                    Decision::Unsafe => End::Unsafe,
                    Decision::Outside => End::Outside,
                    Decision::NoAction => End::NoAction,
                    Decision::Over => End::Over,
                };
                let satisfied = self.witness.is_satisfied(&seen, end);
                return RunOutcome { end, satisfied, satisfied_at_instants: satisfied, ..outcome };
            }
            if let Some((half_space, excess)) = self.inputs.as_ref().and_then(|inputs| inputs.violation(&u)) {
                outcome.violations += 1;
                let (step, state, input) = (outcome.steps, x.clone(), u.clone());
                outcome.first_violation.get_or_insert(Violation {
                    run,
                    step,
                    state,
                    input,
                    half_space,
                    excess,
                });
            }
            x = self.step(&x, &u, &mut rng, &mut scratch);
            outcome.steps += 1;
        }
    }

    /// The next state, its periodic coordinates in the partition.
    fn step(&self, x: &[f64], u: &[f64], rng: &mut impl Rng, scratch: &mut Vec<f64>) -> Vec<f64> {
        let draw = |noise: &Option<crate::noise::known::Distribution>| {
            noise.as_ref().map_or(0.0, |noise| noise.draw(rng))
        };
        let noise: Vec<f64> = self.problem.noise().iter().map(draw).collect();
        let boxes = self.problem.mode().parameters();
        let mut go = |parameters: &[f64]| {
            let mut next = vec![0.0; x.len()];
            self.problem.mode().step(x, u, parameters, scratch, &mut next);
            next.iter_mut().zip(&noise).for_each(|(x, noise)| *x += noise);
            self.controller.wrap(&mut next);
            next
        };
        let corner = |corner: usize| -> Vec<f64> {
            let end = |(i, p): (usize, &crate::system::Interval)| {
                if corner >> i & 1 == 0 { p.lower() } else { p.upper() }
            };
            boxes.iter().enumerate().map(end).collect()
        };
        match self.parameters {
            _ if boxes.is_empty() => go(&[]),
            ParameterChoice::Random => {
                let parameters: Vec<f64> =
                    boxes.iter().map(|p| p.lower() + rng.random::<f64>() * (p.upper() - p.lower())).collect();
                go(&parameters)
            }
            ParameterChoice::Corners => {
                let which: u64 = rng.random();
                go(&corner(which as usize & ((1 << boxes.len().min(60)) - 1)))
            }
            ParameterChoice::Adversarial => {
                let corners = 0..1usize << boxes.len().min(MOST_ADVERSARIAL);
                let states = corners.map(|which| go(&corner(which)));
                let worst =
                    states.min_by(|a, b| self.controller.bound_at(a).total_cmp(&self.controller.bound_at(b)));
                worst.unwrap_or_else(|| x.to_vec())
            }
        }
    }
}
