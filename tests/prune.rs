//! `dynabs-compile --prune`: the same value from a fraction of the model.
use crate::common::{abstraction, reference_mode, shipped_models};
use assert_cmd::Command;
use dynabs::run::Manifest;
use imdp::model::{ActionNames, IntervalMdp, StateId};
use imdp::property::{PathFormula, Property, Resolution};
use imdp::solver::{Answer, PruneError, Pruned, SolverOptions};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::sync::atomic::AtomicBool;
use tempfile::TempDir;

/// A property of the same path without its bound on the steps.
fn unbounded(property: &Property) -> Property {
    let PathFormula::Until { left, right, .. } = property.path.clone() else { panic!("{property}") };
    Property::value(Resolution::Pmaxmin, PathFormula::Until { left, right, steps: None })
}

fn pruned(model: &IntervalMdp, property: &Property) -> Pruned {
    Pruned::new(model, property, &SolverOptions { epsilon: 1e-9, ..SolverOptions::default() }).unwrap()
}

#[test]
fn every_state_of_every_shipped_model_keeps_its_value() {
    for name in shipped_models() {
        for sets in [vec![], vec![reference_mode()]] {
            let whole = abstraction(&name, &sets);
            for property in [whole.property.clone(), unbounded(&whole.property)] {
                let pruned = pruned(&whole.model, &property);
                let (before, after) = (whole.model.size(), pruned.model.size());
                let steps = pruned.before.solution.policy.as_ref().unwrap().horizon().unwrap_or(1);
                assert!(after.choices <= steps * before.states, "{name} {property}: {after:?}");
                assert!(after.transitions < before.transitions / 2, "{name} {property}: {after:?}");
                for state in 0..whole.model.num_states() {
                    let low = pruned.before.values.lower[state] - pruned.after.values.upper[state];
                    let high = pruned.after.values.lower[state] - pruned.before.values.upper[state];
                    assert!(low.max(high) <= 1e-9, "{name} {property}, state {state}");
                    let gap = pruned.after.values.upper[state] - pruned.after.values.lower[state];
                    assert!(gap <= 2e-9, "{name} {property}, state {state}: bounds {gap} apart");
                }
            }
        }
    }
}

/// Steps with the same best choice need it once, and rows that nobody uses are gone.
#[test]
fn what_is_left_is_used() {
    let whole = abstraction("room_temperature", &[]);
    let pruned = pruned(&whole.model, &whole.property);
    let policy = pruned.before.solution.policy.as_ref().unwrap();
    let mut rows = vec![false; pruned.model.rows().len()];
    for state in StateId::first(pruned.model.num_states()) {
        let left: Vec<_> = pruned.model.choices().rows(state).collect();
        left.iter().for_each(|&row| rows[row.index()] = true);
        let mut made: Vec<_> =
            (0..policy.horizon().unwrap()).filter_map(|t| policy.choice(state, t)).collect();
        made.sort_unstable();
        made.dedup();
        assert_eq!(left.len(), made.len(), "state {state}");
        assert!(!pruned.model.choices().is_deadlock(state));
    }
    assert!(rows.into_iter().all(|used| used));
    let ActionNames::OfChoice { names, .. } = pruned.model.actions() else { panic!("no names") };
    assert_eq!(names.len(), pruned.model.rows().len());
}

/// The value of the other operators may change: this is why the manifest warns.
#[test]
fn other_properties_are_not_kept() {
    let whole = abstraction("room_temperature", &[]);
    let pruned = pruned(&whole.model, &whole.property);
    let other = Property::value(Resolution::Pminmin, whole.property.path.clone());
    let worst = |model| Answer::new(model, &other, &SolverOptions::default()).unwrap().values.upper;
    let pairs = worst(&whole.model).into_iter().zip(worst(&pruned.model));
    assert!(pairs.into_iter().any(|(before, after)| after > before + 0.1));
}

#[test]
fn an_interrupted_computation_prunes_nothing() {
    let whole = abstraction("room_temperature", &[]);
    let interrupt = AtomicBool::new(true);
    let options = SolverOptions { progress: &interrupt, ..SolverOptions::default() };
    let refused = Pruned::new(&whole.model, &whole.property, &options);
    assert!(matches!(refused, Err(PruneError::Unfinished { .. })));
}

fn compile(directory: &Path, further: &[&str]) -> (String, String) {
    let mut command = Command::cargo_bin("dynabs-compile").unwrap();
    let output = command
        .arg(crate::common::root().join("models/spacecraft_aligned.json"))
        .arg("-o")
        .arg(directory)
        .args(further)
        .output()
        .unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    assert_eq!(output.status.code(), Some(0), "{}", text(output.stderr));
    (text(output.stdout), text(output.stderr))
}

/// The directory solves to the same value from either file, says so, and does not depend on threads.
#[test]
fn a_pruned_directory_is_like_any_other() {
    let scratch = TempDir::new().unwrap();
    let [whole, one, two] = ["whole", "one", "two"].map(|name| scratch.path().join(name));
    compile(&whole, &["--no-tra"]);
    let (stdout, stderr) = compile(&one, &["--prune", "--threads", "1"]);
    compile(&two, &["--prune", "--threads", "2"]);
    assert!(stdout.contains("value in [0."), "{stdout}");
    assert!(
        stderr.contains("warning: pruned: ") && stderr.contains("other properties may have any"),
        "{stderr}"
    );

    let manifest: Manifest = serde_json::from_slice(&fs::read(one.join("manifest.json")).unwrap()).unwrap();
    let pruning = manifest.pruning.unwrap();
    assert!(manifest.transitions * 20 < pruning.transitions_before, "{pruning:?}");
    assert_eq!(pruning.property, manifest.property);
    for file in &manifest.outputs {
        let [one, two] = [&one, &two].map(|run| fs::read(run.join(&file.name)).unwrap());
        assert!(one == two, "{} depends on the number of threads", file.name);
    }

    let solve = |path: &Path, further: &[&str]| {
        let mut command = Command::cargo_bin("dynabs-check").unwrap();
        let output = command.arg("solve").arg(path).arg("--json").args(further).output().unwrap();
        let json: Value = serde_json::from_slice(&output.stdout).unwrap();
        json["results"][0]["lower"].as_f64().unwrap()
    };
    let value = solve(&whole, &[]);
    assert!(value > 0.5);
    for found in [solve(&one, &[]), solve(&one, &["--explicit"]), pruning.value_after[0]] {
        assert!((found - value).abs() < 1e-12, "{found} instead of {value}");
    }
    let mut diff = Command::cargo_bin("dynabs-check").unwrap();
    diff.arg("diff").arg(&one).arg(&two).assert().code(0);
    let mut diff = Command::cargo_bin("dynabs-check").unwrap();
    diff.arg("diff").arg(&whole).arg(&one).assert().code(1);
    // What is left is not all that the law allows, and the whole model has the same controller.
    let mut controller = Command::cargo_bin("dynabs-check").unwrap();
    let refused =
        controller.arg("controller").arg(&one).arg("-o").arg(scratch.path().join("c.json")).assert();
    let refused = refused.code(2);
    assert!(String::from_utf8_lossy(&refused.get_output().stderr).contains("found a pruned model"));
}
