//! Small models with Gaussian noise, and the truth about them.

use dynabs::abstraction::Abstraction;
use dynabs::imdp::Row;
use dynabs::noise::{Gaussian, NoiseSamples};
use dynabs::numeric::{ExactMatrix, to_f64};
use dynabs::partition::{CellId, CellKind};
use dynabs::spec::{Document, Problem};
use nalgebra::DMatrix;
use serde_json::{Value, json};
use statrs::distribution::{ContinuousCDF, Normal};
use std::path::Path;

/// The confidence budget: large, so that failures are visible.
pub const BETA: f64 = 0.2;

/// A model and the distribution of its noise: independent components.
pub struct Case {
    pub name: &'static str,
    json: Value,
    components: Vec<Normal>,
    samples: usize,
    gaussian: Gaussian,
}

/// What really happens under one action: the probabilities of the states and of the regions.
pub struct Truth {
    /// Per cell.
    pub cells: Vec<f64>,
    pub goal: f64,
    /// In unsafe cells or outside the partition.
    pub lost: f64,
}

impl Case {
    fn new(name: &'static str, json: Value, mean: &[f64], deviations: &[f64], samples: usize) -> Self {
        let components: Vec<_> =
            mean.iter().zip(deviations).map(|(&m, &s)| Normal::new(m, s).unwrap()).collect();
        let n = mean.len();
        let covariance = DMatrix::from_fn(n, n, |i, j| if i == j { deviations[i].powi(2) } else { 0.0 });
        let gaussian = Gaussian::new(mean, &ExactMatrix::from_decimals(&covariance).unwrap()).unwrap();
        Self { name, json, components, samples, gaussian }
    }

    pub fn all() -> Vec<Self> {
        let line = |targets: Value| {
            model(
                json!({"A": [[1]], "B": [[1]]}),
                json!({"lower": [-4], "upper": [4], "cells": [8]}),
                json!({"goal": [{"lower": [1], "upper": [2]}], "unsafe": [{"lower": [-4], "upper": [-3]}]}),
                targets,
            )
        };
        let plane = model(
            json!({"A": [[1, 0.5], [0, 1]], "B": [[1, 0], [0, 1]]}),
            json!({"lower": [-2, -2], "upper": [2, 2], "cells": [5, 4]}),
            json!({"goal": [{"lower": [-0.4, -1], "upper": [0.4, 1]}],
                   "unsafe": [{"lower": [1.2, -2], "upper": [2, -1]}]}),
            json!("centers"),
        );
        vec![
            Self::new("line", line(json!("centers")), &[0.1], &[0.5], 150),
            Self::new(
                "points off the lattice",
                line(json!([[-1.3], [0.2], [1.75], [3.9]])),
                &[0.1],
                &[0.5],
                150,
            ),
            Self::new("plane", plane, &[0.1, -0.05], &[0.4, 0.3], 200),
        ]
    }

    pub fn draw(&self, seed: u64) -> NoiseSamples {
        self.gaussian.sample(self.samples, seed)
    }

    /// The model with the samples of this seed, read from a file in `directory`.
    pub fn problem(&self, directory: &Path, seed: u64) -> Problem {
        std::fs::write(directory.join("noise.csv"), self.draw(seed).to_csv()).unwrap();
        let document = Document {
            name: self.name.to_owned(),
            directory: directory.to_path_buf(),
            value: self.json.clone(),
        };
        Problem::from_document(&document).unwrap()
    }

    fn measure(&self, j: usize, lower: f64, upper: f64) -> f64 {
        self.components[j].cdf(upper) - self.components[j].cdf(lower)
    }

    /// `P(η ∉ W)` for the bounding box `W` of these samples.
    pub fn unseen(&self, samples: &NoiseSamples) -> f64 {
        let inside = (0..self.components.len()).map(|j| {
            let side = || samples.iter().map(|sample| sample[j]);
            self.measure(j, side().fold(f64::INFINITY, f64::min), side().fold(f64::NEG_INFINITY, f64::max))
        });
        1.0 - inside.product::<f64>()
    }

    /// The truth about `d + η`.
    pub fn truth(&self, problem: &Problem, target: &[f64]) -> Truth {
        let grid = &problem.grid;
        let cells: Vec<f64> = (0..grid.num_cells())
            .map(|cell| {
                let measure = |(j, axis): (usize, &dynabs::partition::Axis)| {
                    let i = grid.coordinate(CellId(cell), j);
                    let face = |i| to_f64(&axis.face(i)) - target[j];
                    self.measure(j, face(i), face(i + 1))
                };
                grid.axes().iter().enumerate().map(measure).product()
            })
            .collect();
        let sum = |kind| -> f64 {
            problem.labels.iter().filter(|(_, k)| *k == kind).map(|(cell, _)| cells[cell.index()]).sum()
        };
        let (goal, ordinary) = (sum(CellKind::Goal), sum(CellKind::Ordinary));
        Truth { goal, lost: 1.0 - goal - ordinary, cells }
    }
}

fn model(dynamics: Value, partition: Value, mut task: Value, targets: Value) -> Value {
    task["horizon"] = json!(4);
    let n = dynamics["A"].as_array().unwrap().len();
    json!({
        "name": "coverage",
        "dynamics": dynamics,
        "noise": {"samples": {"file": "noise.csv", "of": "grouped"}},
        "input": {"lower": vec![-20; n], "upper": vec![20; n]},
        "partition": partition,
        "targets": targets,
        "task": task,
        "probabilities": {"mode": "pac", "beta": BETA},
    })
}

impl Truth {
    /// The distribution over the states of a row, with the mass of unlisted states moved to `failed`.
    pub fn over(&self, row: &Row<'_>, problem: &Problem, abstraction: &Abstraction) -> Vec<f64> {
        let mut of_state = vec![0.0; abstraction.model.num_states()];
        for (cell, kind) in problem.labels.iter() {
            if kind != CellKind::Unsafe {
                of_state[abstraction.state_of_cell[cell.index()] as usize] += self.cells[cell.index()];
            }
        }
        let listed: f64 = row.successors.iter().map(|&s| of_state[s as usize]).sum();
        of_state[0] = 1.0 - listed;
        row.successors.iter().map(|&s| of_state[s as usize]).collect()
    }
}
