//! One sample set: what was promised, and what was true.

use crate::noise::Noise;
use crate::truth::{Layout, Truth, problem, satisfaction};
use dynabs::abstraction::{Abstraction, compile};
use dynabs::partition::CellId;
use dynabs::problem::Problem;
use dynabs::statistics::{lower_bound, upper_bound};
use imdp::model::{RowId, StateId};
use imdp::numeric::to_f64;
use imdp::solver::{Answer, SolverOptions};
use std::ops::AddAssign;

/// Allowance for the rounding of distribution functions.
const ROUNDING: f64 = 1e-12;

/// In how many replications something was not as promised.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Failures {
    /// Some row excludes the truth.
    pub rows: u64,
    /// Some interval of an ordinary cell does.
    pub cells: u64,
    /// Some interval of the goal does.
    pub goal: u64,
    /// Some interval of `failed` does.
    pub failed: u64,
    /// The controller satisfies the task less often than its value says, from some cell.
    pub values: u64,
    /// Control: rows without what was added for unseen mass exclude the truth.
    pub without_unseen: u64,
    /// Control: intervals at the whole level each, without a union bound, exclude the truth.
    pub without_union: u64,
}

impl AddAssign for Failures {
    fn add_assign(&mut self, other: Self) {
        self.rows += other.rows;
        self.cells += other.cells;
        self.goal += other.goal;
        self.failed += other.failed;
        self.values += other.values;
        self.without_unseen += other.without_unseen;
        self.without_union += other.without_union;
    }
}

/// Abstracts, solves and compares with the truth.
pub fn replicate(layout: Layout, noise: Noise, (samples, beta): (usize, f64), seed: u64) -> Failures {
    let problem = problem(layout, &noise.draw(samples, seed), beta);
    let abstraction = compile(&problem, &()).unwrap();
    let truths = Truth::of_actions(&problem, &abstraction, noise);
    let options = SolverOptions { policy: true, ..SolverOptions::default() };
    let answer = Answer::new(&abstraction.model, &abstraction.property, &options).unwrap();
    let policy = answer.solution.policy.as_ref().unwrap();
    let real = satisfaction(&problem, &abstraction, policy, &truths);
    let overstated = (real.iter().zip(&abstraction.state_of_cell))
        .any(|(real, &state)| answer.values.lower[state.index()] > real + ROUNDING);
    let unseen = abstraction.guarantee.samples().unwrap().unseen_mass;
    let [cells, goal, failed] = violations(&problem, &abstraction, &truths, 0.0);
    let [_, _, without_unseen] = violations(&problem, &abstraction, &truths, unseen);
    let count = u64::from;
    Failures {
        rows: count(cells || goal || failed),
        cells: count(cells),
        goal: count(goal),
        failed: count(failed),
        values: count(overstated),
        without_unseen: count(without_unseen),
        without_union: count(one_by_one(&problem, &abstraction, &truths, beta)),
    }
}

/// Whether intervals of ordinary cells, of the goal and of `failed` exclude the truth, if `failed` gets this much
/// less than the row says.
fn violations(problem: &Problem, abstraction: &Abstraction, truths: &[Truth], less: f64) -> [bool; 3] {
    let mut violated = [false; 3];
    for (id, row) in (0..).map(RowId).zip(abstraction.model.rows().to_stored().iter()) {
        let truth = &truths[abstraction.target(id).index()];
        let probabilities = truth.over(&row, problem, abstraction, abstraction.memory(id));
        for (i, &state) in row.successors.iter().enumerate() {
            let (family, upper) = match state {
                StateId(0) => (2, row.upper[i] - less),
                StateId(1) => (1, row.upper[i]),
                _ => (0, row.upper[i]),
            };
            let p = probabilities[i];
            violated[family] |= p < row.lower[i] - ROUNDING || p > upper + ROUNDING;
        }
    }
    violated
}

/// Whether some two-sided interval at level `β` of its own excludes the probability of a cell.
fn one_by_one(problem: &Problem, abstraction: &Abstraction, truths: &[Truth], beta: f64) -> bool {
    let samples = problem.noise().samples().unwrap().samples.len() as u64;
    truths.iter().zip(abstraction.targets.ids()).any(|(truth, target)| {
        let mut point = [0.0; 2];
        abstraction.targets.point(target, &mut point);
        counts(problem, point).iter().zip(&truth.cells).any(|(&k, &p)| {
            p < lower_bound(k, samples, beta / 2.0) || p > upper_bound(k, samples, beta / 2.0)
        })
    })
}

/// How many samples of `d + η` fall in each cell, counted without the library.
fn counts(problem: &Problem, point: [f64; 2]) -> Vec<u64> {
    let grid = problem.grid();
    let mut counts = vec![0; grid.num_cells() as usize];
    for sample in problem.noise().samples().unwrap().samples.iter() {
        let coordinates: Option<Vec<u32>> = (grid.axes().iter().enumerate())
            .map(|(j, axis)| {
                let position = (point[j] + sample[j] - to_f64(axis.lower())) / to_f64(axis.width());
                let index = position.floor();
                (0.0 <= index && index < f64::from(axis.cells())).then_some(index as u32)
            })
            .collect();
        if let Some(coordinates) = coordinates {
            let cell: CellId = grid.cell(&coordinates);
            counts[cell.index()] += 1;
        }
    }
    counts
}
