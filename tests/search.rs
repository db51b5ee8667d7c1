//! `dynabs-compile --search`: the cheapest setting with a wanted bound, with all that is said of it.
use crate::common::root;
use assert_cmd::Command;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};

struct Search {
    directory: tempfile::TempDir,
}

impl Search {
    fn of(spec: &Value) -> Self {
        let directory = tempfile::tempdir().unwrap();
        fs::write(directory.path().join("spec.json"), spec.to_string()).unwrap();
        Self { directory }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    fn out(&self) -> PathBuf {
        self.path("out")
    }

    /// The exit code and what was printed.
    fn run(&self, options: &[&str]) -> (i32, String) {
        let mut command = Command::cargo_bin("dynabs-compile").unwrap();
        command.arg("--search").arg(self.path("spec.json")).arg("-o").arg(self.out()).args(options);
        let output = command.output().unwrap();
        let text = [output.stdout, output.stderr].concat();
        (output.status.code().unwrap(), String::from_utf8(text).unwrap())
    }

    fn found(&self) -> (i32, Value) {
        let (code, text) = self.run(&["--json", "-q"]);
        (code, serde_json::from_str(&text).unwrap_or_else(|_| panic!("{text}")))
    }

    fn read(&self, name: &str) -> Value {
        serde_json::from_str(&fs::read_to_string(self.out().join(name)).unwrap()).unwrap()
    }
}

fn room() -> PathBuf {
    root().join("models/room_temperature.json")
}

/// Grids and ranges around a plan, from small to large.
fn settings() -> Value {
    let plan = |u: f64| json!({"track": "auto", "abstract_input": {"lower": [-u], "upper": [u]}});
    json!({"/partition/cells": [[24], [48]], "/stabilizer": [plan(0.3), plan(1.0), null]})
}

fn states(found: &Value) -> Vec<&str> {
    found["settings"].as_array().unwrap().iter().map(|one| one["state"].as_str().unwrap()).collect()
}

#[test]
fn the_cheapest_is_found_and_what_costs_more_is_not_tried() {
    let spec = |wanted: Option<f64>| {
        let mut spec = json!({"model": room(), "settings": settings()});
        spec.as_object_mut().unwrap().extend(wanted.map(|wanted| ("wanted".to_owned(), wanted.into())));
        spec
    };
    let all = Search::of(&spec(None));
    let (code, everything) = all.found();
    assert!(code == 0 && everything["chosen"].is_null(), "{everything}");
    assert!(states(&everything).iter().all(|&state| state == "tried"), "{everything}");

    let search = Search::of(&spec(Some(0.95)));
    let (code, found) = search.found();
    assert_eq!(code, 0, "{found}");
    let number = |one: &Value, name: &str| one[name].as_f64().unwrap();
    let good = everything["settings"].as_array().unwrap().iter().filter(|one| number(one, "lower") >= 0.95);
    let best = good.min_by(|one, other| number(one, "transitions").total_cmp(&number(other, "transitions")));
    assert_eq!(found["chosen"]["job"], best.unwrap()["job"]);
    assert_eq!(found["chosen"]["lower"], best.unwrap()["lower"]);
    assert!(states(&found).contains(&"not needed"), "{found}");
    let chosen = best.unwrap()["transitions"].as_f64().unwrap();
    for (one, other) in
        found["settings"].as_array().unwrap().iter().zip(everything["settings"].as_array().unwrap())
    {
        // What was not tried costs no less, and nothing was tried that is dearer.
        assert_eq!(one["transitions"], other["transitions"]);
        assert_eq!(
            one["state"] == "not needed",
            number(one, "transitions") >= chosen && one["job"] != found["chosen"]["job"]
        );
    }

    // Every promise has its part, and the run is one like any other.
    let setting = search.read("chosen/job.json")["settings"].clone();
    assert_eq!(setting["/probabilities/sweep"], 6);
    let run = search.out().join("chosen/run");
    let mut check = Command::cargo_bin("dynabs-check").unwrap();
    let answer = check.args(["solve", run.to_str().unwrap(), "--json", "-q"]).output().unwrap();
    let answer: Value = serde_json::from_slice(&answer.stdout).unwrap();
    assert_eq!(answer["results"][0]["lower"].as_f64(), found["chosen"]["lower"].as_f64(), "{answer}");
    assert!(run.join("model.tra").is_file() && run.join("problem.json").is_file());
}

#[test]
fn what_was_tried_is_not_tried_again_and_the_bytes_are_the_same() {
    let search = Search::of(&json!({"model": room(), "settings": settings(), "wanted": 0.95}));
    assert_eq!(search.found().0, 0);
    let names =
        ["search.json", "table.csv", "trade-off.svg", "chosen/run/problem.json", "chosen/run/model.dynabs"];
    let bytes = || names.map(|name| fs::read(search.out().join(name)).unwrap());
    let before = bytes();
    let time = |name: &str| fs::metadata(search.out().join(name)).unwrap().modified().unwrap();
    let first = (time("0001/result.json"), time("chosen/result.json"));
    // As if it had been killed: one result is missing, one is half written.
    fs::remove_file(search.out().join("0004/size.json")).unwrap();
    fs::write(search.out().join("0004/size.json.part"), "{").unwrap();
    fs::remove_file(search.out().join("table.csv")).unwrap();
    let (code, text) = search.run(&[]);
    assert!(code == 0 && text.contains("| chosen |") && text.contains("chosen: 000"), "{text}");
    assert!(bytes() == before);
    assert_eq!((time("0001/result.json"), time("chosen/result.json")), first);
    assert!(String::from_utf8_lossy(&before[2]).contains("class=\"threshold\""));
}

#[test]
fn nothing_is_promised_that_no_setting_has() {
    let search = Search::of(&json!({"settings": {"/partition/cells": [[12], [24]]}, "wanted": 0.9999}));
    let (code, text) = search.run(&[room().to_str().unwrap()]);
    assert!(
        code == 1 && text.contains("none of these settings has at least 0.9999; the best has 0."),
        "{text}"
    );
    assert!(!search.out().join("chosen").exists());
}

/// A choice that looked at half of the samples has its promise from the other half, and all of the confidence.
#[test]
fn split_samples_are_looked_at_once_and_promise_once() {
    let spec = json!({"model": room(), "settings": settings(), "wanted": 0.9, "samples": "split"});
    let drawn = Search::of(&spec);
    let (code, found) = drawn.found();
    assert!(code == 0 && found["chosen"]["fresh_samples"] == true, "{found}");
    let job = format!("{}/job.json", found["chosen"]["job"].as_str().unwrap());
    let (looked, promised) = (drawn.read(&job), drawn.read("chosen/job.json"));
    let noise =
        |job: &Value| ["/noise/count", "/noise/seed"].map(|pointer| job["settings"][pointer].as_u64());
    assert_eq!(noise(&looked), [Some(1000), Some(1)]);
    assert_eq!(noise(&promised), [Some(1000), Some(0)]);
    assert!(promised["settings"].get("/probabilities/sweep").is_none());

    // Measured ones are cut in two, and none is lost.
    let values: Vec<f64> = (0..401).map(|i| 0.4 * (f64::from(i * 37 % 401) / 401.0 - 0.5)).collect();
    let text = fs::read_to_string(room()).unwrap();
    let mut model: Value = serde_json::from_str(&text).unwrap();
    model["noise"] = json!({"samples": {"file": "noise.csv", "of": "step"}});
    let spec = json!({"model": "room.json", "settings": {"/partition/cells": [[24]]}, "wanted": 0.5, "samples": "split"});
    let measured = Search::of(&spec);
    fs::write(measured.path("room.json"), model.to_string()).unwrap();
    let lines: String = values.iter().map(|value| format!("{value}\n")).collect();
    fs::write(measured.path("noise.csv"), &lines).unwrap();
    let (code, found) = measured.found();
    assert_eq!(code, 0, "{found}");
    let half = |name: &str| fs::read_to_string(measured.out().join(name)).unwrap();
    assert_eq!(half("look.csv") + &half("promise.csv"), lines);
    assert_eq!(half("look.csv").lines().count(), 200);
    assert_eq!(measured.read("chosen/result.json")["samples"], 201);
    assert_eq!(half("chosen/run/noise.csv").trim_end(), half("promise.csv").trim_end());
}

/// Where actions are inputs no controller exceeds the upper bound, however fine its cells: what cannot do is not tried.
#[test]
fn what_no_controller_can_do_is_not_tried() {
    let model = json!({
        "name": "walk", "dynamics": {"A": [[1]], "B": [[1]]}, "noise": {"components": [{"gaussian": {"deviation": 1}}]},
        "input": {"lower": [-1], "upper": [1], "points": [3]}, "partition": {"lower": [-5], "upper": [5], "cells": [10]},
        "task": {"type": "stay", "horizon": 8}, "initial_state": [0.25],
    });
    let spec = json!({"model": "walk.json", "settings": {"/partition/cells": [[40], [80]], "/feedback": [null, {"narrow": 0.25}]},
        "wanted": 0.9999});
    let search = Search::of(&spec);
    fs::write(search.path("walk.json"), model.to_string()).unwrap();
    let (code, found) = search.found();
    let states = states(&found);
    assert_eq!(code, 1, "{found}");
    // With feedback other inputs are taken, so nothing is known of the finer grid.
    assert!(states[0] == "tried" && states[1] == "tried" && states[3] == "tried", "{found}");
    assert!(
        states[2].starts_with("excluded: no controller exceeds 0.") && states[2].ends_with("(0001)"),
        "{found}"
    );
    // Nothing rests on samples, so there is nothing to share.
    assert!(search.read("0001/job.json")["settings"].as_object().unwrap().len() == 2);
    assert!(found["settings"][2]["lower"].is_null() && found["settings"][2]["choices"].is_u64(), "{found}");
}

/// The tables of a controller are known only when it is: what cannot have smaller ones is not tried.
#[test]
fn tables_are_counted_in_bytes() {
    let settings = json!({"/partition/cells": [[24], [48], [960]]});
    let search = Search::of(&json!({"model": room(), "settings": settings, "wanted": 0.9, "cost": "table"}));
    let (code, found) = search.found();
    assert_eq!(code, 0, "{found}");
    let bytes = found["settings"][0]["controller_bytes"].as_u64().unwrap();
    assert!(found["chosen"]["job"] == "0001" && bytes > 24 && bytes < 960, "{found}");
    assert_eq!(states(&found)[2], "not needed");
    let file = search.path("tables.npz");
    let mut export = Command::cargo_bin("dynabs-check").unwrap();
    let run = search.out().join("chosen/run");
    export.arg("controller").arg(run).arg("-o").arg(&file).arg("-q").assert().success();
    assert!(fs::metadata(&file).unwrap().len() > bytes);
}

#[test]
fn mistakes_are_found_before_anything_is_tried() {
    let model = room();
    let name = model.to_str().unwrap();
    let wrong = [
        (json!({"settings": {"/task/horizont": [1]}, "model": name}), vec![], "/task"),
        (json!({"settings": [], "model": name}), vec![], "at least one"),
        (
            json!({"settings": [{}], "model": name, "wanted": 1.5}),
            vec![],
            "/wanted: found 1.5; expected a probability",
        ),
        (json!({"settings": [{}], "model": name, "cost": "money"}), vec![], "unknown variant `money`"),
        (json!({"settings": [{}], "model": name, "wnted": 0.5}), vec![], "unknown field `wnted`"),
        (json!({"settings": [{}]}), vec![], "/model: found no model"),
        (json!({"settings": [{}], "model": name}), vec![name], "/model: found a second one"),
        (json!({"settings": [{}], "model": "gone.json"}), vec![], "gone.json"),
        (
            json!({"settings": {"/noise/count": [100, 200]}, "model": name, "samples": "split"}),
            vec![],
            "noise of its own",
        ),
        (json!({"settings": [{}], "model": name}), vec!["--solve"], "cannot be used with"),
    ];
    for (spec, options, expected) in wrong {
        let search = Search::of(&spec);
        let (code, text) = search.run(&options);
        assert!(code == 2 && text.contains(expected), "{spec} {text}");
        assert!(!Path::new(&search.out()).join("0001").exists(), "{spec}");
    }
}

#[test]
fn the_schema_and_the_examples_are_up_to_date() {
    let output = Command::cargo_bin("dynabs-compile").unwrap().args(["--schema", "search"]).output().unwrap();
    let kept = fs::read_to_string(root().join("models/search.schema.json")).unwrap();
    assert_eq!(
        String::from_utf8(output.stdout).unwrap(),
        kept,
        "dynabs-compile --schema search > models/search.schema.json"
    );
    let schema: Value = serde_json::from_str(&kept).unwrap();
    let fields: Vec<&String> = schema["properties"].as_object().unwrap().keys().collect();
    let (_, text) = Search::of(&json!({"settings": [{}], "wnted": 0.5})).run(&[]);
    let listed: Vec<&str> = text.split('`').skip(3).step_by(2).collect();
    assert_eq!(fields, listed, "{text}");
    for entry in fs::read_dir(root().join("examples/search")).unwrap() {
        let path = entry.unwrap().path();
        let spec: Value = serde_json::from_str(&fs::read_to_string(&path).unwrap()).unwrap();
        let model = path.parent().unwrap().join(spec["model"].as_str().unwrap());
        assert!(model.is_file() && path.parent().unwrap().join(spec["$schema"].as_str().unwrap()).is_file());
    }
}
