//! Numbers at the edge of what doubles hold: nothing that is not finite narrows a set.

use crate::common::root;
use dynabs::abstraction::compile;
use dynabs::model_file::Document;
use dynabs::problem::Problem;
use imdp::solver::{Answer, SolverOptions};
use serde_json::json;
use std::collections::BTreeMap;
use std::fs;

/// The promise for a problem; what it is refused for.
fn promise(problem: &Problem) -> Result<f64, String> {
    let abstraction = compile(problem, &()).map_err(|error| error.to_string())?;
    Ok(Answer::new(&abstraction.model, &abstraction.property, &SolverOptions::default()).unwrap().lower)
}

fn document(name: &str, sets: &[&String]) -> Document {
    let path = root().join("tests/data/promises").join(format!("{name}.json"));
    let mut document = Document::parse(&path, &fs::read_to_string(&path).unwrap()).unwrap();
    sets.iter().for_each(|set| document.set(&set.parse().unwrap()).unwrap());
    document
}

/// What is attained from 5.5 in three steps if the noise is a sample, each with the same chance.
///
/// `x⁺ = d + η` for any of the targets that 9 can reach from everywhere in the cell. All noise moves by whole cells, or far.
fn truth(problem: &Problem, targets: &[f64], is_unsafe: impl Fn(usize) -> bool) -> f64 {
    let samples = &problem.noise().samples().unwrap().samples;
    let mut chances: BTreeMap<u64, f64> = BTreeMap::new();
    for noise in samples.iter() {
        *chances.entry(noise[0].to_bits()).or_default() += 1.0 / samples.len() as f64;
    }
    let mut values: Vec<f64> = (0..10).map(|cell| f64::from(u8::from(cell == 0))).collect();
    for _ in 0..3 {
        let worth = |target: f64| -> f64 {
            let of = |(noise, chance): (&u64, &f64)| {
                let x = target + f64::from_bits(*noise);
                if (0.0..10.0).contains(&x) { chance * values[x as usize] } else { 0.0 }
            };
            chances.iter().map(of).sum()
        };
        let best = |cell: usize| {
            let reachable = targets.iter().filter(|&&d| (d - cell as f64 - 0.5).abs() + 0.5 <= 9.0);
            reachable.map(|&d| worth(d)).fold(0.0, f64::max)
        };
        let next = (0..10).map(|cell| match cell {
            0 => 1.0,
            cell if is_unsafe(cell) => 0.0,
            cell => best(cell),
        });
        values = next.collect();
    }
    values[5]
}

#[test]
fn promises_are_below_the_truth_of_their_samples() {
    let centers: Vec<f64> = (0..10).map(|cell| f64::from(cell) + 0.5).collect();
    let unsafe_set = |set: &str| format!("/task/unsafe={set}");
    let [corner, none, cell] =
        [r#"[{"lower":[9.9],"upper":[10]}]"#, "[]", r#"[{"lower":[9],"upper":[10]}]"#].map(unsafe_set);
    let cases = [
        ("two_values", vec![&corner], &centers[..], true, 0.99998),
        ("two_values", vec![&none], &centers[..], false, 0.99998),
        ("two_values", vec![&cell], &centers[..], true, 0.99998),
        ("overflow", vec![], &[0.55][..], true, 0.4993),
        ("levels", vec![], &[5.000000001][..], true, 0.0),
    ];
    for (name, sets, targets, last_is_unsafe, expected) in cases {
        let problem = document(name, &sets).problem().unwrap();
        let truth = truth(&problem, targets, |cell| cell == 9 && last_is_unsafe);
        assert!((truth - expected).abs() < 1e-4, "{name}: {truth}");
        let promised = promise(&problem).unwrap();
        assert!(promised <= truth && truth - promised < 0.08, "{name} {sets:?}: {promised} {truth}");
    }
}

/// A plant that is steered to the goal from everywhere, almost surely; then something in it is huge.
fn huge(sets: &[&str]) -> Result<f64, String> {
    let value = json!({
        "name": "huge",
        "dynamics": {"A": [[1, 0], [0, 1]], "B": [[1, 0], [0, 1]], "group_steps": 2},
        "noise": {"gaussian": {"covariance": [[0.01, 0], [0, 0.01]]}, "count": 2000, "seed": 1},
        "input": {"lower": [-9, -9], "upper": [9, 9]},
        "partition": {"lower": [-2, -2], "upper": [2, 2], "cells": [4, 4]},
        "task": {"goal": [{"lower": [-1, -1], "upper": [1, 1]}], "unsafe": ["outside"], "horizon": 4},
        "initial_state": [1.5, 1.5],
    });
    let mut document = Document { name: "huge".into(), directory: root(), value };
    sets.iter().for_each(|set| document.set(&set.parse().unwrap()).unwrap());
    promise(&document.problem().map_err(|error| error.to_string())?)
}

#[test]
fn what_is_huge_is_refused_or_promises_nothing() {
    assert!(huge(&[]).unwrap() > 0.98);
    let nothing: [&[&str]; 8] = [
        &[
            "/partition={\"lower\":[-1.7e308,-2],\"upper\":[1.7e308,2],\"cells\":[1,4]}",
            "/task/goal=[{\"lower\":[null,-1],\"upper\":[null,1]}]",
        ],
        &["/dynamics/A=[[1e200,0],[0,1]]"],
        &["/dynamics/A=[[1,1e200],[0,1]]"],
        &["/dynamics/A=[[1e-200,1e200],[1e200,1e-200]]", "/dynamics/group_steps=1"],
        &["/dynamics/B=[[1e-300,0],[0,1e300]]"],
        &["/dynamics/q=[1e308,-1e308]"],
        &["/noise/gaussian/covariance=[[1e308,0],[0,1e308]]"],
        &["/noise/gaussian/mean=[1.7e308,-1.7e308]"],
    ];
    for sets in nothing {
        match huge(sets) {
            Ok(promised) => assert_eq!(promised, 0.0, "{sets:?}"),
            Err(error) => {
                let known = ["no action is enabled", "every action may meet something unsafe"];
                assert!(known.iter().any(|known| error.contains(known)), "{sets:?}: {error}");
            }
        }
    }
    // A factor of 1e-8 / 5e-324 between the noise in one dimension and in the other.
    let error = huge(&["/noise/gaussian/covariance=[[5e-324,1e-8],[1e-8,1e308]]"]).unwrap_err();
    assert!(error.contains("/noise/gaussian/covariance: found"), "{error}");
}
