//! A small model, and the truth about it under known noise.

use crate::noise::Noise;
use dynabs::abstraction::Abstraction;
use dynabs::partition::CellId;
use dynabs::problem::{
    GivenSamples, InputSet, LinearDynamics, Logic, Partition, Probabilities, Problem, RegionBox, RegionParts,
    SampleKind, ShapeParts, TargetChoice, Task,
};
use dynabs::task::Memory;
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
    /// The centers of all cells, for a task with a memory: to come to two regions one after the other.
    InOrder,
}

/// The model with these samples.
pub fn problem(layout: Layout, samples: &[f64], beta: f64) -> Problem {
    let targets = match layout {
        Layout::Centers | Layout::InOrder => TargetChoice::Centers,
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
    let task = match layout {
        Layout::Centers | Layout::Points => Task::reach(vec![goal]),
        Layout::InOrder => {
            let named =
                |name: &str, sides| RegionParts { name: name.into(), shapes: vec![ShapeParts::Box(sides)] };
            let regions = vec![
                named("first", region([-2.0, 0.0], [-0.4, 2.0])),
                named("then", goal),
                named("clear", region([0.4, -2.0], [1.2, 2.0])),
            ];
            Task::formula("F (first & (!clear U then))", Logic::Ltl, regions)
        }
    };
    Problem::builder(dynamics, InputSet::Box { lower: vec![-2.5, -1.5], upper: vec![2.5, 1.5] })
        .partition(Partition { lower: vec![-2.0, -2.0], upper: vec![2.0, 2.0], cells: vec![5, 4] })
        .targets(targets)
        .task(task.avoiding(vec![unsafe_]).within(HORIZON))
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
        (abstraction.targets.ids())
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

    /// The distribution over the states of a row with a memory, with all other mass moved to `failed`.
    pub fn over(
        &self,
        row: &Row<'_>,
        problem: &Problem,
        abstraction: &Abstraction,
        memory: Memory,
    ) -> Vec<f64> {
        let mut of_state = vec![0.0; abstraction.model.num_states()];
        for (cell, _) in problem.labels().iter() {
            of_state[abstraction.arrival(problem, Some(memory), cell).index()] += self.cells[cell.index()];
        }
        of_state[0] = 0.0;
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
    let model = &abstraction.model;
    let reached = model.labels().get("reached").unwrap();
    let mut values: Vec<f64> =
        (0..model.num_states()).map(|state| f64::from(u8::from(reached.contains(state)))).collect();
    for elapsed in (0..HORIZON).rev() {
        let of_state = |state: usize| {
            let row = policy.row(model.choices(), StateId::from_index(state), elapsed)?;
            let memory = abstraction.memory(row);
            let value = |cell| values[abstraction.arrival(problem, Some(memory), CellId(cell)).index()];
            let cells = truths[abstraction.target(row).index()].cells.iter();
            Some((0..).zip(cells).map(|(cell, p)| p * value(cell)).sum())
        };
        values = (0..values.len())
            .map(|state| if reached.contains(state) { 1.0 } else { of_state(state).unwrap_or(0.0) })
            .collect();
    }
    abstraction.state_of_cell.iter().map(|state| values[state.index()]).collect()
}
