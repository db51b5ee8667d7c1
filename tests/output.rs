//! What a compilation writes: complete, reproducible, all or nothing.
use crate::common::{data, reference_mode, root, table_one_row};
use assert_cmd::Command;
use imdp::formats::sha256_hex;
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

fn compile(arguments: &[&str]) -> String {
    let output = Command::cargo_bin("dynabs-compile").unwrap().args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn model(name: &str) -> String {
    root().join("models").join(format!("{name}.json")).to_str().unwrap().to_owned()
}

fn contents(directory: &Path) -> BTreeMap<String, Vec<u8>> {
    fs::read_dir(directory)
        .unwrap()
        .map(|entry| {
            let path = entry.unwrap().path();
            (path.file_name().unwrap().to_str().unwrap().to_owned(), fs::read(&path).unwrap())
        })
        .collect()
}

#[test]
fn bytes_do_not_depend_on_threads() {
    let scratch = TempDir::new().unwrap();
    let runs: Vec<_> = ["1", "2", "8"]
        .iter()
        .map(|threads| {
            let out = scratch.path().join(threads);
            let arguments = [&model("spacecraft_aligned_two_layer"), "-o", out.to_str().unwrap()];
            compile(&[&arguments[..], &["--quiet", "--threads", threads]].concat());
            contents(&out)
        })
        .collect();
    let names = "manifest.json model.dynabs model.lab model.props model.sta model.tra noise.csv problem.json";
    assert!(runs[0].keys().map(String::as_str).eq(names.split(' ')));
    assert!(runs.iter().all(|run| *run == runs[0]));
}

#[test]
fn a_directory_is_self_contained_and_hashed() {
    let scratch = TempDir::new().unwrap();
    let (first, second) = (scratch.path().join("first"), scratch.path().join("second"));
    let arguments = ["--quiet", "--set", "/task/horizon=4"];
    compile(&[&[&model("room_temperature"), "-o", first.to_str().unwrap()], &arguments[..]].concat());
    let again = first.join("problem.json");
    compile(&[again.to_str().unwrap(), "-o", second.to_str().unwrap(), "--quiet"]);
    let (first, second) = (contents(&first), contents(&second));
    for (name, bytes) in first.iter().filter(|(name, _)| *name != "manifest.json") {
        assert_eq!(second[name], *bytes, "{name}");
    }
    let manifest: Value = serde_json::from_slice(&first["manifest.json"]).unwrap();
    assert_eq!(manifest["horizon"]["model_steps"], 4);
    assert_eq!(manifest["set"][0], "/task/horizon=4");
    assert_eq!(manifest["seed"], 1);
    let outputs = manifest["outputs"].as_array().unwrap();
    assert_eq!(outputs.len() + 1, first.len());
    for output in outputs {
        let bytes = &first[output["name"].as_str().unwrap()];
        assert_eq!(output["sha256"], sha256_hex(bytes));
        assert_eq!(output["bytes"], bytes.len());
    }
    let props = String::from_utf8(first["model.props"].clone()).unwrap();
    assert_eq!(props, "(Pmaxmin=? [ !\"failed\" U<=4 \"reached\" ])>=0.9\n");
}

/// The smallest row of Table I as files: the header, and the lines that the header announces.
#[test]
fn explicit_files_have_the_published_size() {
    let table = data("table1.json");
    let row = table["rows"].as_array().unwrap().iter().min_by_key(|row| row["transitions"].as_u64());
    let row = row.unwrap();
    let (name, sets) = table_one_row(row);
    let scratch = TempDir::new().unwrap();
    let out = scratch.path().join("out");
    let path = model(name);
    let mode = reference_mode();
    let mut arguments = vec![path.as_str(), "-o", out.to_str().unwrap(), "--json", "--set", &mode];
    sets.iter().for_each(|set| arguments.extend(["--set", set]));
    let summary: Value = serde_json::from_str(&compile(&arguments)).unwrap();
    let tra = fs::read_to_string(out.join("model.tra")).unwrap();
    let fields = ["states", "choices", "transitions"];
    let header: Vec<_> = fields.iter().map(|field| row[field].to_string()).collect();
    assert_eq!(tra.lines().next().unwrap(), header.join(" "));
    assert_eq!(tra.lines().count() as u64, row["transitions"].as_u64().unwrap() + 1);
    assert!(fields.iter().all(|field| summary[field] == row[field]));
    assert!(summary["seconds"]["rows"].as_f64().unwrap() > 0.0);
    let lab = fs::read_to_string(out.join("model.lab")).unwrap();
    assert!(
        lab.starts_with("0=\"init\" 1=\"deadlock\" 2=\"reached\" 3=\"failed\"\n0: 3\n1: 3\n2: 2\n"),
        "{lab}"
    );
    assert!(fs::read_to_string(out.join("model.sta")).unwrap().contains("\n3:(0,0)\n4:(0,1)\n"));
}

#[test]
fn an_earlier_run_is_replaced_only_by_force() {
    let scratch = TempDir::new().unwrap();
    let out = scratch.path().join("out");
    let path = model("room_temperature");
    let arguments = [path.as_str(), "-o", out.to_str().unwrap(), "--quiet"];
    compile(&arguments);
    fs::write(out.join("notes.txt"), "mine").unwrap();
    let refused = Command::cargo_bin("dynabs-compile").unwrap().args(arguments).output().unwrap();
    assert_eq!(refused.status.code(), Some(2));
    compile(&[&arguments[..], &["--force", "--no-tra"]].concat());
    let files = contents(&out);
    assert!(files.contains_key("notes.txt") && !files.contains_key("model.tra"));
}

#[test]
fn dry_runs_write_nothing_and_print_one_object() {
    let scratch = TempDir::new().unwrap();
    let output = Command::cargo_bin("dynabs-compile")
        .unwrap()
        .current_dir(scratch.path())
        .args([&model("double_integrator"), "--dry-run", "--json", "--seed", "3"])
        .output()
        .unwrap();
    let object: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(object["rows"], 1681);
    assert!(String::from_utf8_lossy(&output.stderr).contains("--seed has no effect"));
    assert_eq!(fs::read_dir(scratch.path()).unwrap().count(), 0);
}

#[test]
fn seeds_change_drawn_samples_only_when_asked() {
    let run = |seed: &[&str]| -> Value {
        let path = model("room_temperature");
        serde_json::from_str(&compile(&[&[path.as_str(), "--dry-run", "--json", "--quiet"], seed].concat()))
            .unwrap()
    };
    let (default, one, two) = (run(&[]), run(&["--seed", "1"]), run(&["--seed", "2"]));
    assert_eq!(default["row_entries"], one["row_entries"]);
    assert_eq!(two["seed"], 2);
}

#[test]
fn the_starter_model_and_the_schema_are_what_the_tool_reads() {
    let scratch = TempDir::new().unwrap();
    let starter = scratch.path().join("mine.json");
    compile(&["--init", starter.to_str().unwrap()]);
    let object: Value =
        serde_json::from_str(&compile(&[starter.to_str().unwrap(), "--dry-run", "--json", "--quiet"]))
            .unwrap();
    assert!(object["choices"].as_u64().unwrap() > 1000);
    let again = Command::cargo_bin("dynabs-compile").unwrap().arg("--init").arg(&starter).output().unwrap();
    assert_eq!(again.status.code(), Some(2), "--init never overwrites");

    let schema = compile(&["--schema"]);
    let kept = root().join("models/model.schema.json");
    assert_eq!(
        schema,
        fs::read_to_string(kept).unwrap(),
        "run dynabs-compile --schema > models/model.schema.json"
    );
}

/// PRISM's files are written where they are small, or asked for.
#[test]
fn nothing_surprises_by_its_size() {
    let scratch = TempDir::new().unwrap();
    let out = scratch.path().join("out");
    let said = compile(&[&model("double_integrator"), "-o", out.to_str().unwrap()]);
    assert!(said.contains("left out     model.tra of 2,313 MB: --format prism writes it"), "{said}");
    assert!(
        fs::metadata(out.join("model.dynabs")).unwrap().len() < 10_000_000 && !out.join("model.tra").exists()
    );
}
