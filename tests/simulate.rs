//! The closed loop: reproducible, at or above its promise, and loud when something is wrong.
use crate::common::controllers::Loop;
use crate::common::{root, shipped_models};
use assert_cmd::Command;
use dynabs::controller::{End, Noise, Simulation, Tally};
use dynabs::problem::{GaussianNoise, Problem};
use serde_json::Value;
use std::fs;
use std::process::Output;
use tempfile::TempDir;

/// The distribution that the samples of a shipped model were drawn from (one step).
fn true_noise(model: &str, problem: &Problem) -> Noise {
    let diagonal: &[f64] = match model {
        _ if model.starts_with("double_integrator") => &[1.0, 1.0],
        _ if model.starts_with("spacecraft") => &[5e-4, 5e-4, 5e-8, 5e-8],
        _ => return Noise::of_plant(problem.noise()),
    };
    let entry = |i, j| if i == j { diagonal[i] } else { 0.0 };
    let n = diagonal.len();
    let covariance = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
    Noise::Gaussian(GaussianNoise { mean: None, covariance }.distribution(n).unwrap())
}

fn tally(closed: &Loop, noise: Noise, runs: u64) -> Tally {
    let start = closed.problem.initial_state().unwrap().to_vec();
    Simulation::new(&closed.problem, &closed.controller, noise, 1000).tally(&start, 7, runs, &())
}

#[test]
fn shipped_models_keep_their_promise() {
    for model in shipped_models() {
        let closed = Loop::of(&model, &[]);
        let tally = tally(&closed, true_noise(&model, &closed.problem), 4000);
        let frequency = tally.satisfaction(closed.problem.safety(), 0.01);
        assert!(frequency.frequency >= closed.answer.lower, "{model}: {tally:?} < {}", closed.answer.lower);
        assert!(!frequency.contradicts(closed.answer.lower));
        assert_eq!((tally.runs, tally.violations), (4000, 0), "{model}");
        // Goal cells lie in the goal region, and cells on the way do not meet the unsafe one.
        assert!(tally.satisfied_at_instants >= tally.reached, "{model}: {tally:?}");
        assert!(tally.satisfied >= tally.reached_safely, "{model}: {tally:?}");
        let ends =
            [tally.reached, tally.r#unsafe, tally.outside, tally.no_action, tally.over, tally.unfinished];
        assert_eq!(ends.iter().sum::<u64>(), tally.runs);
    }
}

#[test]
fn results_do_not_depend_on_threads() {
    let closed = Loop::of("spacecraft_aligned", &[]);
    let noise = true_noise("spacecraft_aligned", &closed.problem);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| tally(&closed, noise.clone(), 3001))
    };
    let one = with(1);
    assert!(one.r#unsafe > 0 && one.reached > 0 && one.unsafe_between > 0, "{one:?}");
    assert_eq!((&one, &one), (&with(2), &with(3)));
}

#[test]
fn a_trajectory_is_the_run_that_was_counted() {
    let closed = Loop::of("spacecraft_aligned", &[]);
    let simulation =
        Simulation::new(&closed.problem, &closed.controller, true_noise("spacecraft", &closed.problem), 0);
    let start = closed.problem.initial_state().unwrap().to_vec();
    let mut counts = [0; 2];
    for run in 0..200 {
        let trajectory = simulation.trajectory(&start, 7, run);
        assert_eq!(trajectory.outcome, simulation.run(&start, 7, run));
        assert_eq!(trajectory.steps.len() as u64, 2 * trajectory.outcome.steps + 1);
        counts[0] += u64::from(trajectory.outcome.end == End::Reached);
        counts[1] += u64::from(trajectory.outcome.unsafe_between);
        let other = simulation.trajectory(&start, 8, run);
        assert!(trajectory.steps[1..] != other.steps[1..], "another seed is another run");
    }
    let tally = simulation.tally(&start, 7, 200, &());
    assert_eq!(counts, [tally.reached, tally.unsafe_between]);
}

#[test]
fn unbounded_tasks_are_simulated_to_their_end() {
    let closed = Loop::of("room_temperature", &[r#"/task/horizon="infinite""#]);
    let noise = Noise::of_plant(closed.problem.noise());
    let long = tally(&closed, noise.clone(), 2000);
    assert!(long.unfinished == 0 && long.reached as f64 >= 2000.0 * closed.answer.lower, "{long:?}");
    let start = closed.problem.initial_state().unwrap().to_vec();
    let short = Simulation::new(&closed.problem, &closed.controller, noise, 1).tally(&start, 7, 2000, &());
    assert_eq!((short.unfinished, short.open, short.over), (2000, 2000, 0));
    assert!(!short.satisfaction(closed.problem.safety(), 0.01).contradicts(closed.answer.lower));
}

fn check(arguments: &[&str]) -> Output {
    Command::cargo_bin("dynabs-check").unwrap().args(arguments).output().unwrap()
}

fn compiled(scratch: &TempDir, model: &str, sets: &[&str]) -> String {
    let out = scratch.path().join("run").to_str().unwrap().to_owned();
    let file = root().join("models").join(format!("{model}.json"));
    let mut command = Command::cargo_bin("dynabs-compile").unwrap();
    command.args([file.to_str().unwrap(), "-o", &out, "--no-tra", "--quiet"]);
    sets.iter().for_each(|set| {
        command.args(["--set", set]);
    });
    assert!(command.output().unwrap().status.success());
    out
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn the_command_compares_with_the_promise() {
    let scratch = TempDir::new().unwrap();
    let run = compiled(&scratch, "double_integrator", &[]);
    let file = |name: &str| scratch.path().join(name).to_str().unwrap().to_owned();
    let report = |threads: &str| {
        let paths = file(&format!("paths{threads}.csv"));
        let noise =
            ["--covariance", "[[1,0],[0,1]]", "--from=-20,0", "--trajectories", &paths, "--keep", "3"];
        let output = check(
            &[&["simulate", &run, "--runs", "2000", "--json", "--threads", threads], &noise[..]].concat(),
        );
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        let mut json: Value = serde_json::from_slice(&output.stdout).unwrap();
        json["seconds"] = Value::Null;
        (json, fs::read_to_string(paths).unwrap())
    };
    let (json, paths) = report("1");
    assert_eq!((&json, &paths), (&report("2").0, &report("3").1));
    assert!(json["satisfied"]["lower"].as_f64() > json["bound"].as_f64() && json["contradiction"] == false);
    assert_eq!(json["counts"]["violations"], 0);
    let lines: Vec<Vec<&str>> = paths.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(lines[0], ["run", "step", "x1", "x2", "u1", "status"]);
    assert_eq!(lines[1][..4], ["0", "0", "-20", "0"]);
    assert_eq!((lines[1][5], lines[2][5], lines.last().unwrap()[0]), ("steer", "between", "2"));
    assert!(lines.iter().all(|line| line.len() == 6) && lines.last().unwrap()[4].is_empty());

    // Another noise than the promise is about.
    let wild = check(&["simulate", &run, "--runs", "2000", "--covariance", "[[900,0],[0,900]]"]);
    assert_eq!(wild.status.code(), Some(1));
    assert!(stderr(&wild).contains("contradicts the promise"), "{}", stderr(&wild));
    let samples = file("wild.csv");
    fs::write(&samples, "30,-30\n-30,30\n").unwrap();
    let wild = check(&[
        "simulate",
        &run,
        "--runs",
        "2000",
        "--noise",
        &samples,
        "--samples-of",
        "grouped",
        "--quiet",
    ]);
    assert_eq!((wild.status.code(), wild.stdout.len()), (Some(1), 0));
    // The same with decimal commas, which have to be declared: the model's samples have none.
    fs::write(&samples, "30,0;-30,0\n-30,0;30,0\n").unwrap();
    let commas = ["simulate", &run, "--runs", "2000", "--noise", &samples, "--samples-of", "grouped"];
    assert_eq!(check(&[&commas[..], &["--decimal", ","]].concat()).status.code(), Some(1));
    assert_eq!(check(&commas).status.code(), Some(2));
    // The model's own samples.
    let own = check(&["simulate", &run, "--runs", "2000", "--noise", "samples"]);
    assert_eq!(own.status.code(), Some(0));
    assert!(String::from_utf8_lossy(&own.stdout).contains("no independent check"));
}

#[test]
fn controllers_are_written_from_the_directory_alone() {
    let scratch = TempDir::new().unwrap();
    let run = compiled(&scratch, "room_temperature", &[]);
    let solved = check(&["solve", &run, "--json", "--quiet"]);
    let solved: serde_json::Value = serde_json::from_slice(&solved.stdout).unwrap();
    // The first four decimals, cut off: a promise is rounded down.
    let promised =
        format!("probability at least {:.6}", solved["results"][0]["lower"].as_f64().unwrap() - 5e-7);
    let promised = &promised[.."probability at least 0.0000".len()];
    for extension in ["json", "csv", "c"] {
        let written: Vec<_> = [1, 2]
            .map(|i| {
                let path = scratch.path().join(format!("{i}")).join(format!("c.{extension}"));
                fs::create_dir_all(path.parent().unwrap()).unwrap();
                let output = check(&["controller", &run, "--output", path.to_str().unwrap()]);
                assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
                assert!(String::from_utf8_lossy(&output.stdout).contains(promised), "{promised}");
                fs::read(path).unwrap()
            })
            .into();
        assert!(written[0] == written[1] && written[0].len() > 1000);
    }
}

#[test]
fn mistakes_are_explained() {
    let scratch = TempDir::new().unwrap();
    let run = compiled(&scratch, "double_integrator", &[]);
    let cases: [(&[&str], &str); 12] = [
        (&["simulate", "--from=41,0"], "outside the partition"),
        (&["simulate", "--from=-20"], "--from: found \"-20\"; expected 2 numbers"),
        (&["simulate", "--from=a,0"], "--from"),
        (&["simulate", "--from=inf,0"], "--from"),
        (&["simulate", "--noise", "gaussian"], "--noise gaussian: found a model with samples only"),
        (&["simulate", "--noise", "nothing.csv"], "found no file nothing.csv"),
        (&["simulate", "--noise", "samples", "--covariance", "[[1]]"], "--covariance"),
        (&["simulate", "--covariance", "[[1,0],[0,-1]]"], "--covariance: /noise/gaussian/covariance"),
        (&["simulate", "--covariance", "1"], "--covariance: found \"1\""),
        (&["simulate", "--runs", "0"], "--runs"),
        (&["simulate", "--keep", "3"], "--trajectories"),
        (&["controller", "--output", "c.pdf"], "--output: found \"c.pdf\""),
    ];
    for (arguments, message) in cases {
        let output = check(&[&arguments[..1], &[run.as_str()], &arguments[1..]].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", stderr(&output));
        assert!(stderr(&output).contains(message), "{arguments:?}: {}", stderr(&output));
    }
    let elsewhere = check(&["simulate", scratch.path().to_str().unwrap()]);
    assert_eq!(elsewhere.status.code(), Some(2));
    assert!(stderr(&elsewhere).contains("found no manifest.json"), "{}", stderr(&elsewhere));

    let scratch = TempDir::new().unwrap();
    let everywhere = compiled(&scratch, "room_temperature", &["/initial_state=null"]);
    let output = check(&["simulate", &everywhere]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("--from=0"), "{}", stderr(&output));

    // Noise that is asked for is never passed over.
    let scratch = TempDir::new().unwrap();
    let inputs = compiled(&scratch, "benchmarks/robot_2d", &[]);
    for choice in [["--noise", "samples"], ["--covariance", "[[1,0],[0,1]]"]] {
        let output = check(&["simulate", &inputs, choice[0], choice[1]]);
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains("a run whose actions are inputs"), "{}", stderr(&output));
    }
}
