//! States to ask controllers in, and what the library answers.

use dynabs::abstraction::compile;
use dynabs::abstraction::inputs::InputAbstraction;
use dynabs::controller::{Controller, RunMemory};
use dynabs::model_file::{Document, StatedProblem};
use dynabs::partition::Grid;
use imdp::numeric::to_f64;
use imdp::solver::{Answer, SolverOptions};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha12Rng;

/// A controller of a model.
pub struct Exported {
    pub name: String,
    pub controller: Controller,
    grid: Grid,
}

/// A status, and the inputs if there are some.
pub type Answered = (u32, Vec<f64>);

/// Looks of many runs at once, round by round.
pub struct Looks {
    pub runs: usize,
    pub rounds: Vec<Round>,
}

/// The states of all runs, and the steps elapsed.
pub struct Round {
    pub states: Vec<Vec<f64>>,
    pub elapsed: Vec<u32>,
}

/// How many steps a run of [`Exported::step_by_step`] has, and all of them together.
pub const RUN: usize = 12;
pub const STEPS: usize = 3_000;

impl Exported {
    pub fn of(document: &Document) -> Self {
        match document.stated().unwrap() {
            StatedProblem::Targets(problem) => {
                let abstraction = compile(&problem, &()).unwrap();
                let options = SolverOptions { policy: true, ..SolverOptions::default() };
                let answer = Answer::new(&abstraction.model, &abstraction.property, &options).unwrap();
                Self {
                    name: problem.name().to_owned(),
                    controller: Controller::new(&problem, &abstraction, &answer).unwrap(),
                    grid: problem.grid().clone(),
                }
            }
            StatedProblem::Inputs(problem) => {
                let abstraction = InputAbstraction::new(&problem).unwrap();
                let solution = abstraction.question().solve(&SolverOptions::default());
                Self {
                    name: problem.name().to_owned(),
                    controller: Controller::of_inputs(&problem, &abstraction, &solution),
                    grid: problem.grid().clone(),
                }
            }
        }
    }

    /// Random states in and around the partition, on faces and just below, infinite ones and none; some far away.
    pub fn looks(&self, runs: usize, rounds: usize, seed: u64) -> Looks {
        let mut rng = ChaCha12Rng::seed_from_u64(seed);
        let horizon = self.controller.horizon().unwrap_or(1);
        let round = |_| Round {
            states: (0..runs).map(|_| self.state(&mut rng)).collect(),
            elapsed: (0..runs).map(|_| (rng.next_u64() % (horizon + 2)) as u32).collect(),
        };
        Looks { runs, rounds: (0..rounds).map(round).collect() }
    }

    fn state(&self, rng: &mut ChaCha12Rng) -> Vec<f64> {
        let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -0.0, 0.0, 1e300, -1e300, 5e-324];
        let within = !rng.next_u64().is_multiple_of(8);
        let coordinate = |axis: &dynabs::partition::GridAxis| {
            let (lower, upper) = (to_f64(axis.lower()), to_f64(axis.upper()));
            let face = to_f64(&axis.face((rng.next_u64() % (u64::from(axis.cells()) + 1)) as u32));
            let unit = (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64;
            match rng.next_u64() % 40 {
                0 | 1 => face,
                2 => face.next_down(),
                3 if !within => odd[(rng.next_u64() % 8) as usize],
                4 if !within => lower + (unit * 9.0 - 4.0) * (upper - lower),
                _ if within => lower + unit * (upper - lower),
                _ => lower + (unit * 1.1 - 0.05) * (upper - lower),
            }
        };
        self.grid.axes().iter().map(coordinate).collect()
    }

    /// What the library does at every look.
    pub fn answers(&self, looks: &Looks) -> Vec<Answered> {
        let mut memories = vec![RunMemory::default(); looks.runs];
        let mut answers = vec![];
        // Without an automaton there is nothing to remember but that a run has ended: every look is one of its own.
        let has_memory = self.controller.task().letters().is_some();
        for round in &looks.rounds {
            if !has_memory {
                memories.fill(RunMemory::default());
            }
            for ((x, &k), memory) in round.states.iter().zip(&round.elapsed).zip(&mut memories) {
                let mut u = vec![f64::NAN; self.controller.inputs()];
                let decision = self.controller.control(x, u64::from(k), memory, &mut u);
                answers.push((decision.status().into(), u));
            }
        }
        answers
    }

    /// What it does step by step in runs of [`RUN`] steps: the state is looked at once in `d` of them, and when the run has
    /// ended the last input is kept, 0 at first.
    pub fn step_by_step(&self, looks: &Looks) -> Vec<Answered> {
        let (d, p) = (self.controller.group_steps(), self.controller.step_inputs());
        let states: Vec<&Vec<f64>> = looks.rounds[0].states.iter().take(STEPS).collect();
        let mut answers = vec![];
        for run in states.chunks(RUN) {
            let (mut memory, mut ended, mut u) = (RunMemory::default(), 0, vec![0.0; d * p]);
            let mut input = vec![0.0; p];
            for (step, x) in run.iter().enumerate() {
                if ended == 0 && step % d == 0 {
                    ended =
                        self.controller.control(x, (step / d) as u64, &mut memory, &mut u).status().into();
                }
                if ended == 0 {
                    input = u[step % d * p..(step % d + 1) * p].to_vec();
                }
                answers.push((ended, input.clone()));
            }
        }
        answers
    }
}

impl Looks {
    /// Per round the states, one after the other, and the steps elapsed.
    pub fn bytes(&self) -> Vec<u8> {
        let mut bytes = vec![];
        for round in &self.rounds {
            bytes.extend(round.states.iter().flatten().flat_map(|x| x.to_le_bytes()));
            bytes.extend(round.elapsed.iter().flat_map(|k| k.to_le_bytes()));
        }
        bytes
    }
}
