//! The solution that a run holds is the one that solving gives, and nothing else is believed.
use crate::common::{document, root};
use assert_cmd::Command;
use dynabs::abstraction::compile;
use dynabs::run::{InputRun, Manifest, Run, WriteOptions, solution_options, write_run};
use imdp::property::Property;
use imdp::solution_file::{self, SolutionSubject};
use imdp::solver::{Answer, Event, SolverOptions, solve};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

const MODELS: [(&str, &[&str]); 3] = [
    ("room_temperature", &[]),
    ("room_temperature", &["/task/horizon=\"infinite\""]),
    ("spacecraft_aligned", &[]),
];

/// Writes a run with its solution or without.
fn write(directory: &Path, model: &str, sets: &[&str], solved: bool) -> Answer {
    let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
    let document = document(model, &sets);
    let problem = document.problem().unwrap();
    let abstraction = compile(&problem, &()).unwrap();
    let options = solution_options(&problem, &SolverOptions::default());
    let answer = Answer::new(&abstraction.model, &abstraction.property, &options).unwrap();
    let manifest = Manifest::new(&document, "", &problem, &abstraction);
    let solution = solved.then_some(&answer.solution);
    let options = WriteOptions { force: true, solution, ..WriteOptions::default() };
    write_run(directory, &document, &problem, &abstraction, manifest, options, &()).unwrap();
    answer
}

#[test]
fn a_stored_solution_is_the_computed_one() {
    let scratch = TempDir::new().unwrap();
    for (model, sets) in MODELS {
        let directory = scratch.path().join("run");
        let computed = write(&directory, model, sets, true);
        assert!(directory.join("solution.bin").exists());
        let stored = Run::open(&directory, &()).unwrap().solve(&SolverOptions::default()).unwrap();
        assert_eq!(stored.solution, computed.solution, "{model}");
        assert_eq!(
            (stored.lower, stored.upper, stored.verdict),
            (computed.lower, computed.upper, computed.verdict)
        );
        write(&directory, model, sets, false);
        assert!(!directory.join("solution.bin").exists());
        let solved = Run::open(&directory, &()).unwrap().solve(&SolverOptions::default()).unwrap();
        assert_eq!(solved.solution, computed.solution, "{model}");
    }
}

/// What one solve keeps of earlier steps is what solving for fewer steps gives, also where nothing changes any more.
#[test]
fn earlier_steps_are_those_of_shorter_horizons() {
    for horizon in [1, 6, 64] {
        let abstraction =
            crate::common::abstraction("spacecraft_aligned", &[format!("/task/horizon={}", 2 * horizon)]);
        let options = SolverOptions { history: 70, ..SolverOptions::default() };
        let answer = Answer::new(&abstraction.model, &abstraction.property, &options).unwrap();
        let imdp::property::QueryKind::Until { safe, goal, .. } = &answer.query.kind else { panic!() };
        assert_eq!(answer.solution.history.len() as u64, horizon);
        for (steps, history) in (0..horizon).rev().zip(&answer.solution.history) {
            let event = Event::Until { safe, goal, steps: Some(steps) };
            let shorter =
                solve(&abstraction.model, &event, answer.query.resolution, &SolverOptions::default());
            assert_eq!(&shorter.unwrap().values.lower, history, "{steps} of {horizon}");
        }
    }
}

#[test]
fn damaged_solutions_are_refused() {
    let scratch = TempDir::new().unwrap();
    let directory = scratch.path().join("run");
    write(&directory, "room_temperature", &[], true);
    let run = Run::open(&directory, &()).unwrap();
    let (model, property) = (&run.abstraction.model, run.property());
    let good = fs::read(directory.join("solution.bin")).unwrap();
    let end = good.iter().position(|&byte| byte == b'\n').unwrap();
    let header: serde_json::Value = serde_json::from_slice(&good[..end]).unwrap();
    let sha256 = header["model"].as_str().unwrap();
    let read = |bytes: &[u8], property: &Property, sha256: &str| {
        let subject = SolutionSubject {
            property: &property.to_string(),
            sha256,
            states: model.num_states(),
            is_choice: &|state, choice| model.choices().row_of_choice(state, choice).is_some(),
        };
        solution_file::read(bytes, &subject)
    };
    assert!(read(&good, property, sha256).is_ok());

    let refused = |bytes: &[u8], property: &Property, sha256: &str, what: &str| {
        let error = read(bytes, property, sha256).unwrap_err().to_string();
        assert!(error.contains(what), "{error}");
    };
    refused(&good, property, "0", "of the model");
    refused(&good, &"Pmaxmin=? [ F \"reached\" ]".parse().unwrap(), sha256, "of the property");
    refused(b"", property, sha256, "first line");
    for length in [end, end + 1, good.len() - 1] {
        refused(&good[..length], property, sha256, "bytes of numbers");
    }
    let with = |at: usize, value: &[u8]| {
        let mut bytes = good.clone();
        bytes[at..at + value.len()].copy_from_slice(value);
        bytes
    };
    let states = model.num_states();
    refused(&with(end + 1, &f64::NAN.to_le_bytes()), property, sha256, "a probability");
    refused(&with(end + 1, &1.5f64.to_le_bytes()), property, sha256, "a probability");
    // A lower bound of 1 in the state that has failed, whose upper bound is 0.
    refused(&with(end + 1, &1f64.to_le_bytes()), property, sha256, "up to the upper one");
    let changes = end + 1 + 20 * states;
    refused(&with(changes, &99u64.to_le_bytes()), property, sha256, "up to the horizon");
    refused(&with(changes + 8, &u32::MAX.to_le_bytes()), property, sha256, "a choice of the state");

    // And none is believed whose hash is not the manifest's.
    fs::write(directory.join("solution.bin"), with(good.len() - 1, &[good[good.len() - 1] ^ 1])).unwrap();
    assert!(Run::open(&directory, &()).unwrap_err().to_string().contains("other bytes"));
}

#[test]
fn commands_say_the_same_with_and_without_it() {
    let scratch = TempDir::new().unwrap();
    let file = root().join("models/room_temperature.json");
    let tell = |name: &str, more: &[&str]| {
        let out = scratch.path().join(name).to_str().unwrap().to_owned();
        let mut command = Command::cargo_bin("dynabs-compile").unwrap();
        command.args([file.to_str().unwrap(), "-o", &out, "--no-tra", "--quiet"]).args(more);
        assert!(command.output().unwrap().status.success());
        let page = scratch.path().join(format!("{name}.html"));
        let law = scratch.path().join("law.c");
        for (command, to) in [("report", &page), ("controller", &law)] {
            let mut check = Command::cargo_bin("dynabs-check").unwrap();
            check.args([command, &out, "-q", "-o", to.to_str().unwrap()]);
            if command == "report" {
                check.args(["--no-times", "--runs", "100"]);
            }
            assert!(check.output().unwrap().status.success());
        }
        [page, law].map(|path| fs::read_to_string(path).unwrap())
    };
    let [with, without] = [tell("with", &["--solve"]), tell("without", &[])];
    assert!(with[1] == without[1]);
    // The page lists the files of the run; what it shows is the same.
    let shown = |page: &str| page.split("Where this comes from").next().unwrap().to_owned();
    assert!(shown(&with[0]) == shown(&without[0]));
}

/// Reaching, staying and tasks with a memory, with a horizon and without: what is kept is what solving again gives.
#[test]
fn a_stored_solution_of_inputs_is_the_computed_one() {
    let scratch = TempDir::new().unwrap();
    for (task, horizon) in [("reach", "8"), ("reach", "\"infinite\""), ("stay", "5"), ("sequence", "9")] {
        let file = root().join(format!("examples/tasks/{task}.json"));
        let run = scratch.path().join(format!("{task}{}", horizon.len()));
        let mut command = Command::cargo_bin("dynabs-compile").unwrap();
        command.arg(&file).arg("-o").arg(&run).args(["--no-tra", "--quiet", "--solve"]);
        command.args(["--set", &format!("/task/horizon={horizon}"), "--set", "/partition/cells=[12,12]"]);
        assert!(matches!(command.output().unwrap().status.code(), Some(0 | 1 | 3)), "{task}");
        assert!(run.join("solution.bin").exists(), "{task}");
        let opened = InputRun::open(&run).unwrap();
        let (stored, computed) =
            (opened.solution(&SolverOptions::default()), opened.solve(&SolverOptions::default()));
        assert_eq!((stored.status, stored.iterations), (computed.status, computed.iterations), "{task}");
        assert_eq!(stored.values, computed.values, "{task}");
        assert_eq!(stored.with_memory, computed.with_memory, "{task}");
        assert_eq!(stored.policy, computed.policy, "{task}");

        // It is looked at, and not believed when it is another one.
        let mut bytes = fs::read(run.join("solution.bin")).unwrap();
        let end = bytes.len() - 1;
        bytes[end] ^= 1;
        fs::write(run.join("solution.bin"), bytes).unwrap();
        assert!(InputRun::open(&run).unwrap_err().to_string().contains("other bytes"), "{task}");
    }
}
