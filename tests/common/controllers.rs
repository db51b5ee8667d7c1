//! Controllers of shipped models, and states to try them in.

use dynabs::abstraction::{Abstraction, compile};
use dynabs::controller::Controller;
use dynabs::problem::Problem;
use imdp::numeric::to_f64;
use imdp::solver::{Answer, SolverOptions};
use rand::Rng;
use rand_chacha::ChaCha12Rng;

/// A problem with everything that comes of it.
pub struct Loop {
    pub problem: Problem,
    pub abstraction: Abstraction,
    pub answer: Answer,
    pub controller: Controller,
}

impl Loop {
    pub fn new(problem: Problem) -> Self {
        let abstraction = compile(&problem, &()).unwrap();
        let options = SolverOptions { policy: true, ..SolverOptions::default() };
        let answer = Answer::new(&abstraction.model, &abstraction.property, &options).unwrap();
        let controller = Controller::new(&problem, &abstraction, &answer).unwrap();
        Self { problem, abstraction, answer, controller }
    }

    pub fn of(model: &str, sets: &[&str]) -> Self {
        let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
        Self::new(super::problem(model, &sets).unwrap())
    }

    /// A random state in and a little around the partition, sometimes on faces.
    pub fn random_state(&self, rng: &mut ChaCha12Rng) -> Vec<f64> {
        let axes = self.problem.grid().axes().iter();
        axes.map(|axis| {
            let (lower, upper) = (to_f64(axis.lower()), to_f64(axis.upper()));
            match rng.next_u64() % 20 {
                0 => to_f64(&axis.face((rng.next_u64() % (u64::from(axis.cells()) + 1)) as u32)),
                _ => lower + (unit(rng) * 1.04 - 0.02) * (upper - lower),
            }
        })
        .collect()
    }
}

fn unit(rng: &mut ChaCha12Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}
