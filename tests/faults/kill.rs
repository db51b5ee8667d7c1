//! Every command that writes, killed at random moments, over nothing and over earlier output.

use super::{files, left_over};
use assert_cmd::cargo::cargo_bin;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// How often each command is killed, over nothing and over earlier output.
fn kills() -> u32 {
    std::env::var("DYNABS_KILLS").ok().and_then(|text| text.parse().ok()).unwrap_or(200)
}

/// So many rounds for each kill are enough.
const MOST_ROUNDS: u32 = 5;

/// A command that writes into its current directory; `IN` stands for a directory with the runs `old` and `new`.
struct Writer {
    program: &'static str,
    /// The arguments for the earlier output and for the new one.
    arguments: [&'static str; 2],
    /// It never overwrites.
    only_new: bool,
}

const fn check(old: &'static str, new: &'static str) -> Writer {
    Writer { program: "dynabs-check", arguments: [old, new], only_new: false }
}

#[test]
fn compile() {
    let arguments =
        ["IN/model.json -q -o run --force --seed 1", "IN/model.json -q -o run --force --seed 2 --format drn"];
    trial(&Writer { program: "dynabs-compile", arguments, only_new: false });
}

#[test]
fn init() {
    let arguments = ["--init model.json -q", "--init model.json -q"];
    trial(&Writer { program: "dynabs-compile", arguments, only_new: true });
}

#[test]
fn solve() {
    trial(&check(
        "solve IN/old -q --values values --policy policy --certificate certificate",
        "solve IN/new -q --values values --policy policy --certificate certificate",
    ));
}

#[test]
fn convert() {
    trial(&check("convert IN/old model.tra -q --force", "convert IN/new model.tra -q --force"));
}

#[test]
fn controller() {
    trial(&check("controller IN/old -q -o c.json", "controller IN/new -q -o c.json"));
}

#[test]
fn simulate() {
    trial(&check(
        "simulate IN/old -q --runs 10 --seed 1 --trajectories runs.csv",
        "simulate IN/new -q --runs 10 --seed 2 --trajectories runs.csv",
    ));
}

#[test]
fn report() {
    trial(&check(
        "report IN/old -q --runs 10 --no-times -o page.html --svg .",
        "report IN/new -q --runs 10 --no-times -o page.html --svg .",
    ));
}

#[test]
fn write_reference() {
    trial(&check(
        "diff IN/old --write-reference reference.json",
        "diff IN/new --write-reference reference.json",
    ));
}

/// Kills a command again and again and looks at what is there.
fn trial(writer: &Writer) {
    let scratch = TempDir::new().unwrap();
    let input = inputs(scratch.path());
    let work = scratch.path().join("work");
    let [old, new] = [0, 1].map(|version| {
        fs::create_dir(&work).unwrap();
        let status = start(writer, version, &input, &work).wait().unwrap();
        assert!(status.code().is_some_and(|code| code <= 1), "{}: {status}", writer.arguments[version]);
        let written = files(&work);
        fs::remove_dir_all(&work).unwrap();
        written
    });
    assert!(!new.is_empty() && (writer.only_new || old != new));
    let longest = longest(writer, &input, &work);
    let nothing = BTreeMap::new();
    let mut random = 1u64;
    let befores = if writer.only_new { vec![&nothing] } else { vec![&nothing, &old] };
    for before in befores {
        let mut landed = 0;
        // Some are over before they are killed.
        for round in 0..MOST_ROUNDS * kills() {
            if landed == kills() {
                break;
            }
            fs::create_dir(&work).unwrap();
            lay(before, &work);
            // Any sequence of moments does, as long as it is the same every time.
            random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let moment = longest.mul_f64((random >> 40) as f64 / f64::from(1 << 24));
            let mut child = start(writer, 1, &input, &work);
            std::thread::sleep(moment);
            landed += u32::from(child.try_wait().unwrap().is_none());
            child.kill().unwrap();
            child.wait().unwrap();
            if work.join("run").exists() {
                // No reader is needed: a run is there as a whole at every moment.
                is_whole(&files(&work), before, &new, round);
            }
            imdp::files::settle(&work).unwrap();
            is_whole(&files(&work), before, &new, round);
            // What the next command that writes there does first.
            imdp::files::clear(&work);
            assert_eq!(left_over(&work), [""; 0], "round {round}");
            assert_eq!(left_over(&work.join("run")), [""; 0], "round {round}");
            is_whole(&files(&work), before, &new, round);
            fs::remove_dir_all(&work).unwrap();
        }
        assert_eq!(landed, kills(), "kills that came in time");
    }
}

fn is_whole(
    found: &BTreeMap<String, Vec<u8>>,
    before: &BTreeMap<String, Vec<u8>>,
    new: &BTreeMap<String, Vec<u8>>,
    round: u32,
) {
    if found != before && found != new {
        let names: Vec<_> = found.keys().collect();
        panic!("round {round}: neither the old nor the new output, but {names:?}");
    }
}

/// A model and two runs of it, small so that much of the time goes into writing.
fn inputs(scratch: &Path) -> PathBuf {
    let input = scratch.join("in");
    fs::create_dir(&input).unwrap();
    let room = crate::common::root().join("models/room_temperature.json");
    let text = fs::read_to_string(room).unwrap();
    let mut model: serde_json::Value = serde_json::from_str(&text).unwrap();
    model["partition"]["cells"] = serde_json::json!([24]);
    model["noise"]["count"] = 400.into();
    fs::write(input.join("model.json"), model.to_string()).unwrap();
    for (name, seed) in [("old", "1"), ("new", "2")] {
        let mut command = Command::new(cargo_bin("dynabs-compile"));
        command.current_dir(&input).args(["model.json", "-q", "-o", name, "--seed", seed]);
        assert!(command.status().unwrap().success());
    }
    input
}

fn start(writer: &Writer, version: usize, input: &Path, work: &Path) -> Child {
    let arguments = writer.arguments[version].replace("IN", input.to_str().unwrap());
    let mut command = Command::new(cargo_bin(writer.program));
    command.current_dir(work).args(arguments.split(' '));
    command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
}

/// A little more than the command takes.
fn longest(writer: &Writer, input: &Path, work: &Path) -> Duration {
    let time = |_| {
        fs::create_dir(work).unwrap();
        let clock = Instant::now();
        start(writer, 1, input, work).wait().unwrap();
        let time = clock.elapsed();
        fs::remove_dir_all(work).unwrap();
        time
    };
    (0..5).map(time).min().unwrap_or_default().mul_f64(1.1)
}

fn lay(files: &BTreeMap<String, Vec<u8>>, directory: &Path) {
    for (name, bytes) in files {
        let path = directory.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, bytes).unwrap();
    }
}
