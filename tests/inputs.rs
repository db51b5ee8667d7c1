//! Actions that are inputs, from the model file to the closed loop.

use dynabs::abstraction::inputs::InputAbstraction;
use dynabs::controller::{Controller, Decision, ParameterChoice, RunMemory, Simulation};
use dynabs::guarantee::Safety;
use dynabs::model_file::{Document, StatedProblem};
use dynabs::problem::InputProblem;
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
    let mut targets =
        car(json!({"type": "reach_at", "goal": [{"lower": [4, -4], "upper": [10, 0]}], "horizon": 3}), 10);
    targets["actions"] = "targets".into();
    targets["noise"] = json!({"gaussian": {"covariance": [[1, 0], [0, 1]]}, "count": 10});
    targets["input"] = json!({"lower": [-1, -1], "upper": [1, 1]});
    targets["partition"] = json!({"lower": [-10, -10], "upper": [10, 10], "cells": [10, 10]});
    let document = Document::parse(Path::new("m.json"), &targets.to_string()).unwrap();
    let error = document.stated().unwrap_err().to_string();
    assert!(error.contains("/task/type") && error.contains("\"inputs\""), "{error}");
}
