//! What fresh samples prove, and that used ones prove nothing.
use crate::common::controllers::Loop;
use crate::common::root;
use assert_cmd::Command;
use dynabs::controller::{Noise, Simulation, samples_per_run};
use dynabs::problem::{SampleKind, StepNoise};
use dynabs::statistics::lower_bound;
use serde_json::Value;
use std::fs;
use std::path::Path;

/// A hundred runs with 3,200 fresh samples prove .88 of this model on average over 20 sets of them, far more than the abstraction.
#[test]
fn fresh_samples_prove_more_than_a_coarse_abstraction() {
    let closed = Loop::of("predecessors/building_1_zone", &[]);
    let StepNoise::Gaussian(gaussian) = &closed.problem.noise().samples().unwrap().of_one_step else {
        panic!("drawn noise")
    };
    let start = closed.problem.initial_state().unwrap();
    let per_run = samples_per_run(&closed.problem, SampleKind::Step).unwrap();
    assert_eq!(per_run, closed.problem.horizon().unwrap() * closed.problem.group_steps() as u64);
    let noise = Noise::of_plant(closed.problem.noise());
    let simulation = Simulation::new(&closed.problem, &closed.controller, noise, 0);
    let bounds = (0..20).map(|seed| {
        let tally = simulation.replay(start, &gaussian.sample(3200, 1000 + seed), SampleKind::Step, per_run);
        assert_eq!(tally.runs, 3200 / per_run);
        lower_bound(tally.satisfied, tally.runs, 0.01)
    });
    let mean = bounds.sum::<f64>() / 20.0;
    let promised = closed.controller.bound_at(start);
    assert!(mean >= 0.88 && promised < mean - 0.1, "{mean} {promised}");
}

/// Every run has the samples of its own place, whatever became of the runs before.
#[test]
fn runs_have_their_own_samples() {
    let closed = Loop::of("room_temperature", &["/noise/gaussian/covariance=[[0.0001]]"]);
    let per_run = samples_per_run(&closed.problem, SampleKind::Step).unwrap();
    let simulation =
        Simulation::new(&closed.problem, &closed.controller, Noise::of_plant(closed.problem.noise()), 0);
    // A gust at once throws a run out of the room; the next run does not know of it.
    let mut values = vec![0.0; 3 * per_run as usize + 1];
    values[per_run as usize] = 1000.0;
    let samples = dynabs::noise::NoiseSamples::new(1, values);
    let start = closed.problem.initial_state().unwrap();
    let tally = simulation.replay(start, &samples, SampleKind::Step, per_run);
    assert_eq!((tally.runs, tally.satisfied, tally.outside), (3, 2, 1));
}

fn check(arguments: &[&str], samples: &Path) -> (Option<i32>, String) {
    let mut command = Command::cargo_bin("dynabs-check").unwrap();
    let output = command.args(arguments).arg("--samples").arg(samples).arg("-q").output().unwrap();
    let text = [output.stdout, output.stderr].concat();
    (output.status.code(), String::from_utf8(text).unwrap())
}

#[test]
fn used_samples_are_refused() {
    let scratch = tempfile::tempdir().unwrap();
    let used = scratch.path().join("used.csv");
    let lines = |seed: u64| {
        let noise =
            dynabs::noise::Gaussian::new(&[0.0], &dynabs::linear_algebra::ExactMatrix::identity(1)).unwrap();
        let line = |x: &[f64]| format!("{}\n", 0.05 * x[0]).replace('.', ",");
        noise.sample(2000, seed).iter().map(line).collect::<String>()
    };
    fs::write(&used, lines(1)).unwrap();
    let model = fs::read_to_string(root().join("models/room_temperature.json")).unwrap();
    let mut model: Value = serde_json::from_str(&model).unwrap();
    model["noise"] = serde_json::json!({"samples": {"file": "used.csv", "of": "step", "decimal": ","}});
    let path = scratch.path().join("room.json");
    fs::write(&path, model.to_string()).unwrap();
    let run = scratch.path().join("run");
    let mut compile = Command::cargo_bin("dynabs-compile").unwrap();
    compile.args(["--no-tra", "--solve", "-q", "-o"]).arg(&run).arg(&path).assert().success();

    let directory = run.to_str().unwrap();
    let (code, text) = check(&["validate", directory], &used);
    assert!(code == Some(2) && text.contains("found 2000 of 2000 samples among those"), "{text}");
    let fresh = scratch.path().join("fresh.csv");
    fs::write(&fresh, lines(2)).unwrap();
    let (code, text) = check(&["validate", directory, "--json"], &fresh);
    assert_eq!(code, Some(0), "{text}");
    let said: Value = serde_json::from_str(&text).unwrap();
    let runs = said["runs"].as_u64().unwrap();
    assert_eq!(runs, 2000 / said["samples_per_run"].as_u64().unwrap());
    let bound = lower_bound(said["satisfied"].as_u64().unwrap(), runs, 0.01);
    assert_eq!(said["bound"].as_f64().unwrap(), bound);
    let (code, text) = check(&["validate", directory, "--decimal", "."], &fresh);
    assert!(code == Some(2) && text.contains("found 2 columns"), "{text}");
    fs::write(&fresh, "0,1\n").unwrap();
    let (code, text) = check(&["validate", directory], &fresh);
    assert!(code == Some(2) && text.contains("expected at least the"), "{text}");
}
