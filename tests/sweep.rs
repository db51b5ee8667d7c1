//! `dynabs sweep`: jobs in directories of their own, run here or by Slurm, in one table.
use crate::common::root;
use assert_cmd::Command;
use serde_json::{Value, json};
use std::fs;
use std::path::Path;
use std::process::Output;

fn dynabs(arguments: &[&str]) -> Output {
    Command::cargo_bin("dynabs").unwrap().args(arguments).output().unwrap()
}

fn write_spec(directory: &Path, settings: &Value) -> String {
    let path = directory.join("spec.json");
    let model = root().join("models/room_temperature.json");
    fs::write(&path, json!({"model": model, "settings": settings}).to_string()).unwrap();
    path.to_str().unwrap().to_owned()
}

/// The lower bound of one setting compiled by itself.
fn alone(sets: &[&str]) -> Value {
    let model = root().join("models/room_temperature.json");
    let fixed = ["compile", model.to_str().unwrap(), "--dry-run", "--solve", "--json", "-q"];
    let sets = sets.iter().flat_map(|set| ["--set", set]);
    let output = dynabs(&fixed.into_iter().chain(sets).collect::<Vec<_>>());
    serde_json::from_slice::<Value>(&output.stdout).unwrap()["results"][0]["lower"].take()
}

#[test]
fn every_combination_is_a_job_with_its_part_of_the_confidence() {
    let scratch = tempfile::tempdir().unwrap();
    let spec = write_spec(scratch.path(), &json!({"/task/horizon": [4, 8], "/noise/count": [400, 800]}));
    let out = scratch.path().join("out");
    let out_name = out.to_str().unwrap();
    let output = dynabs(&["sweep", &spec, "-o", out_name, "--json", "-q"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let table: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(table.as_array().unwrap().len(), 4);
    let settings = json!({"/task/horizon": 4, "/noise/count": 800, "/probabilities/sweep": 4});
    assert_eq!((&table[1]["job"], &table[1]["settings"]), (&json!("0002"), &settings));
    let sets = ["/task/horizon=4", "/noise/count=800", "/probabilities/sweep=4"];
    assert_eq!(table[1]["lower"], alone(&sets));
    assert!(table[1]["lower"].as_f64() < alone(&sets[..2]).as_f64(), "a part of the confidence");
    assert!(out.join("0004/run/model.dynabs").is_file());
    let lines = fs::read_to_string(out.join("table.csv")).unwrap();
    assert!(lines.starts_with("job,/task/horizon,/noise/count,/probabilities/sweep,lower,"), "{lines}");

    // What has ended is not run again; what has not, is.
    fs::remove_file(out.join("0003/result.json")).unwrap();
    fs::remove_dir_all(out.join("0002/run")).unwrap();
    let again = dynabs(&["sweep", &spec, "-o", out_name]);
    let told = String::from_utf8(again.stderr).unwrap();
    assert!(told.contains("0003: done") && !told.contains("0002"), "{told}");
    assert!(!out.join("0002/run").exists());
    let other = write_spec(scratch.path(), &json!({"/task/horizon": [4]}));
    assert_eq!(dynabs(&["sweep", &other, "-o", out_name]).status.code(), Some(2), "another sweep's place");
}

/// Plans are free, so settings that differ in nothing else have all of the confidence each, and the smallest model is found.
#[test]
fn the_smallest_model_with_a_plan_is_found() {
    let scratch = tempfile::tempdir().unwrap();
    let follow = |u: f64| json!({"track": "auto", "abstract_input": {"lower": [-u], "upper": [u]}});
    let settings = json!([{"/stabilizer": follow(1.0)}, {"/stabilizer": follow(0.3)}]);
    let spec = write_spec(scratch.path(), &settings);
    let out = scratch.path().join("shared");
    let told = |spec: &str, out: &Path, wanted: &str| {
        let output = dynabs(&["sweep", spec, "-o", out.to_str().unwrap(), "-q", "--wanted", wanted]);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    // The whole layer may differ in more.
    assert!(told(&spec, &out, "0.9").contains("/probabilities/sweep"));
    let model = scratch.path().join("model.json");
    let text = fs::read_to_string(root().join("models/room_temperature.json")).unwrap();
    let mut value: Value = serde_json::from_str(&text).unwrap();
    value["stabilizer"] = json!({"track": "auto"});
    fs::write(&model, value.to_string()).unwrap();
    let inputs: Vec<Value> = [1.0, 0.3].iter().map(|&u| follow(u)["abstract_input"].clone()).collect();
    let spec = scratch.path().join("plans.json");
    let settings = json!({"model": model, "settings": {"/stabilizer/abstract_input": inputs}});
    fs::write(&spec, settings.to_string()).unwrap();
    let out = scratch.path().join("free");
    let text = told(spec.to_str().unwrap(), &out, "0.9");
    assert!(!text.contains("/probabilities/sweep"), "{text}");
    assert!(text.contains("0002 has the fewest transitions of all with at least 0.9"), "{text}");
    assert!(told(spec.to_str().unwrap(), &out, "0.9999").contains("none of these settings"));
    // A plan that is `null` is none: what a feedback leaves decides what is lost, so the settings share the confidence.
    value["stabilizer"] = json!({"track": null, "gain": [[0.1]], "abstract_input": inputs[0]});
    fs::write(&model, value.to_string()).unwrap();
    let null = scratch.path().join("null");
    assert!(told(spec.to_str().unwrap(), &null, "0").contains("/probabilities/sweep"));
    // Jobs without a size or a result are not compared, and that is said.
    let result = null.join("0001/result.json");
    let mut value: Value = serde_json::from_str(&fs::read_to_string(&result).unwrap()).unwrap();
    value["transitions"].take();
    value["choices"].take();
    fs::write(&result, value.to_string()).unwrap();
    fs::remove_file(null.join("0002/result.json")).unwrap();
    let collected = ["sweep", "--collect", "-o", null.to_str().unwrap(), "--wanted", "0"];
    let text = String::from_utf8(dynabs(&collected).stdout).unwrap();
    for said in [
        "none of these settings",
        "1 of 2 jobs with at least that bound, but no size",
        "1 of 2 jobs with no lower bound",
    ] {
        assert!(text.contains(said), "{text}");
    }
    for wrong in [&["--wanted", "1.5"][..], &["--wanted", "nan"], &["--wanted", "0", "--json"]] {
        assert_eq!(dynabs(&[&collected[..4], wrong].concat()).status.code(), Some(2), "{wrong:?}");
    }
}

#[test]
fn slurm_gets_an_array_of_jobs_that_a_shell_can_run() {
    let scratch = tempfile::tempdir().unwrap();
    let spec = write_spec(scratch.path(), &json!([{"/task/horizon": 4}, {"/name": "it's \"b\""}]));
    let out = scratch.path().join("out");
    let out_name = out.to_str().unwrap();
    assert!(dynabs(&["sweep", &spec, "-o", out_name, "--slurm"]).status.success());
    let script = fs::read_to_string(out.join("sweep.sbatch")).unwrap();
    assert!(script.contains("#SBATCH --array=1-2\n"), "{script}");
    let collect = || dynabs(&["sweep", "--collect", "-o", out_name, "--json"]);
    assert_eq!(collect().status.code(), Some(3), "no job has been run");
    let program = assert_cmd::cargo::cargo_bin("dynabs");
    let path = format!("{}:{}", program.parent().unwrap().display(), std::env::var("PATH").unwrap());
    for task in ["1", "2"] {
        let mut shell = std::process::Command::new("sh");
        shell.arg(out.join("sweep.sbatch")).env("SLURM_ARRAY_TASK_ID", task).env("PATH", &path);
        assert!(shell.status().unwrap().success());
    }
    let output = collect();
    assert!(output.status.success());
    let table: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!(table[0]["lower"].is_number() && table[1]["state"] == "done", "{table}");
}

#[test]
fn mistakes_are_found_before_any_job_is_written() {
    let scratch = tempfile::tempdir().unwrap();
    let out = scratch.path().join("out");
    let wrong = [
        (json!({"/task/horizont": [1]}), "/task"),
        (json!({"/task/horizon": [-1]}), "/task/horizon"),
        (json!([]), "at least one"),
        (json!({"/task/horizon": 4}), "a list of values"),
    ];
    for (settings, expected) in wrong {
        let spec = write_spec(scratch.path(), &settings);
        let output = dynabs(&["sweep", &spec, "-o", out.to_str().unwrap()]);
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(error.contains(expected) && !out.exists(), "{error}");
    }
}
