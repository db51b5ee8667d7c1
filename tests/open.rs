//! A run directory opened again: it says what was compiled, or why it cannot be believed.
use crate::common::{document, shipped_models};
use dynabs::abstraction::compile;
use dynabs::run::{Manifest, OpenError, Run, WriteOptions, write_run};
use imdp::solver::SolverOptions;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

fn write(directory: &Path, model: &str, sets: &[String]) {
    let document = document(model, sets);
    let problem = document.problem().unwrap();
    let abstraction = compile(&problem, &()).unwrap();
    let manifest = Manifest::new(&document, "", &problem, &abstraction);
    let options = WriteOptions { force: true, ..WriteOptions::default() };
    write_run(directory, &document, &problem, &abstraction, manifest, options, &()).unwrap();
}

#[test]
fn a_run_is_what_was_compiled() {
    for model in shipped_models() {
        let scratch = TempDir::new().unwrap();
        let directory = scratch.path().join("run");
        write(&directory, &model, &[]);
        let run = Run::open(&directory, &()).unwrap();
        let compiled = crate::common::abstraction(&model, &[]);
        assert_eq!(run.abstraction.model, compiled.model, "{model}");
        assert_eq!(run.abstraction.state_of_cell, compiled.state_of_cell);
        assert_eq!(run.abstraction.property.to_string(), compiled.property.to_string());
        assert_eq!(run.abstraction.warnings, compiled.warnings);
        let guarantee = |a: &dynabs::abstraction::Abstraction| format!("{:?}", a.guarantee);
        assert_eq!(guarantee(&run.abstraction), guarantee(&compiled));
        let answer = run.solve(&SolverOptions { policy: true, ..SolverOptions::default() }).unwrap();
        assert!(answer.lower > 0.0 && answer.solution.policy.is_some(), "{model}: {}", answer.lower);
    }
}

#[test]
fn what_does_not_belong_together_is_refused() {
    let scratch = TempDir::new().unwrap();
    let (room, other) = (scratch.path().join("room"), scratch.path().join("other"));
    let fresh = || write(&room, "room_temperature", &[]);
    let refused = |what: &str| {
        let error = Run::open(&room, &()).unwrap_err().to_string();
        assert!(error.contains(what) && error.contains("room"), "{error}");
    };
    refused("found nothing");
    fs::create_dir(&room).unwrap();
    refused("no manifest.json");
    for (file, what) in [("problem.json", "other bytes"), ("model.dynabs", "other bytes")] {
        fresh();
        let mut bytes = fs::read(room.join(file)).unwrap();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        fs::write(room.join(file), &bytes).unwrap();
        refused(what);
        fs::remove_file(room.join(file)).unwrap();
        refused(&format!("no {file}"));
    }
    fresh();
    fs::write(room.join("manifest.json"), "{}").unwrap();
    refused("cannot be read");

    fs::remove_dir_all(&room).unwrap();

    // A model that has a right hash but belongs to other inputs.
    fresh();
    write(&other, "room_temperature", &["/input/upper=[4]".into()]);
    fs::copy(other.join("model.dynabs"), room.join("model.dynabs")).unwrap();
    let hash = |directory: &Path| {
        let text = fs::read_to_string(directory.join("manifest.json")).unwrap();
        let manifest: Manifest = serde_json::from_str(&text).unwrap();
        manifest.outputs.iter().find(|file| file.name == "model.dynabs").unwrap().sha256.clone()
    };
    let manifest = fs::read_to_string(room.join("manifest.json")).unwrap();
    fs::write(room.join("manifest.json"), manifest.replace(&hash(&room), &hash(&other))).unwrap();
    assert!(matches!(Run::open(&room, &()).unwrap_err(), OpenError::Abstraction { .. }));
}
