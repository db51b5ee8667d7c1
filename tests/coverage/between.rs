//! Two steps grouped, with one layer or two, and something unsafe in between: the truth by enumeration.
//!
//! `x⁺ = A x + B u + η`. The noise of a step takes a few values, so that the law of both steps together is known exactly.
//! Rarely it kicks the velocity. A kick has faded when the second step ends, but in between it may be beyond the limit: noise
//! that is harmless at the end and not on the way.
//!
//! Fixed in advance, so that the reasoning is needed:
//! - the small noise pushes back, by up to a cell, never ahead; only a kick in the first step ends in the cell ahead. Windows
//!   are symmetric and list that cell. All of its samples are kicked ones, and where a kick crosses the limit, none of its
//!   mass is to be promised: any lower bound from all samples is wrong there.
//! - of 188 samples 11 ± 3 are kicked. Twenty are discarded, so that windows know of no kick in 299 of 300 sample sets; and a seventh of the small ones reach back into the next cell, so that windows list it and its mirror image.

use dynabs::abstraction::{Abstraction, compile};
use dynabs::partition::{CellId, CellKind};
use dynabs::problem::{
    FeedbackLayer, Gain, GivenSamples, InputSet, LinearDynamics, LowerLayer, Partition, Probabilities,
    Problem, RegionBox, SampleKind, Task,
};
use dynabs::task::Safety;
use imdp::model::{Row, RowBuffer, RowId, StateId};
use imdp::solver::{Answer, SolverOptions};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha12Rng;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::AddAssign;

const A: [[f64; 2]; 2] = [[1.0, 0.25], [0.0, 0.1]];
const B: [f64; 2] = [0.1, 1.0];
/// Velocities from here on are unsafe, at every step.
const LIMIT: f64 = 2.5;
const CELLS: [u32; 2] = [12, 4];
const LOWER: [f64; 2] = [-3.0, -1.0];
const WIDTH: f64 = 0.5;
const HORIZON: u64 = 6;
/// The small noise of a step, position and velocity.
const SMALL: [[f64; 2]; 2] = [[-0.2, 0.08], [-0.1, 0.1]];
/// How likely a kick is, and how strong.
const KICK: (f64, f64) = (0.03, 2.0);
/// So many samples of two steps; twelve of them decide about the proportions of windows.
const GROUPS: usize = 200;
/// Leaving out this many samples leaves kicks outside of windows.
const DISCARD: u64 = 20;
/// Allowance for rounding.
const ROUNDING: f64 = 1e-12;

/// Layers of feedback.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layers {
    One,
    Two,
}

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

/// The noise of one step: values with their probabilities, the largest velocities first.
struct Law {
    atoms: Vec<([f64; 2], f64)>,
}

impl Law {
    fn new() -> Self {
        let mut random = ChaCha12Rng::seed_from_u64(77);
        let mut small = || SMALL.map(|[low, high]| random.random_range(low..high));
        let number = 16;
        let mut atoms: Vec<_> = (0..number).map(|_| (small(), (1.0 - KICK.0) / f64::from(number))).collect();
        atoms.push(([0.0131, KICK.1], KICK.0));
        atoms.sort_by(|(a, _), (b, _)| b[1].total_cmp(&a[1]));
        Self { atoms }
    }

    fn sample(&self, steps: usize, seed: u64) -> Vec<f64> {
        let mut random = ChaCha12Rng::seed_from_u64(seed);
        (0..steps).flat_map(|_| self.draw(&mut random)).collect()
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

fn problem(layers: Layers, samples: Vec<f64>, safety: Safety, beta: f64) -> Problem {
    let infinite = f64::INFINITY;
    let dynamics = LinearDynamics { a: A.map(Vec::from).to_vec(), b: B.map(|b| vec![b]).to_vec(), q: None };
    let goal = RegionBox { lower: vec![1.0, -1.0], upper: vec![2.0, 1.0] };
    let fast = RegionBox { lower: vec![-infinite, LIMIT], upper: vec![infinite, infinite] };
    let builder = Problem::builder(dynamics, InputSet::Box { lower: vec![-4.0], upper: vec![4.0] });
    let builder = match layers {
        Layers::One => builder,
        // With about half of the actions of one layer.
        Layers::Two => builder.lower_layer(LowerLayer::Feedback(FeedbackLayer {
            gain: Gain::Given(vec![vec![0.2, 0.1], vec![0.0, 0.05]]),
            about: None,
            abstract_input: InputSet::Box { lower: vec![-2.0; 2], upper: vec![2.0; 2] },
        })),
    };
    builder
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

/// Everything that is true whatever the samples are.
pub struct Experiment {
    law: Law,
    /// Per target and number of first atoms that cross the limit, the probability of every cell, nothing unsafe being met on
    /// the way.
    truths: Vec<Vec<Vec<f64>>>,
    /// Per cell and target, how many of the first atoms cross the limit, from some corners of the cell.
    crossing: Vec<Vec<Vec<usize>>>,
}

impl Experiment {
    pub fn new() -> Self {
        let law = Law::new();
        let offsets = law.offsets();
        let cells = || (0..CELLS[0]).flat_map(|i| (0..CELLS[1]).map(move |j| [i, j]));
        let of_target =
            |target| (0..=law.atoms.len()).map(|crossing| truth(&offsets[crossing..], target)).collect();
        let truths = cells().map(of_target).collect();
        let crossing =
            cells().map(|cell| cells().map(|target| crossing(&law, cell, target)).collect()).collect();
        Self { truths, crossing, law }
    }

    /// The truths from the corners of a cell.
    fn truths(&self, cell: CellId, target: usize) -> impl Iterator<Item = &Vec<f64>> {
        self.crossing[cell.index()][target].iter().map(move |&crossing| &self.truths[target][crossing])
    }

    /// Whether some row excludes the truth, from some state in which its action is enabled.
    fn is_violated(&self, problem: &Problem, enabling: &Abstraction, row_of: &Abstraction) -> bool {
        problem.labels().iter().filter(|(_, kind)| *kind == CellKind::Ordinary).any(|(cell, _)| {
            let state = enabling.state_of_cell[cell.index()];
            enabling.model.choices().rows(state).any(|row| {
                let target = target_cell(enabling, row);
                let mut truths = self.truths(cell, target);
                let has_row = row.index() < row_of.targets.len();
                let buffer = &mut RowBuffer::default();
                let row = if has_row { row } else { RowId::from_index(target) };
                let row = row_of.model.rows().row(row, buffer);
                truths.any(|truth| excludes(problem, row_of, &row, truth))
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
                let truths = self.truths(CellId(cell as u32), target_cell(abstraction, row));
                let worth = |truth: &Vec<f64>| truth.iter().zip(&values).map(|(p, v)| p * v).sum::<f64>();
                Some(truths.map(worth).fold(f64::INFINITY, f64::min))
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

    /// Abstracts, solves and compares with the truth.
    pub fn replicate(&self, layers: Layers, beta: f64, seed: u64) -> BetweenFailures {
        let noise = self.law.sample(2 * GROUPS, seed);
        let every_step = problem(layers, noise.clone(), Safety::EveryStep, beta);
        let at_instants = problem(layers, noise, Safety::GroupedInstants, beta);
        let (strict, old) = (compile(&every_step, &()).unwrap(), compile(&at_instants, &()).unwrap());
        let options = SolverOptions { policy: true, ..SolverOptions::default() };
        let answer = Answer::new(&strict.model, &strict.property, &options).unwrap();
        let worst = self.worst_values(&every_step, &strict, &answer);
        let is_overstated =
            |(worst, state): (&f64, &StateId)| answer.values.lower[state.index()] > worst + ROUNDING;
        BetweenFailures {
            rows: u64::from(self.is_violated(&every_step, &strict, &strict)),
            values: u64::from(worst.iter().zip(&strict.state_of_cell).any(is_overstated)),
            rows_at_instants: u64::from(self.is_violated(&at_instants, &old, &old)),
            without_condition: u64::from(self.is_violated(&every_step, &strict, &old)),
        }
    }

    /// How much is promised: the best value of an ordinary cell, so that the experiment is about something.
    pub fn best_value(&self, layers: Layers, beta: f64, seed: u64) -> f64 {
        let problem = problem(layers, self.law.sample(2 * GROUPS, seed), Safety::EveryStep, beta);
        let abstraction = compile(&problem, &()).unwrap();
        assert!(abstraction.targets.len() > grid_cells(), "rows with room in between take part");
        let answer =
            Answer::new(&abstraction.model, &abstraction.property, &SolverOptions::default()).unwrap();
        let ordinary = problem.labels().iter().filter(|(_, kind)| *kind == CellKind::Ordinary);
        ordinary
            .map(|(cell, _)| answer.values.lower[abstraction.state_of_cell[cell.index()].index()])
            .fold(0.0, f64::max)
    }
}

fn grid_cells() -> usize {
    (CELLS[0] * CELLS[1]) as usize
}

/// The cell that the action of a row steers to the center of.
fn target_cell(abstraction: &Abstraction, row: RowId) -> usize {
    let mut cell = [0; 2];
    abstraction.targets.cell(abstraction.target(row), &mut cell);
    (cell[0] * CELLS[1] as i32 + cell[1]) as usize
}

/// The probability of every cell if the first atom is one of those with these offsets, from this target.
fn truth(offsets: &[BTreeMap<[i64; 2], f64>], target: [u32; 2]) -> Vec<f64> {
    let mut cells = vec![0.0; grid_cells()];
    for (offset, p) in offsets.iter().flatten() {
        let place = [0, 1].map(|j| i64::from(target[j]) + offset[j]);
        if (0..2).all(|j| (0..i64::from(CELLS[j])).contains(&place[j])) {
            cells[(place[0] * i64::from(CELLS[1]) + place[1]) as usize] += p;
        }
    }
    cells
}

/// How many of the first atoms cross the limit, from the corners and the center of a cell: where the velocity in between is
/// most and least.
fn crossing(law: &Law, cell: [u32; 2], target: [u32; 2]) -> Vec<usize> {
    let center = |cell: [u32; 2]| [0, 1].map(|j| LOWER[j] + WIDTH * (f64::from(cell[j]) + 0.5));
    let (c, d) = (center(cell), center(target));
    let half = 0.5 * WIDTH * (1.0 - 1e-9);
    let corners = [[-half, -half], [-half, half], [half, -half], [half, half], [0.0, 0.0]];
    let number = |corner: [f64; 2]| {
        let velocity = velocity([c[0] + corner[0], c[1] + corner[1]], d);
        law.atoms.iter().filter(|(atom, _)| velocity + atom[1] >= LIMIT).count()
    };
    corners.map(number).into_iter().collect::<BTreeSet<_>>().into_iter().collect()
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
