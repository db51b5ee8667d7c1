//! Expected costs, of actions that are inputs against the definition, of targets where all is known.

use assert_cmd::Command;
use serde_json::Value;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// `x⁺ = x + u + η` with `η` uniform on `[−1/2, 1/2]`, on cells of width 1; nothing is left to chance but two cells each.
const WALK: &str = r#"{
    "name": "walk", "dynamics": {"A": [[1]], "B": [[1]]}, "actions": "inputs",
    "noise": {"components": [{"uniform": {"lower": -0.5, "upper": 0.5}}]}, "input": {"list": [[1], [2]]},
    "partition": {"lower": [-2], "upper": [10], "cells": [12], "resolution": [1]},
    "costs": {"time": {"step": "1"}, "energy": {"step": "u1^2"}, "worth": {"step": "u1", "discount": 0.9}, "way": {"step": "x1 - 2"}},
    "task": {"goal": [{"lower": [4], "upper": [10]}], "horizon": 6}, "initial_state": [0.5]
}"#;

/// The least expected cost from the cell of 0, nature choosing which of two neighbours is met: the most and the least of it.
fn by_definition(horizon: u32, discount: f64, cost: impl Fn(i32, i32) -> [f64; 2]) -> [f64; 2] {
    [f64::max as fn(f64, f64) -> f64, f64::min].map(|nature| {
        let side = usize::from(nature(0.0, 1.0) == 0.0);
        let mut values = vec![0.0; 40];
        for _ in 0..horizon {
            let at = |cell: i32| if cell >= 4 { 0.0 } else { values[(cell + 10) as usize] };
            let next = |cell: i32| {
                let by = |input: i32| {
                    let [left, middle, right] = [-1, 0, 1].map(|by| at(cell + input + by));
                    cost(cell, input)[side] + discount * (nature(left, middle) + nature(middle, right)) / 2.0
                };
                by(1).min(by(2))
            };
            values = (-10..30).map(next).collect();
        }
        values[10]
    })
}

fn dynabs(directory: &Path, tool: &str, arguments: &[&str]) -> (i32, String) {
    let output = Command::cargo_bin(tool).unwrap().current_dir(directory).args(arguments).output().unwrap();
    let text = [output.stdout, output.stderr].concat();
    (output.status.code().unwrap(), String::from_utf8(text).unwrap())
}

fn bounds(directory: &Path, name: &str) -> [f64; 2] {
    let (code, text) = dynabs(directory, "dynabs-check", &["solve", "out", "-p", name, "--json", "-q"]);
    assert_eq!(code, 0, "{text}");
    let object: Value = serde_json::from_str(&text).unwrap();
    ["lower", "upper"].map(|end| object["results"][0][end].as_f64().unwrap())
}

#[test]
fn least_expected_costs_are_bounded_from_both_sides() {
    let scratch = TempDir::new().unwrap();
    let directory = scratch.path();
    let undiscounted = WALK.replace(r#", "discount": 0.9"#, "");
    for (text, encoding, discount) in [(WALK, "flat", 0.9), (&undiscounted[..], "plain", 1.0)] {
        fs::write(directory.join("walk.json"), text).unwrap();
        let arguments = ["walk.json", "-o", "out", "--force", "--encoding", encoding, "--quiet"];
        let (code, text) = dynabs(directory, "dynabs-compile", &arguments);
        assert_eq!(code, 0, "{text}");
        let way = |cell: i32, _| [(cell - 1).max(0), (cell - 2).max(0)].map(f64::from);
        for (name, discount, cost) in [
            ("time", 1.0, &(|_, _| [1.0; 2]) as &dyn Fn(i32, i32) -> [f64; 2]),
            ("energy", 1.0, &|_, input| [f64::from(input * input); 2]),
            ("worth", discount, &|_, input| [f64::from(input); 2]),
            ("way", 1.0, &way),
        ] {
            let [most, least] = by_definition(6, discount, cost);
            let found = [bounds(directory, name)[1], bounds(directory, &format!("{name}_least"))[0]];
            assert!(most <= found[0] && found[0] <= most + 1e-9, "{encoding} {name}: {found:?}, {most}");
            assert!(least - 1e-9 <= found[1] && found[1] <= least, "{encoding} {name}: {found:?}, {least}");
        }
        // Other programs' files say the same, and so do proofs.
        let (code, text) = dynabs(directory, "dynabs-check", &["diff", "out/model.dynabs", "out/model.tra"]);
        assert_eq!(code, 0, "{text}");
        let solve = ["solve", "out", "-p", "energy", "--certificate", "cost.cert", "-q"];
        assert_eq!(dynabs(directory, "dynabs-check", &solve).0, 0);
        let (code, text) = dynabs(directory, "dynabs-check", &["verify", "cost.cert", "out"]);
        assert!(code == 0 && text.contains("accepted"), "{text}");
    }
}

/// Cells of width 1 and noise that does not leave the cell of a target: a step leads where it is steered to.
#[test]
fn costs_of_steering_are_bounded_from_both_sides() {
    let scratch = TempDir::new().unwrap();
    let directory = scratch.path();
    let model = WALK
        .replace(r#""inputs""#, r#""targets""#)
        .replace(r#"{"lower": -0.5, "upper": 0.5}"#, r#"{"lower": -0.4, "upper": 0.4}"#)
        .replace(r#"{"list": [[1], [2]]}"#, r#"{"lower": [-2.6], "upper": [2.6]}"#)
        .replace(r#", "resolution": [1]"#, "");
    let compile = |text: &str| {
        fs::write(directory.join("walk.json"), text).unwrap();
        dynabs(directory, "dynabs-compile", &["walk.json", "-o", "out", "--force", "--quiet"])
    };
    assert_eq!(compile(&model), (0, String::new()));
    // Two steps lead to the goal; staying costs u² of at most 1/4 in each of 6 steps, and nothing in the middle of a cell.
    for (name, [most, least]) in [("time", [2.0, 2.0]), ("energy", [1.5, 0.0])] {
        let found = [bounds(directory, name)[1], bounds(directory, &format!("{name}_least"))[0]];
        assert!(most <= found[0] && found[0] <= most + 1e-6, "{name}: {found:?}");
        assert!(least - 1e-6 <= found[1] && found[1] <= least, "{name}: {found:?}");
    }
    let (_, text) = dynabs(directory, "dynabs-check", &["solve", "out", "-p", "energy"]);
    assert!(text.contains("covered: a controller keeps the expected cost at or below 1.5"), "{text}");
    let (_, text) =
        dynabs(directory, "dynabs-check", &["solve", "out", "-p", "R{\"energy\"}maxmax=? [ C<=6 ]"]);
    assert!(text.contains("not covered"), "{text}");
    let (code, text) = dynabs(directory, "dynabs-check", &["diff", "out/model.dynabs", "out/model.tra"]);
    assert_eq!(code, 0, "{text}");

    // Of the steps of a group only costs of inputs have a bound.
    let sampled = r#"{"gaussian": {"mean": [0], "covariance": [[0.001]]}, "count": 4000, "seed": 1}"#;
    let grouped = model
        .replace(r#""B": [[1]]"#, r#""B": [[1]], "group_steps": 2"#)
        .replace(r#"{"components": [{"uniform": {"lower": -0.4, "upper": 0.4}}]}"#, sampled);
    for (left_out, words) in
        [("worth", "/costs/way/step: found a cost of the state"), ("way", "/costs/worth/discount")]
    {
        let costs = grouped.replace(&format!("\"{left_out}\": "), "\"x\": ");
        let without = match left_out {
            "worth" => costs.replace(r#", "discount": 0.9"#, ""),
            _ => costs.replace("x1 - 2", "1"),
        };
        let (code, text) = compile(&without);
        assert!(code == 2 && text.contains(words), "{text}");
    }
    let simple = grouped.replace("x1 - 2", "1").replace(r#", "discount": 0.9"#, "");
    assert_eq!(compile(&simple).0, 0);
    let found = bounds(directory, "time");
    assert!(found[0] >= 2.0 && found[1] < 2.1, "{found:?}");
}

#[test]
fn costs_that_make_no_sense_are_refused() {
    let scratch = TempDir::new().unwrap();
    let directory = scratch.path();
    for (old, new, code, words) in [
        (r#"{"step": "1"}"#, r#"{"step": "1/x1"}"#, 2, "/costs/time/step: found no bound in cell"),
        (r#"{"step": "1"}"#, r#"{"step": "y"}"#, 2, "/costs/time/step (column 1)"),
        (r#"{"step": "1"}"#, r#"{"step": "1", "outside": -1}"#, 2, "/costs/time/outside: found -1"),
        (r#""discount": 0.9"#, r#""discount": 1"#, 2, "/costs/worth/discount: found 1"),
        (r#""time""#, r#""no name""#, 2, "expected a name of letters"),
        (r#""actions": "inputs""#, r#""actions": "targets""#, 2, "found a choice of inputs"),
        (r#""horizon": 6"#, r#""type": "stay", "horizon": "infinite""#, 2, "a task that never ends"),
    ] {
        let mut text = WALK.replace(old, new);
        if new.contains("stay") {
            text = text.replace(r#""goal": [{"lower": [4], "upper": [10]}], "#, "");
        }
        assert_ne!(text, WALK);
        fs::write(directory.join("walk.json"), text).unwrap();
        let arguments = ["walk.json", "-o", "out", "--force", "--encoding", "flat", "--quiet"];
        let (found, text) = dynabs(directory, "dynabs-compile", &arguments);
        assert!(found == code && text.contains(words), "{new}: {found}, {text}");
    }
}
