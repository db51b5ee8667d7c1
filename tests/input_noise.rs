//! Noise of actions that are inputs: correlated, sampled jointly, sampled with independent components.

use dynabs::abstraction::inputs::InputAbstraction;
use dynabs::guarantee::Evidence;
use dynabs::model_file::{Document, StatedProblem};
use dynabs::noise::known::Distribution;
use dynabs::problem::InputProblem;
use imdp::numeric::from_decimal;
use imdp::property::Resolution;
use imdp::solver::{Answer, SolverOptions};
use serde_json::{Value, json};
use std::path::Path;

fn model(noise: &Value, cells: u32, task: &Value) -> Value {
    json!({
        "name": "noise",
        "dynamics": {"A": [[0.5, 0], [0, 0.5]], "B": [[0.5, 0], [0, 0.5]]},
        "noise": noise,
        "actions": "inputs",
        "input": {"lower": [-1, -1], "upper": [1, 1], "points": [3, 3]},
        "partition": {"lower": [-3, -3], "upper": [3, 3], "cells": [cells, cells]},
        "task": task,
        "initial_state": [0.9, 0.9]
    })
}

fn problem(value: &Value) -> Result<InputProblem, String> {
    let document = Document::parse(Path::new("m.json"), &value.to_string()).unwrap();
    match document.stated() {
        Ok(StatedProblem::Inputs(problem)) => Ok(*problem),
        Ok(StatedProblem::Targets(_)) => panic!("actions are inputs"),
        Err(error) => Err(error.to_string()),
    }
}

fn correlated(rho: f64) -> Value {
    json!({"gaussian": {"covariance": [[0.25, 0.25 * rho], [0.25 * rho, 0.25]]}})
}

fn sampled(independent: Option<&str>) -> Value {
    let mut noise = json!({"gaussian": {"covariance": [[0.25, 0], [0, 0.25]]}, "count": 4000, "seed": 5});
    if let Some(kind) = independent {
        noise["independent"] = kind.into();
    }
    noise
}

#[test]
fn the_general_solver_gives_the_native_values() {
    let tasks = [
        json!({"goal": [{"lower": [-3, -3], "upper": [-1, -1]}], "unsafe": [{"lower": [1.5, 1.5], "upper": [3, 3]}], "horizon": 3}),
        json!({"type": "stay", "horizon": 2}),
        // Faces that cut cells: nature picks what these mean.
        json!({"goal": [{"lower": [-3, -3], "upper": [-0.5, -1]}], "unsafe": [{"lower": [1.5, 1.25], "upper": [3, 3]}], "horizon": 3}),
        json!({"type": "stay", "safe": [{"lower": [-2.5, -3], "upper": [2.5, 3]}], "horizon": 2}),
    ];
    for noise in
        [correlated(0.8), correlated(-0.5), sampled(None), sampled(Some("intervals")), sampled(Some("bands"))]
    {
        for task in &tasks {
            let problem = problem(&model(&noise, 6, task)).unwrap();
            let abstraction = InputAbstraction::new(&problem).unwrap();
            let own = abstraction.question().solve(&SolverOptions::default()).values;
            let exported = abstraction.exported().solve(&SolverOptions::default()).values;
            let encoded = abstraction.exported().model(&abstraction.initial(problem.initial_cell())).unwrap();
            let cell = problem.initial_cell().unwrap().index();
            assert!(
                own.lower[cell] > 0.0 || own.upper[cell] < 1.0,
                "{noise}: {} {}",
                own.lower[cell],
                own.upper[cell]
            );
            assert!(exported.lower[cell] <= own.lower[cell] && exported.upper[cell] >= own.upper[cell]);
            for (resolution, value) in
                [(Resolution::Pmaxmin, exported.lower[cell]), (Resolution::Pmaxmax, exported.upper[cell])]
            {
                let property = abstraction.property(resolution);
                let answer = Answer::new(&encoded.model, &property, &SolverOptions::default()).unwrap();
                assert!(
                    answer.lower - 1e-9 <= value && value <= answer.upper + 1e-9,
                    "{noise} {property}: {value} {answer:?}"
                );
            }
        }
    }
}

/// `P(x/2 + u/2 + η ∈ [−1, 1]²)` for `η` of variance ¼ and correlation `ρ`, by conditioning on the first component.
fn stays(mean: [f64; 2], rho: f64) -> f64 {
    let exact = |x: f64| from_decimal(x).unwrap();
    let mass = |variance: f64, from: f64, to: f64| {
        let noise = Distribution::Gaussian { mean: exact(0.0), variance: exact(variance) };
        noise.mass(Some(&exact(from)), Some(&exact(to))).middle()
    };
    let (parts, low) = (400, -1.0 - mean[0]);
    let width = 2.0 / f64::from(parts);
    (0..parts)
        .map(|i| {
            let (from, to) = (low + width * f64::from(i), low + width * f64::from(i + 1));
            let center = mean[1] + rho * 0.5 * (from + to);
            mass(0.25, from, to) * mass(0.25 * (1.0 - rho * rho), -1.0 - center, 1.0 - center)
        })
        .sum()
}

#[test]
fn correlated_noise_has_its_probability() {
    let task = json!({"type": "stay", "safe": [{"lower": [-1, -1], "upper": [1, 1]}], "horizon": 1});
    let bounds = |rho: f64| {
        let mut value = model(&correlated(rho), 24, &task);
        value["partition"]["resolution"] = json!([6, 6]);
        // Nothing to choose: from about (0.9, 0.9) to (0.95, 0.95).
        value["input"] = json!({"list": [[1, 1]]});
        let problem = problem(&value).unwrap();
        let abstraction = InputAbstraction::new(&problem).unwrap();
        let values = abstraction.question().solve(&SolverOptions::default()).values;
        let cell = problem.initial_cell().unwrap().index();
        (values.lower[cell], values.upper[cell])
    };
    for rho in [0.8, -0.8] {
        let (lower, upper) = bounds(rho);
        // The cell is [0.75, 1)².
        let truths: Vec<f64> = [0.75, 1.0]
            .into_iter()
            .flat_map(|x| [0.75, 1.0].map(|y| stays([0.5 * x + 0.5, 0.5 * y + 0.5], rho)))
            .collect();
        let (least, most) =
            (truths.iter().copied().fold(1.0, f64::min), truths.iter().copied().fold(0.0, f64::max));
        assert!(lower <= least && lower > least - 0.08, "{rho}: {lower} {truths:?}");
        assert!(upper >= most && upper < most + 0.08, "{rho}: {upper} {truths:?}");
    }
    // The control: with the other sign of the correlation the bounds are wrong.
    assert!(bounds(0.8).0 > stays([0.875, 0.875], -0.8));
}

/// Known components, samples with independent components, samples alone: each knows less than the one before.
#[test]
fn what_is_assumed_pays() {
    let task = json!({"goal": [{"lower": [-3, -3], "upper": [-1, -1]}], "horizon": 5});
    let known = json!({"gaussian": {"variance": 0.25}});
    let known = json!({"components": [known, known]});
    let lower = |noise: &Value| {
        let mut value = model(noise, 12, &task);
        value["partition"]["resolution"] = json!([1, 1]);
        let problem = problem(&value).unwrap();
        let abstraction = InputAbstraction::new(&problem).unwrap();
        let assumed = abstraction.evidence.clone();
        assert_eq!(matches!(assumed, Evidence::Samples(_)), noise.get("count").is_some());
        let values = abstraction.question().solve(&SolverOptions::default()).values;
        values.lower[problem.initial_cell().unwrap().index()]
    };
    let all = [known, sampled(Some("intervals")), sampled(None)].map(|noise| lower(&noise));
    assert!(all.windows(2).all(|pair| pair[0] > pair[1] + 0.01), "{all:?}");
}

#[test]
fn mistakes_are_explained() {
    let task = json!({"type": "stay", "horizon": 2});
    let components = json!([{"gaussian": {"variance": 1}}, null]);
    for (noise, expected) in [
        (json!({"components": components, "independent": "bands"}), "/noise/independent"),
        (json!({"gaussian": {"covariance": [[1, 2], [2, 1]]}}), "negative eigenvalue"),
        (json!({"gaussian": {"covariance": [[1]]}}), "/noise/gaussian/covariance"),
        (json!({}), "/noise: found nothing"),
        (json!({"gaussian": {"covariance": [[1, 0], [0, 1]]}, "seed": 3}), "/noise/count"),
    ] {
        let error = problem(&model(&noise, 6, &task)).unwrap_err();
        assert!(error.contains(expected), "{noise}: {error}");
    }
    let few = json!({"gaussian": {"covariance": [[1, 0], [0, 1]]}, "count": 3});
    let error = InputAbstraction::new(&problem(&model(&few, 6, &task)).unwrap()).unwrap_err();
    assert!(error.to_string().contains("unseen"), "{error}");
}
