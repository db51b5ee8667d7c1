//! Dynamics in model files: what is understood, and what is refused, where and why.

use dynabs::abstraction::inputs::InputAbstraction;
use dynabs::model_file::{Document, StatedProblem};
use dynabs::system::{Discretisation, ImageMap, ImageScratch, Lattice, Mode};
use std::path::Path;

const CAR: &str = r#"{
    "name": "car",
    "dynamics": {
        "states": ["p", "v"], "inputs": ["a"], "units": {"p": "m"},
        "parameters": {"mass": [0.75, 1.25]},
        "constants": {"tau": 0.1, "drag": "2*tau"},
        "definitions": {"force": "a - drag*v*abs(v)"},
        "next": ["p + tau*v", "v + tau*force/mass"]
    },
    "noise": {"components": [null, {"gaussian": {"variance": 0.01}}]},
    "input": {"lower": [-1], "upper": [1], "points": [5]},
    "partition": {"lower": [-2, -2], "upper": [2, 2], "cells": [20, 20]},
    "task": {"goal": [{"lower": [1, null], "upper": [2, null]}], "horizon": 20}
}"#;

fn stated(set: &[&str]) -> Result<Box<dynabs::problem::InputProblem>, String> {
    let mut document = Document::parse(Path::new("car.json"), CAR).unwrap();
    for argument in set {
        document.set(&argument.parse().unwrap()).unwrap();
    }
    match document.stated() {
        Ok(StatedProblem::Inputs(problem)) => Ok(problem),
        Ok(StatedProblem::Targets(_)) => Err("targets".into()),
        Err(error) => Err(error.to_string()),
    }
}

fn step(mode: &Mode, x: &[f64], u: &[f64], parameters: &[f64]) -> Vec<f64> {
    let mut next = vec![0.0; x.len()];
    mode.step(x, u, parameters, &mut Vec::new(), &mut next);
    next
}

#[test]
fn names_constants_and_definitions() {
    let problem = stated(&[]).unwrap();
    let mode = problem.mode();
    assert_eq!(mode.states()[0].unit.as_deref(), Some("m"));
    assert_eq!(mode.inputs()[0].name, "a");
    let next = step(mode, &[1.0, -2.0], &[0.5], &[1.0]);
    assert!((next[0] - 0.8).abs() < 1e-15 && (next[1] - (-2.0 + 0.1 * (0.5 + 0.8))).abs() < 1e-15);
}

#[test]
fn one_input_held_for_several_steps() {
    let (once, thrice) = (stated(&[]).unwrap(), stated(&["/dynamics/hold=3"]).unwrap());
    let mut x = vec![0.3, 0.7];
    for _ in 0..3 {
        x = step(once.mode(), &x, &[-0.4], &[0.9]);
    }
    let held = step(thrice.mode(), &[0.3, 0.7], &[-0.4], &[0.9]);
    assert!((held[0] - x[0]).abs() < 1e-14 && (held[1] - x[1]).abs() < 1e-14);
}

#[test]
fn differential_equations() {
    let smooth = "/dynamics/definitions/force=\"a - drag*v\"";
    let rates = "/dynamics/derivative=[\"v\",\"force\"]";
    let dynamics = ["/dynamics/next=null", smooth, rates, "/dynamics/sample_time=0.5"];
    let problem = stated(&dynamics).unwrap();
    // v̇ = a − 0.2 v.
    let exact = 2.0 + (1.0 - 2.0) * (-0.1f64).exp();
    let next = step(problem.mode(), &[0.0, 1.0], &[0.4], &[1.0]);
    assert!((next[1] - exact).abs() < 1e-6, "{next:?}, not {exact}");
    let how = problem.mode().discretisation().unwrap().to_string();
    assert!(how.starts_with("0.5 of time, by a Taylor series of degree"), "{how}");
    assert_eq!(stated(&[]).unwrap().mode().discretisation(), None);

    let matrices = "/dynamics={\"A\":[[0,1],[0,0]],\"B\":[[0],[1]],\"sample_time\":0.5}";
    let problem = stated(&[matrices]).unwrap();
    assert_eq!(step(problem.mode(), &[1.0, 2.0], &[4.0], &[]), [2.5, 4.0]);
    assert_eq!(problem.mode().discretisation(), Some(&Discretisation::Exact { time: 0.5 }));
}

/// Several modes to choose from: an input that selects, in a list. Every image is that of one mode, exactly.
#[test]
fn modes_are_inputs_that_select() {
    let select = "/dynamics={\"states\":[\"x\",\"y\"],\"inputs\":[\"m\"],\"next\":[\"m*(0.5*x) + (1 - m)*(0.25*y)\",\"(1 - m)*y\"]}";
    let problem = stated(&[select, "/input={\"list\":[[0],[1]]}"]).unwrap();
    let lattice = Lattice::new(problem.grid(), &[1, 1], &[true, true]);
    let images = ImageMap::new(problem.mode(), problem.feedback(), problem.grid(), lattice, problem.inputs());
    let mut scratch = ImageScratch::default();
    let mut range = |input, j| {
        let row = images.row(input, j);
        assert!(images.is_exact(row));
        let range = images.range(row, &[15, 5], &mut scratch).unwrap();
        (range.first, range.last)
    };
    // The cell [1, 1.2) × [−1, −0.8): x⁺ in [−0.25, −0.2) or [0.5, 0.6), y⁺ in [−1, −0.8) or 0.
    assert_eq!([range(0, 0), range(0, 1), range(1, 0)], [(8, 8), (5, 5), (12, 12)]);
    assert_eq!(images.depends_on(images.row(1, 0)), [0]);
}

/// Modes that switch by chance: a coordinate that noise of two atoms throws, and a `clip` that is 0 or 1 there. Every image
/// is that of one mode.
#[test]
fn modes_that_switch_by_chance_are_a_coordinate() {
    let switch = "/dynamics={\"states\":[\"x\",\"m\"],\"inputs\":[\"u\"],\"definitions\":{\"second\":\"clip(m - 1, 0, 1)\"},\
                  \"next\":[\"(1 - second)*0.5*x + second*2*x + u\",\"0\"]}";
    let noise = "/noise={\"components\":[{\"uniform\":{\"lower\":-0.1,\"upper\":0.1}},\
                 {\"atoms\":{\"values\":[0.5,2.5],\"weights\":[0.7,0.3]}}]}";
    let partition = "/partition={\"lower\":[-2,0],\"upper\":[2,3],\"cells\":[16,3]}";
    let problem = stated(&[switch, noise, partition, "/input={\"list\":[[0]]}"]).unwrap();
    let lattice = Lattice::new(problem.grid(), &[1, 1], &[true, true]);
    let images = ImageMap::new(problem.mode(), problem.feedback(), problem.grid(), lattice, problem.inputs());
    let mut scratch = ImageScratch::default();
    let mut image = |m| {
        let range = images.range(images.row(0, 0), &[10, m], &mut scratch).unwrap();
        (range.first, range.last)
    };
    // The cell [0.5, 0.75) of x: x⁺ in [0.25, 0.375), or [1, 1.5).
    assert_eq!([image(0), image(2)], [(9, 9), (12, 13)]);
}

#[test]
fn feedback_leaves_its_share_of_the_inputs() {
    let problem = stated(&["/feedback={\"gain\":[[0,2]]}"]).unwrap();
    // Cells are 0.2 wide: the feedback moves the input by up to 0.2, so nominal inputs end at ±0.8.
    let ends: Vec<_> = problem.inputs().iter().map(|u| u[0].to_string()).collect();
    assert_eq!(ends, ["-4/5", "-2/5", "0", "2/5", "4/5"]);
    for feedback in ["{\"narrow\":0.3}", "{\"lqr\":{\"Q\":[[1,0],[0,1]],\"R\":[[1]],\"decimals\":3}}"] {
        let problem = stated(&[&format!("/feedback={feedback}")]);
        assert!(!problem.unwrap().feedback().is_none(), "{feedback}");
    }
}

#[test]
fn mistakes_have_a_place_and_a_remedy() {
    let mut others = Vec::new();
    let long = format!("/dynamics/next/0=\"p{}\"", "+p".repeat(40_000));
    let deep = format!("/dynamics/next/0=\"{}p{}\"", "(".repeat(300), ")".repeat(300));
    for (set, expected) in [
        (&["/dynamics/next/1=\"v + f\""][..], "/dynamics/next/1 (column 5): found the unknown name \"f\""),
        (&["/dynamics/next/0=\"p + 2 v\""], "/dynamics/next/0 (column 7): found \"v\""),
        (&["/dynamics/next/0=\"p/(1-1)\""], "(column 2): found a division by 0"),
        (&["/dynamics/next=[\"p\"]"], "/dynamics/states: found 2 names; expected 1"),
        (&["/dynamics/constants/drag=\"2*v\""], "/dynamics/constants/drag (column 3)"),
        (&["/dynamics/definitions/p=\"1\""], "/dynamics/definitions/p"),
        (&["/dynamics/definitions/sin=\"1\""], "has a meaning of its own"),
        (&["/dynamics/parameters/mass=[2,1]"], "/dynamics/parameters/mass: found [2, 1]"),
        (&["/dynamics/parameters/mass=1"], "/dynamics/parameters/mass"),
        (&["/dynamics/hold=0"], "/dynamics/hold"),
        (&["/dynamics/units/q=\"m\""], "/dynamics/units/q"),
        (&["/dynamics/inputs=[\"a\",\"b\"]"], "/input"),
        (&["/dynamics/A=[[1,0],[0,1]]"], "found A, next"),
        (&["/dynamics/sample_time=0.1"], "/dynamics/sample_time"),
        (&["/dynamics/next=null"], "exactly one of A, next and derivative"),
        (
            &["/dynamics/next=null", "/dynamics/derivative=[\"v\",\"force\"]"],
            "derivative without sample_time",
        ),
        (
            &["/dynamics/next=null", "/dynamics/derivative=[\"v\",\"force\"]", "/dynamics/sample_time=0.1"],
            "which has a kink",
        ),
        (&["/feedback={}"], "/feedback: found none of them"),
        (&["/feedback={\"gain\":[[1]]}"], "/feedback/gain"),
        (&["/feedback={\"gain\":[[0,100]]}"], "leaves room for the feedback"),
        (&["/feedback={\"narrow\":2}"], "/feedback/narrow"),
        (&["/actions=\"targets\""], "actions\": \"inputs\""),
        (&[&deep], "nested more than"),
        (&[&long], "at most 65536"),
    ] {
        let error = stated(set).err().unwrap_or_else(|| panic!("{set:?} is no mistake"));
        if !error.contains(expected) {
            others.push(format!("{set:?}: {error}"));
        }
    }
    assert!(others.is_empty(), "{others:#?}");
}

/// What is only undefined somewhere in the partition is found where images are computed: place, column, remedy.
#[test]
fn what_is_undefined_somewhere_is_explained() {
    for (text, expected) in [
        ("p + 0.1/v", ["/dynamics/next/0 (column 8)", "a division by [", "a divisor that is never 0"]),
        ("sqrt(p + 1)", ["/dynamics/next/0 (column 1)", "sqrt of [", "an argument that is never negative"]),
        ("p + ln(1 + 0.2*a + v)", ["/dynamics/next/0 (column 5)", "ln of [", "a positive argument"]),
        ("tan(p)", ["/dynamics/next/0 (column 1)", "tan of [", "between two poles"]),
        ("asin(p)", ["/dynamics/next/0 (column 1)", "asin or acos of [", "in [-1, 1]"]),
        ("v^-2", ["/dynamics/next/0", "a negative power of [", "never 0"]),
        ("exp(exp(exp(9 + p)))", ["/dynamics/next/0", "without bound", "range of doubles"]),
    ] {
        let problem = stated(&[&format!("/dynamics/next/0=\"{text}\"")]).unwrap();
        let error = InputAbstraction::new(&problem).unwrap_err().to_string();
        for part in expected {
            assert!(error.contains(part), "{text}: {error}");
        }
        assert!(error.contains("cell") && error.contains("with max, min or clip"), "{error}");
    }
}

#[test]
fn benchmarks_are_understood() {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("models/benchmarks");
    let mut models: Vec<_> =
        std::fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().path()).collect();
    models.sort();
    assert!(models.len() >= 20);
    for path in models {
        let document = Document::parse(&path, &std::fs::read_to_string(&path).unwrap()).unwrap();
        let stated = document.stated().unwrap_or_else(|error| panic!("{error}"));
        let StatedProblem::Inputs(problem) = stated else { panic!("{}: targets", path.display()) };
        let name = path.file_stem().unwrap().to_str().unwrap();
        assert_eq!(problem.name(), name);
    }
}
