//! The models that files of actions "inputs" have: random small problems of every kind, solved on the lattice and by the
//! general solver; and what the command line makes of them.

use dynabs::abstraction::inputs::{InputAbstraction, InputEncoding, InputModel, InputsError};
use dynabs::model_file::{Document, StatedProblem};
use dynabs::problem::InputProblem;
use imdp::solver::{Answer, SolverOptions};
use rand::seq::IndexedRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha12Rng;
use serde_json::{Value, json};
use std::path::Path;
use std::process::{Command, Output};

/// What is random about the problems of a kind.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Noise {
    Known,
    Correlated,
    Sampled(Option<&'static str>),
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Task {
    Reach,
    Stay,
    ReachAt,
    Sequence,
    Formula,
}

const KINDS: [(Noise, Task); 12] = [
    (Noise::Known, Task::Reach),
    (Noise::Known, Task::Stay),
    (Noise::Known, Task::ReachAt),
    (Noise::Known, Task::Sequence),
    (Noise::Known, Task::Formula),
    (Noise::Correlated, Task::Reach),
    (Noise::Correlated, Task::Stay),
    (Noise::Sampled(None), Task::Reach),
    (Noise::Sampled(None), Task::Sequence),
    (Noise::Sampled(Some("intervals")), Task::Reach),
    (Noise::Sampled(Some("intervals")), Task::Stay),
    (Noise::Sampled(Some("bands")), Task::Reach),
];

/// Problems of a kind.
const EACH: u64 = 10;

const MAPS: [[&str; 2]; 5] = [
    ["0.8*x + 0.3*y + u", "0.7*y - 0.2*u"],
    ["x + 0.4*y", "y + u"],
    ["x + 0.5*sin(2*y) + u", "0.9*y + 0.3*u*cos(x)"],
    ["p*x + u", "0.8*y + 0.2*abs(x)"],
    ["max(x - 0.4, 0.5*x) + u", "clip(y + u, -1.4, 1.4)"],
];

fn number(rng: &mut ChaCha12Rng, lower: i32, upper: i32) -> f64 {
    f64::from(rng.random_range(lower..=upper)) / 20.0
}

fn noise(kind: Noise, rng: &mut ChaCha12Rng) -> Value {
    let one = |rng: &mut ChaCha12Rng| match rng.random_range(0..5) {
        0 => json!({"gaussian": {"deviation": number(rng, 4, 10)}}),
        1 => json!({"uniform": {"lower": number(rng, -16, -4), "upper": number(rng, 2, 16)}}),
        2 => json!({"laplace": {"scale": number(rng, 2, 6)}}),
        3 => json!({"atoms": {"values": [-0.5, 0, number(rng, 2, 16)], "weights": [1, 2, 1]}}),
        _ => Value::Null,
    };
    let (a, b) = (number(rng, 2, 6), number(rng, 2, 6));
    let covariance = json!([[a, 0.5 * a.min(b)], [0.5 * a.min(b), b]]);
    match kind {
        Noise::Known => json!({"components": [one(rng), one(rng)]}),
        Noise::Correlated => json!({"gaussian": {"covariance": covariance}}),
        Noise::Sampled(independent) => {
            let mut noise = json!({"gaussian": {"covariance": covariance}, "count": 3000, "seed": rng.random_range(0..99)});
            if let Some(independent) = independent {
                noise["independent"] = independent.into();
            }
            noise
        }
    }
}

fn task(kind: Task, rng: &mut ChaCha12Rng) -> Value {
    let horizon = rng.random_range(1..4);
    let goal = json!([{"lower": [number(rng, 0, 8), -2], "upper": [2, 2]}]);
    match kind {
        Task::Reach => {
            json!({"goal": goal, "unsafe": [{"lower": [-2, 1], "upper": [-1, 2]}], "horizon": horizon})
        }
        Task::Stay => {
            json!({"type": "stay", "safe": [{"lower": [-1.5, -2], "upper": [2, 2]}], "horizon": horizon})
        }
        Task::ReachAt => json!({"type": "reach_at", "goal": goal, "horizon": horizon}),
        Task::Sequence => {
            json!({"type": "sequence", "sequence": [{"reach": "a"}, {"reach": "b", "avoid": ["c"]}], "horizon": horizon})
        }
        Task::Formula => json!({"type": "formula", "formula": "F (a & X (!c U b))", "horizon": horizon + 1}),
    }
}

/// A problem in the square `[−2, 2]²`. Regions of tasks with a memory cut cells.
fn random((noise_kind, task_kind): (Noise, Task), seed: u64) -> Value {
    let mut rng = ChaCha12Rng::seed_from_u64(seed);
    let rng = &mut rng;
    let cells = [rng.random_range(3..6), rng.random_range(3..5)];
    let resolution = [rng.random_range(1..3), 1];
    json!({
        "name": "random",
        "dynamics": {
            "states": ["x", "y"], "inputs": ["u"], "parameters": {"p": [0.7, 0.9]}, "next": MAPS.choose(rng).unwrap()
        },
        "actions": "inputs",
        "noise": noise(noise_kind, rng),
        "input": {"lower": [-0.5], "upper": [0.5], "points": [rng.random_range(1..4)]},
        "partition": {
            "lower": [-2, -2], "upper": [2, 2], "cells": cells, "resolution": resolution,
            "periodic": [false, rng.random_range(0..4) == 0]
        },
        "regions": {
            "a": {"lower": [0.3, -1], "upper": [2, 1.2]},
            "b": {"lower": [-2, -2], "upper": [0, 2]},
            "c": {"lower": [-1, 1], "upper": [2, 2]}
        },
        "task": task(task_kind, rng)
    })
}

fn stated(value: &Value) -> InputProblem {
    let document = Document::parse(Path::new("m.json"), &value.to_string()).unwrap();
    match document.stated().unwrap_or_else(|error| panic!("{value:#}: {error}")) {
        StatedProblem::Inputs(problem) => *problem,
        StatedProblem::Targets(_) => panic!("actions are inputs"),
    }
}

/// Bounds of the general solver for the lower and the upper bound, by cell.
fn general(model: &InputModel) -> [Vec<(f64, f64)>; 2] {
    model.properties.clone().map(|property| {
        let answer = Answer::new(&model.model, &property, &SolverOptions::default()).unwrap();
        let of_state = |state: &imdp::model::StateId| {
            (answer.values.lower[state.index()], answer.values.upper[state.index()])
        };
        let is_least = property.to_string().contains("maxmin");
        let pick = |a: (f64, f64), b: (f64, f64)| match is_least {
            true => (a.0.min(b.0), a.1.min(b.1)),
            false => (a.0.max(b.0), a.1.max(b.1)),
        };
        model.of_cell.iter().map(|states| states.iter().map(of_state).reduce(pick).unwrap()).collect()
    })
}

#[test]
fn the_general_solver_gives_the_native_values() {
    let (mut positive, mut uncertain) = (0, 0);
    for (k, kind) in KINDS.into_iter().enumerate() {
        for seed in 0..EACH {
            let value = random(kind, 100 * k as u64 + seed);
            let problem = stated(&value);
            let abstraction = match InputAbstraction::new(&problem) {
                Ok(abstraction) => abstraction,
                Err(InputsError::LeavesPartition { .. }) => continue,
                Err(error) => panic!("{value:#}: {error}"),
            };
            let options = SolverOptions::default();
            let own = abstraction.question().solve(&options).values;
            let native = abstraction.exported().solve(&options).values;
            let model = abstraction.model(None, InputEncoding::Landing).unwrap();
            let flat = abstraction.model(None, InputEncoding::Flat).unwrap();
            let ([lower, upper], [flat_lower, flat_upper]) = (general(&model), general(&flat));
            for cell in 0..native.lower.len() {
                let of = |ends: (f64, f64), value: f64| ends.0 - 1e-9 <= value && value <= ends.1 + 1e-9;
                let (least, most) = (native.lower[cell], native.upper[cell]);
                assert!(of(lower[cell], least), "{value:#}: cell {cell}: {least} {:?}", lower[cell]);
                assert!(of(upper[cell], most), "{value:#}: cell {cell}: {most} {:?}", upper[cell]);
                // Flat intervals say less.
                assert!(
                    flat_lower[cell].0 <= own.lower[cell] + 1e-12,
                    "{value}: cell {cell}: {:?} {}",
                    flat_lower[cell],
                    own.lower[cell]
                );
                assert!(
                    flat_upper[cell].1 >= own.upper[cell] - 1e-12,
                    "{value}: cell {cell}: {:?} {}",
                    flat_upper[cell],
                    own.upper[cell]
                );
                positive += usize::from(flat_lower[cell].0 > 0.01 && flat_lower[cell].0 < 0.99);
                uncertain += usize::from(flat_lower[cell].1 < lower[cell].0 - 1e-3);
            }
        }
    }
    // The control: neither are all values trivial, nor all flat ones the same as those of the lattice.
    assert!(positive > 100 && uncertain > 100, "{positive} {uncertain}");
}

fn tool(program: &str, arguments: &[&str]) -> Output {
    let path = match program {
        "compile" => env!("CARGO_BIN_EXE_dynabs-compile"),
        _ => env!("CARGO_BIN_EXE_dynabs-check"),
    };
    Command::new(path).args(arguments).output().unwrap()
}

/// What a tool prints; it must succeed.
fn said(program: &str, arguments: &[&str]) -> String {
    let output = tool(program, arguments);
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{arguments:?}: {text}{}", String::from_utf8_lossy(&output.stderr));
    text
}

fn mistake(program: &str, arguments: &[&str]) -> String {
    let output = tool(program, arguments);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}");
    String::from_utf8(output.stderr).unwrap()
}

/// The bounds of the first result in `--json`.
fn bounds(json: &str) -> [f64; 2] {
    let value: Value = serde_json::from_str(json).unwrap();
    let result = value.get("result").unwrap_or_else(|| &value["results"][0]);
    ["lower", "upper"].map(|end| result[end].as_f64().unwrap())
}

#[test]
fn every_encoding_is_a_model_of_its_own() {
    let scratch = tempfile::tempdir().unwrap();
    let path = |name: &str| scratch.path().join(name).to_str().unwrap().to_owned();
    let mut value = random((Noise::Known, Task::Stay), 3);
    value["initial_state"] = json!([-1, 0]);
    value["input"]["points"] = json!([3]);
    value["task"]["horizon"] = 2.into();
    value["dynamics"]["next"] = json!(["0.5*x + u", "0.5*y - 0.2*u"]);
    value["noise"] =
        json!({"components": [{"gaussian": {"deviation": 0.7}}, {"uniform": {"lower": -0.4, "upper": 0.4}}]});
    value["partition"] = json!({"lower": [-2, -2], "upper": [2, 2], "cells": [8, 8]});
    std::fs::write(path("m.json"), value.to_string()).unwrap();
    let compile = |name: &str, more: &[&str]| {
        let (model, directory) = (path("m.json"), path(name));
        said("compile", &[&[model.as_str(), "-o", &directory, "--solve", "--json", "-q"], more].concat())
    };
    let native = bounds(&compile("plain", &["--format", "prism,drn,umb"]));
    // Whatever is read, it is the model of the directory.
    for file in ["plain/model.dynabs", "plain/model.drn", "plain/model.umb"] {
        let found = said("check", &["solve", &path(file), &path("plain/model.props"), "-p", "1", "--json"]);
        let found = bounds(&found);
        assert!((found[0] - native[0]).abs() < 1e-9, "{file}: {found:?} {native:?}");
    }
    assert!(native[0] > 0.3 && native[0] < 0.99, "{native:?}");
    compile("rows", &["--encoding", "rows", "--format", "prism,drn"]);
    let found = said("check", &["solve", &path("rows/rows.drn"), "-p", "1", "--json"]);
    assert!((bounds(&found)[0] - native[0]).abs() < 1e-9, "{found}");

    compile("pruned", &["--prune"]);
    let found = said("check", &["solve", &path("pruned/model.dynabs"), "--json"]);
    assert!((bounds(&found)[0] - native[0]).abs() < 1e-9, "{found}");
    let choices = |name: &str| {
        let manifest = std::fs::read_to_string(path(name) + "/manifest.json").unwrap();
        serde_json::from_str::<Value>(&manifest).unwrap()["choices"].as_u64().unwrap()
    };
    assert!(choices("pruned") < choices("plain"));

    let flat = compile("flat", &["--encoding", "flat"]);
    let exported = serde_json::from_str::<Value>(&flat).unwrap()["result"]["exported"].clone();
    let found = bounds(&said("check", &["solve", &path("flat/model.dynabs"), "-p", "1", "--json"]));
    assert_eq!(exported[0].as_f64().unwrap(), found[0]);
    assert!(found[0] < native[0], "{found:?} {native:?}");
}

#[test]
fn certificates_are_of_the_model_in_files() {
    let scratch = tempfile::tempdir().unwrap();
    let path = |name: &str| scratch.path().join(name).to_str().unwrap().to_owned();
    for (kind, seed) in [((Noise::Known, Task::Reach), 1), ((Noise::Sampled(None), Task::Stay), 2)] {
        let mut value = random(kind, seed);
        value["initial_state"] = json!([-0.9, 0]);
        std::fs::write(path("m.json"), value.to_string()).unwrap();
        let native =
            said("compile", &[&path("m.json"), "-o", &path("run"), "--force", "--solve", "--json", "-q"]);
        let certificate = path("certificate.json");
        let solved = said("check", &["solve", &path("run"), "--certificate", &certificate, "--json"]);
        assert!((bounds(&solved)[0] - bounds(&native)[0]).abs() < 1e-9, "{solved} {native}");
        said("check", &["verify", &certificate, &path("run")]);
        said("check", &["diff", &path("run"), &path("run")]);
        // The control: another model's certificate does not hold.
        value["noise"]["components"] = json!([{"uniform": {"lower": -2, "upper": 2}}, null]);
        for other in ["count", "gaussian", "seed"] {
            value["noise"].as_object_mut().unwrap().remove(other);
        }
        std::fs::write(path("m.json"), value.to_string()).unwrap();
        said("compile", &[&path("m.json"), "-o", &path("other"), "--force", "-q"]);
        assert!(!tool("check", &["verify", &certificate, &path("other")]).status.success());
    }
}

#[test]
fn what_leads_nowhere_is_a_mistake() {
    let scratch = tempfile::tempdir().unwrap();
    let path = |name: &str| scratch.path().join(name).to_str().unwrap().to_owned();
    let mut value = random((Noise::Known, Task::Reach), 1);
    value["noise"] = json!({"components": [{"gaussian": {"deviation": 0.1}}, null]});
    value["dynamics"]["next"] = json!(["x + 10*p", "y + u"]);
    std::fs::write(path("m.json"), value.to_string()).unwrap();
    let error = mistake("compile", &[&path("m.json"), "--dry-run"]);
    assert!(error.contains("out of the partition") && error.contains("x from 4"), "{error}");
    // Noise that leads back makes it a problem like others.
    value["noise"]["components"][0] = json!({"gaussian": {"mean": -8, "deviation": 1}});
    std::fs::write(path("m.json"), value.to_string()).unwrap();
    said("compile", &[&path("m.json"), "--dry-run"]);

    let targets = crate::common::root().join("models/double_integrator.json");
    let error = mistake("compile", &[targets.to_str().unwrap(), "--dry-run", "--encoding", "flat"]);
    assert!(error.contains("--encoding flat") && error.contains("plain"), "{error}");
}

/// The same bytes and values with any number of threads.
#[test]
fn threads_change_nothing() {
    let scratch = tempfile::tempdir().unwrap();
    let path = |name: &str| scratch.path().join(name).to_str().unwrap().to_owned();
    for kind in
        [(Noise::Known, Task::Formula), (Noise::Correlated, Task::Reach), (Noise::Sampled(None), Task::Stay)]
    {
        std::fs::write(path("m.json"), random(kind, 5).to_string()).unwrap();
        let files = |threads: &str| {
            let run = path("run");
            said("compile", &[&path("m.json"), "-o", &run, "--force", "-q", "--threads", threads]);
            let (values, policy) = (path("values"), path("policy"));
            said("check", &["solve", &run, "--values", &values, "--policy", &policy, "-q"]);
            let names = ["run/manifest.json", "run/model.dynabs", "run/model.tra", "values", "policy"];
            names.map(|name| std::fs::read(path(name)).unwrap())
        };
        let one = files("1");
        assert!(files("2") == one && files("3") == one, "{kind:?}");
    }
}
