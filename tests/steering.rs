//! The law that an enabled action promises: inside U, and at the target, from every state of the cell.
use dynabs::abstraction::{Targets, demands, enabled_actions};
use dynabs::geometry::Polytope;
use dynabs::model_file::Document;
use dynabs::partition::{CellId, Grid};
use dynabs::problem::{Actions, Problem, Stabilizer, TargetId};
use dynabs::system::{Extent, FeedbackLaw};
use imdp::numeric::to_f64;
use nalgebra::{DMatrix, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha12Rng;
use std::path::Path;

/// Three states, two inputs: two steps are grouped, so there are more inputs than states.
const MORE_INPUTS_THAN_STATES: &str = r#"{
    "name": "wide",
    "dynamics": {"A": [[0.9, 0.3, 0], [0, 0.8, 0.2], [0.1, 0, 1.1]], "B": [[1, 0], [0, 1], [0.2, 0.4]], "q": [0.1, 0, -0.1]},
    "noise": {"gaussian": {"covariance": [[0.01, 0, 0], [0, 0.01, 0], [0, 0, 0.01]]}, "count": 200},
    "input": {"G": [[1, 1], [1, -1], [-1, 1], [-1, -1]], "g": [6, 6, 5, 6]},
    "partition": {"lower": [-2, -2, -2], "upper": [2, 2, 2], "cells": [8, 8, 8]},
    "task": {"goal": [{"lower": [-0.5, -0.5, -0.5], "upper": [0.5, 0.5, 0.5]}], "horizon": 6}
}"#;

fn random_unit(rng: &mut ChaCha12Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

/// A random state of a cell, corners included.
fn state_in(grid: &Grid, cell: CellId, rng: &mut ChaCha12Rng) -> DVector<f64> {
    DVector::from_fn(grid.dimension(), |j, _| {
        let i = grid.coordinate(cell, j);
        let (lower, upper) = (to_f64(&grid.axes()[j].face(i)), to_f64(&grid.axes()[j].face(i + 1)));
        match rng.next_u64() % 4 {
            0 => lower,
            1 => upper,
            _ => lower + random_unit(rng) * (upper - lower),
        }
    })
}

fn excess(set: &Polytope, u: &DVector<f64>) -> f64 {
    let values = set.normals().to_f64() * u;
    values.iter().zip(set.offsets()).map(|(value, g)| value - to_f64(g)).fold(f64::NEG_INFINITY, f64::max)
}

/// How many (state, action) pairs were tried.
fn check(problem: &Problem, seed: u64) -> usize {
    let grid = problem.grid();
    let Actions::Targets(points) = problem.actions();
    let targets = Targets::new(points, grid);
    let layers = problem.stabilizer().and_then(Stabilizer::feedback).map(|s| &s.layers);
    let law = FeedbackLaw::new(problem.system(), problem.input(), layers, &demands(problem)).unwrap();
    let extent = Extent { state: grid.magnitudes(), target: targets.magnitudes() };
    let constraints = law.constraints(problem.input(), layers.map(|l| l.abstract_input()), &extent);
    let error = law.steering_error(&extent);
    let [m, n, c] = [law.target_gain(), law.state_gain(), law.constant()];
    let [a, b, q] = [problem.system().a(), problem.system().b(), problem.system().q()].map(|m| m.to_f64());
    let mut rng = ChaCha12Rng::seed_from_u64(seed);
    let cells: Vec<CellId> = (0..200).map(|_| CellId(rng.next_u32() % grid.num_cells())).collect();
    let enabled = enabled_actions(grid, &cells, &targets, &constraints, &());
    let (mut ranges, mut tried) = (enabled.ranges.as_slice(), 0);
    let mut point = vec![0.0; grid.dimension()];
    for (&cell, &count) in cells.iter().zip(&enabled.ranges_per_cell) {
        let (own, rest) = ranges.split_at(count as usize);
        ranges = rest;
        for target in own.iter().flat_map(|range| [range.first, range.last]) {
            targets.point(TargetId(target.0), &mut point);
            let d = DVector::from_column_slice(&point);
            let x = state_in(grid, cell, &mut rng);
            let u: DVector<f64> = (&m * &d + &n * &x + &c).column(0).into();
            assert!(
                excess(problem.input(), &u) <= 0.0,
                "u = {u} leaves U by {}",
                excess(problem.input(), &u)
            );
            if let Some(layers) = layers {
                let gain: DMatrix<f64> = layers.gain().to_f64();
                let upper: DVector<f64> = (&u + gain * (&x - layers.about().to_f64())).column(0).into();
                // u′ is recovered here with an error of its own.
                assert!(excess(layers.abstract_input(), &upper) <= 1e-9, "u′ = {upper}");
            }
            let reached = &a * &x + &b * &u + &q;
            for j in 0..grid.dimension() {
                let missed = (reached[j] - d[j]).abs();
                // The check itself rounds about as much as the law.
                assert!(missed <= 4.0 * error[j], "misses the target by {missed:e}, bound {:e}", error[j]);
                assert!(error[j] < 1e-9 * (1.0 + extent.state[j]), "the bound is tight: {:e}", error[j]);
            }
            tried += 1;
        }
    }
    tried
}

#[test]
fn inputs_stay_inside_and_targets_are_reached() {
    for (seed, model) in (1..).zip(crate::common::shipped_models()) {
        let tried = check(&crate::common::problem(&model, &[]).unwrap(), seed);
        assert!(tried > 50, "{model}: only {tried} pairs");
    }
}

#[test]
fn the_law_is_tested_not_its_existence() {
    let document = Document::parse(Path::new("wide.json"), MORE_INPUTS_THAN_STATES).unwrap();
    let problem = document.problem().unwrap();
    assert_eq!((problem.group_steps(), problem.system().input_dimension()), (2, 4));
    assert!(check(&problem, 99) > 100);
}
