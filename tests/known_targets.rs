//! Actions that steer to targets under noise whose distribution is known.

use crate::common::root;
use dynabs::abstraction::{Abstraction, compile};
use dynabs::guarantee::Evidence;
use dynabs::model_file::Document;
use dynabs::problem::Problem;
use imdp::model::{RowBuffer, RowId};
use imdp::solver::{Answer, SolverOptions};
use statrs::distribution::{ContinuousCDF, Laplace, Normal};
use std::fs;
use std::path::Path;

/// Two independent coordinates, one normal, one Laplace; goal and unsafe cells, and what is outside.
const PLANE: &str = r#"{
    "name": "plane", "actions": "targets",
    "dynamics": {"A": [[1, 0.1], [0, 0.9]], "B": [[1, 0], [0, 0.5]]},
    "noise": {"components": [{"gaussian": {"mean": 0.05, "deviation": 0.3}}, {"laplace": {"scale": 0.2}}]},
    "input": {"lower": [-3, -3], "upper": [3, 3]},
    "partition": {"lower": [-2, -1], "upper": [2, 1], "cells": [8, 5]},
    "targets": "centers",
    "task": {"goal": [{"lower": [1, -1], "upper": [2, 0.2]}], "unsafe": [{"lower": [-1, 0.2], "upper": [0, 0.6]}], "horizon": 6},
    "initial_state": [-1.5, -0.5]
}"#;

fn problem(sets: &[&str]) -> Result<Problem, String> {
    let mut document = Document::parse(Path::new("plane.json"), PLANE).unwrap();
    sets.iter().for_each(|set| document.set(&set.parse().unwrap()).unwrap());
    document.problem().map_err(|error| error.to_string())
}

fn lower(abstraction: &Abstraction) -> f64 {
    let options = SolverOptions::default();
    Answer::new(&abstraction.model, &abstraction.property, &options).unwrap().lower
}

/// The masses of open cells, goal and everything else from a target, by distribution functions of another library.
fn truth(problem: &Problem, point: &[f64]) -> (Vec<f64>, f64) {
    let (normal, laplace) = (Normal::new(0.05, 0.3).unwrap(), Laplace::new(0.0, 0.2).unwrap());
    let along = |j: usize, cell: u32| {
        let (from, width) = if j == 0 { (-2.0, 0.5) } else { (-1.0, 0.4) };
        let (a, b) =
            (from + width * f64::from(cell) - point[j], from + width * f64::from(cell + 1) - point[j]);
        if j == 0 { normal.cdf(b) - normal.cdf(a) } else { laplace.cdf(b) - laplace.cdf(a) }
    };
    let (mut cells, mut goal) = (vec![], 0.0);
    for (cell, kind) in problem.labels().iter() {
        let at = problem.grid().coordinates(cell);
        let mass = along(0, at[0]) * along(1, at[1]);
        match kind {
            dynabs::partition::CellKind::Ordinary => cells.push(mass),
            dynabs::partition::CellKind::Goal => goal += mass,
            dynabs::partition::CellKind::Unsafe => {}
        }
    }
    (cells, goal)
}

/// Every row has what it lists in tight intervals, and may lose no more than what is lost; on lattices and for points anywhere.
#[test]
fn rows_enclose_the_true_masses() {
    let points = "/targets=[[0.3, 0.05], [1.4, -0.6], [-1.99, 0.9], [0.75, -0.2]]";
    for sets in [&[][..], &[points]] {
        let problem = problem(sets).unwrap();
        let abstraction = compile(&problem, &()).unwrap();
        let Evidence::Known { unlisted: most, .. } = abstraction.guarantee.evidence else {
            panic!("known noise")
        };
        let buffer = &mut RowBuffer::default();
        let mut point = [0.0; 2];
        for target in abstraction.targets.ids() {
            abstraction.targets.point(target, &mut point);
            let (cells, goal) = truth(&problem, &point);
            let row = abstraction.model.rows().row(RowId(target.0), buffer);
            let (mut listed, mut failed) = (0.0, 0.0);
            for (i, &successor) in row.successors.iter().enumerate() {
                let (low, high) = (row.lower[i], row.upper[i]);
                // The other library is right to about 1e-11; goal cells with a mass of at most 1e-10 fail.
                let (mass, unlisted) = match successor.index() {
                    0 => {
                        failed = high;
                        continue;
                    }
                    1 => (goal, 2e-9),
                    state => (cells[state - 2], 0.0),
                };
                assert!(
                    low <= mass + 1e-11 && mass <= high + unlisted + 1e-11,
                    "{target:?} {successor:?}: {low} {mass} {high}"
                );
                assert!(mass - high <= most + 1e-11, "{target:?}: {mass} {high} {most}");
                assert!(high - low < 1e-8, "{target:?} {successor:?}: {low} {high}");
                listed += mass;
            }
            assert!(
                failed >= 1.0 - listed - 1e-9 && failed <= 1.0 - listed + 1e-8,
                "{target:?}: {failed} {listed}"
            );
        }
    }
}

/// The bound is the value of the cells, which samples bring less near the more of them there are.
#[test]
fn what_is_known_is_worth_more_than_samples() {
    let path = root().join("models/predecessors/building_1_zone.json");
    let value = |set: &str| {
        let mut document = Document::parse(&path, &fs::read_to_string(&path).unwrap()).unwrap();
        document.set(&r#"/actions="targets""#.parse().unwrap()).unwrap();
        document.set(&set.parse().unwrap()).unwrap();
        lower(&compile(&document.problem().unwrap(), &()).unwrap())
    };
    let known = value(r#"/noise={"gaussian": {"covariance": [[0.02, 0], [0, 0.1]]}}"#);
    let sampled = value("/noise/count=3200");
    assert!(known > 0.9445 && known < 0.945 && sampled < 0.8, "{known} {sampled}");
}

#[test]
fn what_cannot_be_done_is_said() {
    for (set, expected) in [
        (
            r#"/noise={"gaussian": {"covariance": [[1, 0.5], [0.5, 1]]}}"#,
            "/noise/gaussian/covariance/1: found components that depend",
        ),
        ("/dynamics/group_steps=2", "/noise: found a known distribution, and 2 steps that are grouped"),
        (r#"/noise={"components": [null]}"#, "/noise/components: found 1 component; expected 2"),
        (
            r#"/noise={"gaussian": {"covariance": [[1, 0], [0, 1]]}, "seed": 1}"#,
            "/noise/count: found nothing; expected the number of samples",
        ),
    ] {
        let error = problem(&[set]).unwrap_err();
        assert!(error.contains(expected), "{error}");
    }
}
