//! Actions that are inputs, from the model file to the closed loop.

use dynabs::abstraction::inputs::InputAbstraction;
use dynabs::controller::{Controller, Decision, ParameterChoice, RunMemory, Simulation};
use dynabs::geometry::Polytope;
use dynabs::model_file::{Document, StatedProblem};
use dynabs::problem::InputProblem;
use dynabs::system::{Demands, FeedbackLaw, ImageMap, ImageScratch, Lattice};
use dynabs::task::Safety;
use imdp::numeric::to_f64;
use imdp::property::Resolution;
use imdp::solver::{Answer, SolverOptions};
use serde_json::{Value, json};
use std::path::Path;

/// A small version of the car that parks (references: public benchmarks).
fn car(task: Value, cells: u32) -> Value {
    let noise = json!({"gaussian": {"deviation": 1}});
    json!({
        "name": "car",
        "dynamics": {"A": [[0.9, 0], [0, 0.9]], "B": [[0.7, 0], [0, 0.7]]},
        "noise": {"components": [noise, noise]},
        "input": {"lower": [-1, -1], "upper": [1, 1], "points": [3, 3]},
        "partition": {"lower": [-10, -10], "upper": [10, 10], "cells": [cells, cells], "resolution": [1, 1]},
        "task": task,
        "initial_state": [3, -2]
    })
}

fn reach() -> Value {
    json!({"goal": [{"lower": [4, -4], "upper": [10, 0]}], "unsafe": [{"lower": [4, 0], "upper": [10, 4]}], "horizon": 10})
}

fn problem(value: &Value) -> InputProblem {
    let document = Document::parse(Path::new("m.json"), &value.to_string()).unwrap();
    match document.stated().unwrap() {
        StatedProblem::Inputs(problem) => *problem,
        StatedProblem::Targets(_) => panic!("known noise makes actions inputs"),
    }
}

#[test]
fn the_general_solver_gives_the_native_values() {
    for task in [reach(), json!({"type": "stay", "horizon": 3})] {
        let problem = problem(&car(task, 10));
        let abstraction = InputAbstraction::new(&problem).unwrap();
        let solution = abstraction.question().solve(&SolverOptions::default());
        let encoded = abstraction.question().model(&abstraction.initial(problem.initial_cell())).unwrap();
        let cell = problem.initial_cell().unwrap().index();
        for (resolution, own) in [
            (Resolution::Pmaxmin, solution.values.lower[cell]),
            (Resolution::Pmaxmax, solution.values.upper[cell]),
        ] {
            let property = abstraction.property(resolution);
            let answer = Answer::new(&encoded.model, &property, &SolverOptions::default()).unwrap();
            assert!(answer.lower - 1e-9 <= own && own <= answer.upper + 1e-9, "{property}: {own} {answer:?}");
        }
    }
}

#[test]
fn bounds_enclose_what_happens() {
    for task in [reach(), json!({"type": "stay", "horizon": 3})] {
        let problem = problem(&car(task, 20));
        let abstraction = InputAbstraction::new(&problem).unwrap();
        let solution = abstraction.question().solve(&SolverOptions::default());
        let controller = Controller::of_inputs(&problem, &abstraction, &solution);
        let simulation = Simulation::of_inputs(&problem, &controller, ParameterChoice::Random, 10);
        let tally = simulation.tally(&[3.0, -2.0], 1, 2000, &());
        let seen = tally.satisfaction(Safety::EveryStep, 1e-6);
        let cell = problem.initial_cell().unwrap().index();
        assert!(solution.values.lower[cell] > 0.1, "{}", solution.values.lower[cell]);
        assert!(
            seen.upper >= solution.values.lower[cell] && seen.lower <= solution.values.upper[cell],
            "{seen:?}"
        );
        assert_eq!(tally.violations, 0);
    }
}

/// In one coordinate with one input the value after one step is an integral.
#[test]
fn one_step_has_its_probability() {
    let value = json!({
        "name": "line",
        "dynamics": {"A": [[0.5]]},
        "noise": {"components": [{"uniform": {"lower": -1, "upper": 1}}]},
        "partition": {"lower": [-4], "upper": [4], "cells": [64], "resolution": [4]},
        "task": {"type": "stay", "safe": [{"lower": [-1], "upper": [1]}], "horizon": 1},
        "initial_state": [0.9]
    });
    let problem = problem(&value);
    let abstraction = InputAbstraction::new(&problem).unwrap();
    let values = abstraction.question().solve(&SolverOptions::default()).values;
    let cell = problem.initial_cell().unwrap();
    // From x in [0.875, 1) it stays if the noise is below 1 − x/2: with probability 1 − x/4 at least 0.75.
    assert!(values.lower[cell.index()] <= 0.75 && values.lower[cell.index()] > 0.72, "{values:?}");
    assert!(values.upper[cell.index()] >= 1.0 - 0.875 / 4.0 && values.upper[cell.index()] < 0.81);
}

#[test]
fn inputs_come_from_the_law() {
    let problem = problem(&car(reach(), 10));
    let abstraction = InputAbstraction::new(&problem).unwrap();
    let solution = abstraction.question().solve(&SolverOptions::default());
    let controller = Controller::of_inputs(&problem, &abstraction, &solution);
    let mut u = [0.0; 2];
    let first = |x: &[f64], k, u: &mut [f64]| controller.control(x, k, &mut RunMemory::default(), u);
    let Decision::Act { action } = first(&[3.0, -2.0], 0, &mut u) else { panic!("nothing to do") };
    assert_eq!(u, controller.action(action));
    assert_eq!(first(&[5.0, -2.0], 0, &mut u), Decision::Reached);
    assert_eq!(first(&[5.0, 2.0], 0, &mut u), Decision::Unsafe);
    assert_eq!(first(&[f64::NAN, 2.0], 0, &mut u), Decision::Outside);
    assert_eq!(first(&[3.0, -2.0], 10, &mut u), Decision::Over);
}

/// With `K = B⁻¹A` the action is the paper's: from every state of the cell to one point, by the same law.
#[test]
fn full_feedback_steers_to_a_point() {
    let (a, b) = ([[0.9, 0.25], [-0.125, 0.75]], [[0.5, 0.0], [0.25, 0.5]]);
    // B⁻¹A.
    let gain = [[1.8, 0.5], [-1.15, 1.25]];
    let mut value = car(reach(), 20);
    value["dynamics"] = json!({"A": a, "B": b});
    value["input"] = json!({"lower": [-5, -5], "upper": [5, 5], "points": [4, 3]});
    value["feedback"] = json!({"gain": gain});
    let problem = problem(&value);
    let lattice = Lattice::new(problem.grid(), &[1, 1], &[true, true]);
    let images = ImageMap::new(problem.mode(), problem.feedback(), problem.grid(), lattice, problem.inputs());
    let system = problem.mode().as_linear().unwrap();
    let law = FeedbackLaw::new(&system, &Polytope::from_box(&[], &[]), None, &Demands::default()).unwrap();
    let matrices = (law.target_gain(), law.state_gain(), law.constant());
    let mut scratch = ImageScratch::default();
    for cell in [[3, 17], [10, 9], [0, 0]] {
        let center = cell.map(|i| f64::from(i) - 9.5);
        for (input, nominal) in problem.inputs().iter().enumerate() {
            for j in 0..2 {
                let range = images.range(images.row(input, j), &cell, &mut scratch).unwrap();
                assert_eq!(range.first, range.last, "{cell:?} {input}");
            }
            let nominal: Vec<f64> = nominal.iter().map(to_f64).collect();
            let row = |m: [[f64; 2]; 2], x: &[f64], j: usize| m[j][0] * x[0] + m[j][1] * x[1];
            let target = [0, 1].map(|j| row(a, &center, j) + row(b, &nominal, j));
            for corner in [[-0.5, -0.5], [0.25, 0.5], [0.0, 0.0]] {
                let x = [center[0] + corner[0], center[1] + corner[1]];
                let mut u = [0.0; 2];
                problem.feedback().input(&nominal, &x, &center, &mut u);
                for i in 0..2 {
                    let at = |m: &nalgebra::DMatrix<f64>, v: [f64; 2]| m[(i, 0)] * v[0] + m[(i, 1)] * v[1];
                    let paper = at(&matrices.0, target) + at(&matrices.1, x) + matrices.2[(i, 0)];
                    assert!((paper - u[i]).abs() < 1e-12, "{paper} {u:?}");
                }
            }
        }
    }
    // The control: with half of it the image is no point.
    value["feedback"] = json!({"gain": gain.map(|row| row.map(|k| k / 2.0))});
    let problem = self::problem(&value);
    let lattice = Lattice::new(problem.grid(), &[4, 4], &[true, true]);
    let images = ImageMap::new(problem.mode(), problem.feedback(), problem.grid(), lattice, problem.inputs());
    let range = images.range(images.row(0, 0), &[3, 17], &mut scratch).unwrap();
    assert!(range.last > range.first);
}

#[test]
fn mistakes_are_explained() {
    let mistake = |pointer: &str, value: Value| {
        let mut model = car(reach(), 10);
        *model.pointer_mut(pointer).unwrap() = value;
        let document = Document::parse(Path::new("m.json"), &model.to_string()).unwrap();
        document.stated().unwrap_err().to_string()
    };
    for (pointer, value, expected) in [
        ("/noise/components", json!([null]), "/noise/components"),
        (
            "/noise/components/0",
            json!({"gaussian": {"deviation": -1}}),
            "/noise/components/0/gaussian/deviation",
        ),
        ("/noise/components/1", json!({"uniform": {"lower": 1, "upper": 0}}), "lower < upper"),
        ("/input/points", json!([0, 3]), "/input/points"),
        ("/partition/resolution", json!([1, 1000]), "/partition/resolution/1"),
    ] {
        let error = mistake(pointer, value);
        assert!(error.contains(expected), "{pointer}: {error}");
    }
}
