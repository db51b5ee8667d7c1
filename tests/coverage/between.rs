//! Two steps grouped, two layers, and something unsafe in between: the truth by enumeration.
//!
//! `x⁺ = A x + B u + η`. The noise of a step takes a few values, so that the law of both steps together is known exactly.
//! Rarely it kicks the velocity. A kick has faded when the second step ends, but in between it may be beyond the limit: noise
//! that is harmless at the end and not on the way.

use dynabs::abstraction::{Abstraction, compile};
use dynabs::guarantee::Safety;
use dynabs::partition::{CellId, CellKind};
use dynabs::problem::{
    Gain, GivenSamples, InputSet, LinearDynamics, LowerLayer, Partition, Probabilities, Problem, RegionBox,
    SampleKind, Task,
};
use imdp::model::{Row, StateId};
use imdp::numeric::to_f64;
use imdp::solver::{Answer, SolverOptions};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha12Rng;
use std::collections::BTreeMap;
use std::ops::AddAssign;

const A: [[f64; 2]; 2] = [[1.0, 0.2], [0.0, 0.1]];
const B: [f64; 2] = [0.1, 1.0];
/// Velocities from here on are unsafe, at every step.
const LIMIT: f64 = 2.5;
const CELLS: [u32; 2] = [12, 4];
const LOWER: [f64; 2] = [-3.0, -1.0];
const WIDTH: f64 = 0.5;
const HORIZON: u64 = 6;
/// How likely a kick is, and how strong.
const KICK: (f64, f64) = (0.05, 2.0);
/// Kicks are few: leaving out this many samples leaves most of them outside of windows.
const DISCARD: u64 = 18;
/// Allowance for rounding.
const ROUNDING: f64 = 1e-12;

/// In how many replications something was not as promised.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct BetweenFailures {
    /// Some row excludes the truth, from some state of a cell in which its action is enabled.
    pub rows: u64,
    /// The value of some cell is above what its policy can be brought to by the worst of these states, step by step.
    pub values: u64,
    /// Control: the same for rows of the old statement, which looks at grouped instants only.
    pub rows_at_instants: u64,
    /// Control: rows whose lower bounds are those of the noise, not of the noise inside of windows.
    pub without_condition: u64,
}

impl AddAssign for BetweenFailures {
    fn add_assign(&mut self, other: Self) {
        self.rows += other.rows;
        self.values += other.values;
        self.rows_at_instants += other.rows_at_instants;
        self.without_condition += other.without_condition;
    }
}

/// The noise of one step: values with their probabilities.
struct Law {
    atoms: Vec<([f64; 2], f64)>,
}

impl Law {
    fn new() -> Self {
        let mut random = ChaCha12Rng::seed_from_u64(77);
        let mut small = || [0.35, 0.2].map(|size: f64| size * random.random_range(-1.0..1.0));
        let number = 16;
        let mut atoms: Vec<_> = (0..number).map(|_| (small(), (1.0 - KICK.0) / f64::from(number))).collect();
        atoms.push(([0.0131, KICK.1], KICK.0));
        Self { atoms }
    }

    fn draw(&self, random: &mut ChaCha12Rng) -> [f64; 2] {
        let mut left: f64 = random.random_range(0.0..1.0);
        for (atom, probability) in &self.atoms {
            left -= probability;
            if left < 0.0 {
                return *atom;
            }
        }
        self.atoms[0].0
    }

    /// Per first atom, how many cells both steps together move by, with what probability.
    fn offsets(&self) -> Vec<BTreeMap<[i64; 2], f64>> {
        let offset = |first: &[f64; 2], second: &[f64; 2]| {
            let sum = [0, 1].map(|j| A[j][0] * first[0] + A[j][1] * first[1] + second[j]);
            sum.map(|x| (x / WIDTH + 0.5).floor() as i64)
        };
        let of_first = |(first, p): &([f64; 2], f64)| {
            let mut offsets = BTreeMap::new();
            for (second, q) in &self.atoms {
                *offsets.entry(offset(first, second)).or_insert(0.0) += p * q;
            }
            offsets
        };
        self.atoms.iter().map(of_first).collect()
    }
}

fn problem(samples: Vec<f64>, safety: Safety, beta: f64) -> Problem {
    let infinite = f64::INFINITY;
    let dynamics = LinearDynamics { a: A.map(Vec::from).to_vec(), b: B.map(|b| vec![b]).to_vec(), q: None };
    let goal = RegionBox { lower: vec![1.0, -1.0], upper: vec![2.0, 1.0] };
    let fast = RegionBox { lower: vec![-infinite, LIMIT], upper: vec![infinite, infinite] };
    Problem::builder(dynamics, InputSet::Box { lower: vec![-4.0], upper: vec![4.0] })
        .lower_layer(LowerLayer {
            gain: Gain::Given(vec![vec![0.2, 0.1], vec![0.0, 0.05]]),
            about: None,
            abstract_input: InputSet::Box { lower: vec![-3.5; 2], upper: vec![3.5; 2] },
        })
        .partition(Partition { lower: LOWER.into(), upper: vec![3.0, 1.0], cells: CELLS.into() })
        .task(Task::reach(vec![goal]).avoiding(vec![fast]).within(HORIZON).checked(safety))
        .probabilities(Probabilities::with_beta(beta).unwrap().discarding(DISCARD))
        .noise(GivenSamples { values: samples, of: SampleKind::Step })
        .build()
        .unwrap()
}

/// The velocity after one step from `x` to the target `d`, but for the noise.
fn velocity(x: [f64; 2], d: [f64; 2]) -> f64 {
    // d − A²x = [AB B] u.
    let rest = [d[0] - x[0] - (A[0][1] + A[0][1] * A[1][1]) * x[1], d[1] - A[1][1] * A[1][1] * x[1]];
    let ab = [B[0] + A[0][1] * B[1], A[1][1] * B[1]];
    let first = (rest[0] * B[1] - B[0] * rest[1]) / (ab[0] * B[1] - B[0] * ab[1]);
    A[1][1] * x[1] + B[1] * first
}

/// The truth about an action from a state: the probability of every cell, nothing unsafe being met on the way.
fn truth(law: &Law, offsets: &[BTreeMap<[i64; 2], f64>], velocity: f64, target: [i64; 2]) -> Vec<f64> {
    let mut cells = vec![0.0; (CELLS[0] * CELLS[1]) as usize];
    for ((atom, _), offsets) in law.atoms.iter().zip(offsets) {
        if velocity + atom[1] >= LIMIT {
            continue;
        }
        for (offset, p) in offsets {
            let place = [0, 1].map(|j| target[j] + offset[j]);
            if (0..2).all(|j| (0..i64::from(CELLS[j])).contains(&place[j])) {
                cells[(place[0] * i64::from(CELLS[1]) + place[1]) as usize] += p;
            }
        }
    }
    cells
}

struct Experiment {
    law: Law,
    offsets: Vec<BTreeMap<[i64; 2], f64>>,
}

impl Experiment {
    fn new() -> Self {
        let law = Law::new();
        Self { offsets: law.offsets(), law }
    }

    /// The truth from the corners of a cell: where the velocity in between is most and least.
    fn truths(&self, problem: &Problem, cell: CellId, target: usize) -> Vec<Vec<f64>> {
        let grid = problem.grid();
        let center = |cell: CellId| [0, 1].map(|j| to_f64(&grid.axes()[j].center(grid.coordinate(cell, j))));
        let target = CellId(target as u32);
        let (c, d) = (center(cell), center(target));
        let place = [0, 1].map(|j| i64::from(grid.coordinate(target, j)));
        let half = 0.5 * WIDTH * (1.0 - 1e-9);
        let corners = [[-half, -half], [-half, half], [half, -half], [half, half], [0.0, 0.0]];
        let at = |corner: &[f64; 2]| velocity([c[0] + corner[0], c[1] + corner[1]], d);
        corners.iter().map(|corner| truth(&self.law, &self.offsets, at(corner), place)).collect()
    }

    /// Whether some row excludes the truth, from some state in which its action is enabled.
    fn is_violated(&self, problem: &Problem, abstraction: &Abstraction, row_of: &Abstraction) -> bool {
        problem.labels().iter().filter(|(_, kind)| *kind == CellKind::Ordinary).any(|(cell, _)| {
            let state = abstraction.state_of_cell[cell.index()];
            abstraction.model.choices().rows(state).any(|row| {
                let truths = self.truths(problem, cell, row.index());
                let row = row_of.model.rows().row(row);
                truths.iter().any(|truth| excludes(problem, abstraction, &row, truth))
            })
        })
    }

    /// What the policy is worth, from the worst corner of each cell at every step.
    fn worst_values(&self, problem: &Problem, abstraction: &Abstraction, answer: &Answer) -> Vec<f64> {
        let kinds: Vec<CellKind> = problem.labels().iter().map(|(_, kind)| kind).collect();
        let policy = answer.solution.policy.as_ref().unwrap();
        let mut values: Vec<f64> =
            kinds.iter().map(|kind| f64::from(u8::from(*kind == CellKind::Goal))).collect();
        for elapsed in (0..problem.horizon().unwrap()).rev() {
            let of_cell = |cell: usize| {
                let state = abstraction.state_of_cell[cell];
                let row = policy.row(abstraction.model.choices(), state, elapsed)?;
                let truths = self.truths(problem, CellId(cell as u32), row.index());
                let worth = |truth: &Vec<f64>| truth.iter().zip(&values).map(|(p, v)| p * v).sum::<f64>();
                Some(truths.iter().map(worth).fold(f64::INFINITY, f64::min))
            };
            let next = (0..values.len()).map(|cell| match kinds[cell] {
                CellKind::Goal => 1.0,
                CellKind::Unsafe => 0.0,
                CellKind::Ordinary => of_cell(cell).unwrap_or(0.0),
            });
            values = next.collect();
        }
        values
    }
}

/// Whether a row excludes the truth after moving to `failed` what it does not list.
fn excludes(problem: &Problem, abstraction: &Abstraction, row: &Row<'_>, truth: &[f64]) -> bool {
    let mut of_state = vec![0.0; abstraction.model.num_states()];
    for (cell, _) in problem.labels().iter() {
        of_state[abstraction.state_of_cell[cell.index()].index()] += truth[cell.index()];
    }
    let listed: f64 = row.successors.iter().filter(|&&s| s != StateId(0)).map(|&s| of_state[s.index()]).sum();
    of_state[0] = 1.0 - listed;
    row.successors.iter().enumerate().any(|(i, &state)| {
        let p = of_state[state.index()];
        p < row.lower[i] - ROUNDING || p > row.upper[i] + ROUNDING
    })
}

/// Abstracts, solves and compares with the truth: `samples` groups of two steps.
pub fn replicate(samples: usize, beta: f64, seed: u64) -> BetweenFailures {
    let experiment = Experiment::new();
    let mut random = ChaCha12Rng::seed_from_u64(seed);
    let noise: Vec<f64> = (0..2 * samples).flat_map(|_| experiment.law.draw(&mut random)).collect();
    let every_step = problem(noise.clone(), Safety::EveryStep, beta);
    let at_instants = problem(noise, Safety::GroupedInstants, beta);
    let (strict, old) = (compile(&every_step, &()).unwrap(), compile(&at_instants, &()).unwrap());
    let options = SolverOptions { policy: true, ..SolverOptions::default() };
    let answer = Answer::new(&strict.model, &strict.property, &options).unwrap();
    let worst = experiment.worst_values(&every_step, &strict, &answer);
    let is_overstated =
        |(worst, state): (&f64, &StateId)| answer.values.lower[state.index()] > worst + ROUNDING;
    BetweenFailures {
        rows: u64::from(experiment.is_violated(&every_step, &strict, &strict)),
        values: u64::from(worst.iter().zip(&strict.state_of_cell).any(is_overstated)),
        rows_at_instants: u64::from(experiment.is_violated(&at_instants, &old, &old)),
        without_condition: u64::from(experiment.is_violated(&every_step, &strict, &old)),
    }
}

/// How much is promised: the best value of an ordinary cell, so that the experiment is about something.
pub fn best_value(samples: usize, beta: f64, seed: u64) -> f64 {
    let experiment = Experiment::new();
    let mut random = ChaCha12Rng::seed_from_u64(seed);
    let noise: Vec<f64> = (0..2 * samples).flat_map(|_| experiment.law.draw(&mut random)).collect();
    let problem = problem(noise, Safety::EveryStep, beta);
    let abstraction = compile(&problem, &()).unwrap();
    let answer = Answer::new(&abstraction.model, &abstraction.property, &SolverOptions::default()).unwrap();
    let ordinary = problem.labels().iter().filter(|(_, kind)| *kind == CellKind::Ordinary);
    ordinary
        .map(|(cell, _)| answer.values.lower[abstraction.state_of_cell[cell.index()].index()])
        .fold(0.0, f64::max)
}
