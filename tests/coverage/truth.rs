//! A small model, and the truth about it under known noise.

use crate::noise::Noise;
use dynabs::abstraction::Abstraction;
use dynabs::partition::{CellId, CellKind};
use dynabs::problem::{
    GivenSamples, InputSet, LinearDynamics, Partition, Probabilities, Problem, RegionBox, SampleKind,
    TargetChoice, Task,
};
use imdp::model::{Row, StateId};
use imdp::numeric::to_f64;
use imdp::solver::Policy;

/// The number of steps of the task.
pub const HORIZON: u64 = 4;

/// Where actions steer to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// The centers of all cells: rows are translations of each other.
    Centers,
    /// A few points anywhere.
    Points,
}

/// The model with these samples.
pub fn problem(layout: Layout, samples: &[f64], beta: f64) -> Problem {
    let targets = match layout {
        Layout::Centers => TargetChoice::Centers,
        Layout::Points => TargetChoice::Points(
            [[-1.3, 0.2], [0.1, 0.3], [0.9, -1.2], [1.7, 1.4], [-0.2, -0.1]].map(Vec::from).to_vec(),
        ),
    };
    let dynamics = LinearDynamics {
        a: vec![vec![1.0, 0.5], vec![0.0, 1.0]],
        b: vec![vec![1.0, 0.0], vec![0.0, 1.0]],
        q: None,
    };
    let region = |lower: [f64; 2], upper: [f64; 2]| RegionBox { lower: lower.into(), upper: upper.into() };
    let goal = region([-0.4, -1.0], [0.4, 1.0]);
    let unsafe_ = region([1.2, -2.0], [2.0, -1.0]);
    Problem::builder(dynamics, InputSet::Box { lower: vec![-2.5, -1.5], upper: vec![2.5, 1.5] })
        .partition(Partition { lower: vec![-2.0, -2.0], upper: vec![2.0, 2.0], cells: vec![5, 4] })
        .targets(targets)
        .task(Task::reach(vec![goal]).avoiding(vec![unsafe_]).within(HORIZON))
        .probabilities(Probabilities::with_beta(beta).unwrap())
        .noise(GivenSamples { values: samples.to_vec(), of: SampleKind::Grouped })
        .build()
        .unwrap()
}

/// What really happens under one action: the probability of every cell.
pub struct Truth {
    pub cells: Vec<f64>,
}

impl Truth {
    /// The truth about every action.
    pub fn of_actions(problem: &Problem, abstraction: &Abstraction, noise: Noise) -> Vec<Self> {
        (0..abstraction.targets.len())
            .map(|target| {
                let mut point = [0.0; 2];
                abstraction.targets.point(target, &mut point);
                Self::at(problem, noise, point)
            })
            .collect()
    }

    fn at(problem: &Problem, noise: Noise, point: [f64; 2]) -> Self {
        let grid = problem.grid();
        let cells = (0..grid.num_cells()).map(|cell| {
            let face = |j: usize, i| to_f64(&grid.axes()[j].face(i)) - point[j];
            let side = |above| [0, 1].map(|j| face(j, grid.coordinate(CellId(cell), j) + above));
            noise.measure(side(0), side(1))
        });
        Self { cells: cells.collect() }
    }

    /// The distribution over the states of a row, with all other mass moved to `failed`.
    pub fn over(&self, row: &Row<'_>, problem: &Problem, abstraction: &Abstraction) -> Vec<f64> {
        let mut of_state = vec![0.0; abstraction.model.num_states()];
        for (cell, kind) in problem.labels().iter() {
            if kind != CellKind::Unsafe {
                of_state[abstraction.state_of_cell[cell.index()].index()] += self.cells[cell.index()];
            }
        }
        let listed: f64 = row.successors.iter().map(|&s| of_state[s.index()]).sum();
        of_state[0] = 1.0 - listed;
        row.successors.iter().map(|&s| of_state[s.index()]).collect()
    }
}

/// The true probability that the refined controller satisfies the task, by first cell.
///
/// From every state of a cell the controller steers to the same target, so cells and steps are a Markov chain.
pub fn satisfaction(
    problem: &Problem,
    abstraction: &Abstraction,
    policy: &Policy,
    truths: &[Truth],
) -> Vec<f64> {
    let kinds: Vec<CellKind> = problem.labels().iter().map(|(_, kind)| kind).collect();
    let mut values: Vec<f64> =
        kinds.iter().map(|&kind| f64::from(u8::from(kind == CellKind::Goal))).collect();
    for elapsed in (0..HORIZON).rev() {
        let of_cell = |cell: usize| {
            let state: StateId = abstraction.state_of_cell[cell];
            let row = policy.row(abstraction.model.choices(), state, elapsed)?;
            Some(truths[row.index()].cells.iter().zip(&values).map(|(p, v)| p * v).sum())
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
