//! The families of events one by one, recounted from the samples without the library's landings.

use crate::models::Truth;
use dynabs::numeric::to_f64;
use dynabs::partition::{CellId, CellKind};
use dynabs::spec::Problem;
use dynabs::statistics::{lower_bound, upper_bound};
use std::collections::BTreeMap;

/// In how many replications some event of a family failed.
#[derive(Debug, Default)]
pub struct Failures {
    pub cells: u64,
    pub goal: u64,
    pub outside: u64,
    /// Of any of the three.
    pub any: u64,
}

impl Failures {
    pub fn counts(&self) -> [u64; 3] {
        [self.cells, self.goal, self.outside]
    }

    /// Checks all events of one replication at the levels of the families, per tail.
    pub fn add(&mut self, problem: &Problem, targets: &[Vec<f64>], truths: &[Truth], levels: [f64; 3]) {
        let samples = problem.noise.samples.len() as u64;
        let mut bounds = Bounds { samples, levels, known: BTreeMap::new() };
        let (mut cells, mut goal, mut outside) = (false, false, false);
        for (target, truth) in targets.iter().zip(truths) {
            let counts = count(problem, target);
            let of_kind = |kind| -> u64 {
                problem.labels.iter().filter(|(_, k)| *k == kind).map(|(cell, _)| counts[cell.index()]).sum()
            };
            let (in_goal, ordinary) = (of_kind(CellKind::Goal), of_kind(CellKind::Ordinary));
            for (&k, &p) in counts.iter().zip(&truth.cells) {
                let (lower, upper) = bounds.of(0, k);
                cells |= p < lower || p > upper;
            }
            let (lower, upper) = bounds.of(1, in_goal);
            goal |= truth.goal < lower || truth.goal > upper;
            outside |= truth.lost > bounds.of(2, samples - in_goal - ordinary).1;
        }
        self.cells += u64::from(cells);
        self.goal += u64::from(goal);
        self.outside += u64::from(outside);
        self.any += u64::from(cells || goal || outside);
    }
}

/// Both bounds of every count met so far, by family.
struct Bounds {
    samples: u64,
    levels: [f64; 3],
    known: BTreeMap<(usize, u64), (f64, f64)>,
}

impl Bounds {
    fn of(&mut self, family: usize, k: u64) -> (f64, f64) {
        let (n, level) = (self.samples, self.levels[family]);
        *self.known.entry((family, k)).or_insert_with(|| (lower_bound(k, n, level), upper_bound(k, n, level)))
    }
}

/// How many samples of `d + η` fall in each cell.
fn count(problem: &Problem, target: &[f64]) -> Vec<u64> {
    let grid = &problem.grid;
    let axes: Vec<(f64, f64, u32)> =
        (grid.axes().iter()).map(|axis| (to_f64(axis.lower()), to_f64(axis.width()), axis.cells())).collect();
    let mut counts = vec![0; grid.num_cells() as usize];
    for sample in problem.noise.samples.iter() {
        let coordinates: Option<Vec<u32>> = (axes.iter().enumerate())
            .map(|(j, &(lower, width, cells))| {
                let position = ((target[j] + sample[j] - lower) / width).floor();
                (0.0 <= position && position < f64::from(cells)).then_some(position as u32)
            })
            .collect();
        if let Some(coordinates) = coordinates {
            let cell: CellId = grid.cell(&coordinates);
            counts[cell.index()] += 1;
        }
    }
    counts
}
