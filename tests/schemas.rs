//! What is printed and written as JSON is what the published schemas say, to the last field.
use crate::common::root;
use assert_cmd::Command;
use jsonschema::Validator;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// Objects whose keys are data.
const MAPS: [&str; 4] = ["labels", "seconds", "settings", "targets"];

fn dynabs(directory: &Path, arguments: &[&str]) -> String {
    let output =
        Command::cargo_bin("dynabs").unwrap().current_dir(directory).args(arguments).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code().is_some_and(|code| code != 4), "{arguments:?}: {said}");
    String::from_utf8(output.stdout).unwrap()
}

fn schema(name: &str) -> Value {
    serde_json::from_str(&dynabs(Path::new("."), &["schema", name])).unwrap()
}

fn names() -> Vec<String> {
    let help = dynabs(Path::new("."), &["schema", "--help"]);
    let values = help.lines().filter_map(|line| line.trim_start().strip_prefix("- "));
    values.map(|value| value.split(':').next().unwrap().to_owned()).collect()
}

fn places(value: &Value, at: &str, places: &mut Vec<String>) {
    match value {
        Value::Object(map) => {
            if !MAPS.iter().any(|map| at.ends_with(&format!("/{map}"))) {
                places.push(at.to_owned());
            }
            map.iter().for_each(|(key, value)| {
                let key = key.replace('~', "~0").replace('/', "~1");
                self::places(value, &format!("{at}/{key}"), places);
            });
        }
        // Items are alike.
        Value::Array(items) => {
            let few = items.iter().enumerate().take(3);
            few.for_each(|(i, item)| self::places(item, &format!("{at}/{i}"), places));
        }
        _ => {}
    }
}

/// The output is what the schema says, and no object in it may have a field more.
fn check(name: &str, validator: &Validator, output: &Value) {
    let errors: Vec<String> =
        validator.iter_errors(output).map(|error| format!("{}: {error}", error.instance_path())).collect();
    assert!(errors.is_empty(), "{name}: {errors:#?}");
    let mut all = vec![];
    places(output, "", &mut all);
    for place in all {
        let mut more = output.clone();
        more.pointer_mut(&place).unwrap()["surprise"] = json!(1);
        assert!(!validator.is_valid(&more), "{name}: {place} may have any field");
    }
}

#[test]
fn every_output_is_what_its_schema_says() {
    let scratch = TempDir::new().unwrap();
    let at = scratch.path();
    let model = |name: &str| root().join("models").join(name).display().to_string();
    let [room, integrator] = [model("room_temperature.json"), model("double_integrator_two_layer.json")];
    let parking = model("benchmarks/car_parking_a.json");
    let mut outputs: Vec<(&str, String)> = vec![];
    let run = |arguments: &[&str]| dynabs(at, arguments);
    let read = |name: &str| fs::read_to_string(at.join(name)).unwrap();

    outputs.push(("compilation", run(&["compile", &room, "-o", "room", "--solve", "--json"])));
    outputs.push(("compilation", run(&["compile", &room, "--dry-run", "--prune", "--json"])));
    outputs
        .push(("compilation", run(&["compile", &integrator, "-o", "two", "--encoding", "rows", "--json"])));
    outputs.push(("compilation", run(&["compile", &parking, "-o", "car", "--solve", "--no-tra", "--json"])));
    let reference = r#"/probabilities={"mode":"reference","beta_per_interval":0.01}"#;
    outputs.push((
        "compilation",
        run(&["compile", &room, "--dry-run", "--solve", "--json", "--set", reference]),
    ));
    for name in ["room", "two", "car"] {
        outputs.push(("manifest", read(&format!("{name}/manifest.json"))));
        run(&["export", name, "-o", &format!("{name}.json"), "-q"]);
        outputs.push(("controller", read(&format!("{name}.json"))));
        outputs.push(("results", run(&["solve", name, "--json"])));
        outputs.push(("simulation", run(&["simulate", name, "--runs", "100", "--json"])));
    }
    let asked = ["-p", r#"Pmaxmin=? [ F "reached" ]"#, "-p", r#"Pmaxmin=? [ F "nothing" ]"#];
    outputs.push(("results", run(&[&["solve", "room", "--json"], &asked[..]].concat())));
    run(&["solve", "room", "-q", "-p", asked[1], "--certificate", "room.cert"]);
    outputs.push(("verification", run(&["verify", "room.cert", "room", "--json"])));
    outputs.push(("verification", run(&["verify", "room.cert", "two", "--json"])));
    outputs.push(("explanation", run(&["explain", "room", "--json"])));
    outputs.push(("explanation", run(&["explain", "two", "--json"])));
    let fresh: String = (0..60).map(|i| format!("{}\n", 0.01 * f64::from(i % 7) - 0.03)).collect();
    fs::write(at.join("fresh.csv"), fresh).unwrap();
    outputs.push(("validation", run(&["validate", "room", "--samples", "fresh.csv", "--json"])));
    outputs.push(("differences", run(&["diff", "room", "two", "--json"])));
    run(&["diff", "room", "--write-reference", "reference.json"]);
    outputs.push(("reference", read("reference.json")));
    let nobody = ["--prism", "/nowhere", "--python", "/nowhere", "--json", "-q"];
    let crosscheck = run(&[&["crosscheck", "room"], &nobody[..]].concat());
    if !crosscheck.is_empty() {
        outputs.push(("crosscheck", crosscheck));
    }
    let spec = json!({"model": room, "settings": {"/task/horizon": [4, 6]}});
    fs::write(at.join("spec.json"), spec.to_string()).unwrap();
    outputs.push(("sweep", run(&["sweep", "spec.json", "-o", "sweep", "--json", "-q"])));
    let spec = json!({"model": room, "settings": {"/task/horizon": [4, 6]}, "wanted": 0.5});
    fs::write(at.join("search.json"), spec.to_string()).unwrap();
    outputs.push(("found", run(&["compile", "--search", "search.json", "-o", "search", "--json", "-q"])));
    outputs.push(("search", read("search.json")));
    run(&["init", "mine.json"]);
    outputs.push(("problem", read("mine.json")));

    for name in names() {
        let validator = jsonschema::validator_for(&schema(&name)).unwrap();
        let own: Vec<_> = outputs.iter().filter(|(of, _)| **of == *name).collect();
        assert!(!own.is_empty() || name == "crosscheck", "{name}: no output");
        for (_, text) in own {
            check(
                &name,
                &validator,
                &serde_json::from_str(text).unwrap_or_else(|_| panic!("{name}: {text}")),
            );
        }
    }
}

/// What engines say is in the schema, too.
#[test]
fn findings_are_what_the_schema_says() {
    let finding = |value: Value, agreement: &str| {
        json!({
            "engine": "PRISM", "version": "4.10", "property": "Pmaxmin=? [ F \"goal\" ]", "value": value, "ours": [0.5, "Infinity"],
            "difference": 1e-9, "state": 3, "tolerance": "1e-6", "strategy": {"decisions": 4, "shortfall": 0.0},
            "seconds": 1.5, "peak_mib": 100, "agreement": agreement, "notes": []
        })
    };
    let file = json!({
        "version": "0.1.0", "path": "out", "model": [{"kind": "dynabs", "sha256": "0".repeat(64)}], "agree": false,
        "findings": [finding(json!([0.5, 0.5]), "agrees"), finding(Value::Null, "failed")], "missing": ["storm"]
    });
    let read: imdp::engines::CrossCheckFile = serde_json::from_value(file.clone()).unwrap();
    let written = serde_json::to_value(read).unwrap();
    check("crosscheck", &jsonschema::validator_for(&schema("crosscheck")).unwrap(), &written);
}

/// A starter says where its schema is, and every schema which draft it is of.
#[test]
fn files_name_their_schema() {
    let scratch = TempDir::new().unwrap();
    dynabs(scratch.path(), &["init", "mine.json"]);
    let starter: Value =
        serde_json::from_slice(&fs::read(scratch.path().join("mine.json")).unwrap()).unwrap();
    assert_eq!(starter["$schema"], "dynabs-problem.schema.json");
    for name in names() {
        assert!(schema(&name)["title"].is_string(), "{name}");
    }
    assert!(names().len() >= 13, "{:?}", names());
}
