//! `dynabs-check crosscheck` with engines that are right, wrong, broken or missing.
//!
//! The engine is a shell script in PRISM's place that replays a recorded run of PRISM 4.10, or misbehaves. With
//! `$PRISM` set the real one is asked too. What Storm says is tested by `crosscheck_storm`.
#![cfg(unix)]

use assert_cmd::Command;
use serde_json::Value;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::PathBuf;
use std::time::{Duration, Instant};
use tempfile::TempDir;

/// In state 0, b is better within two steps or more, a within one.
const TRA: &str = "\
4 7 12
0 0 1 [0.2,0.5] a
0 0 2 [0.2,0.5] a
0 0 3 [0.3,0.5] a
0 1 1 [0.5,0.7] b
0 1 2 [0.1,0.2] b
0 1 3 [0.2,0.3] b
0 2 3 [1,1] c
1 0 2 [0.6,0.9] d
1 0 3 [0.1,0.4] d
1 1 1 [1,1] e
2 0 2 [1,1]
3 0 3 [1,1]
";
const STA: &str = "(s)\n0:(0)\n1:(1)\n2:(2)\n3:(3)\n";
const LAB: &str = "0=\"init\" 1=\"deadlock\" 2=\"goal\"\n0: 0\n2: 2\n";
const BOUNDED: &str = "Pmaxmin=? [ F<=2 \"goal\" ]";
const UNBOUNDED: &str = "Pmaxmin=? [ F \"goal\" ]";

/// What PRISM 4.10 says and writes about the model above and the bounded property.
const LOG: &str = include_str!("data/prism/log.txt");
const VALUES: &str = include_str!("data/prism/values.txt");
const STRATEGY: &str = include_str!("data/prism/strategy.txt");

struct Scratch {
    directory: TempDir,
    /// Where programs may leave temporary files, and must not.
    temporary: TempDir,
}

impl Scratch {
    fn new() -> Self {
        let scratch = Self { directory: TempDir::new().unwrap(), temporary: TempDir::new().unwrap() };
        for (name, text) in [("model.tra", TRA), ("model.sta", STA), ("model.lab", LAB)] {
            fs::write(scratch.path(name), text).unwrap();
        }
        scratch
    }

    fn path(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    /// A program in PRISM's place; its working directory is the one with the model.
    fn engine(&self, script: &str) -> PathBuf {
        let path = self.path("engine");
        fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
        path
    }

    /// A program that replays a run.
    fn replay(&self, log: &str, values: &str, strategy: &str) -> PathBuf {
        for (name, text) in [("log", log), ("values", values), ("strategy", strategy)] {
            fs::write(self.path(name), text).unwrap();
        }
        let at = |name| self.path(name).display().to_string();
        let (log, values, strategy) = (at("log"), at("values"), at("strategy"));
        self.engine(&format!(
            "printf '%s\\n' \"$@\" >'{}'\ncat '{log}'\ncp '{values}' values.txt\ncp '{strategy}' strategy.txt",
            at("arguments")
        ))
    }

    fn check(&self, engine: &PathBuf, further: &[&str]) -> (i32, Value, String) {
        let mut command = Command::cargo_bin("dynabs-check").unwrap();
        command.arg("crosscheck").arg(self.path("model.tra")).args(["--with", "prism", "--json", "--prism"]);
        command.arg(engine).args(further).env("TMPDIR", self.temporary.path()).env_remove("PRISM");
        let output = command.output().unwrap();
        let left: Vec<_> = fs::read_dir(self.temporary.path()).unwrap().collect();
        assert!(left.is_empty(), "left behind: {left:?}");
        let stderr = String::from_utf8(output.stderr).unwrap();
        (output.status.code().unwrap(), serde_json::from_slice(&output.stdout).unwrap_or(Value::Null), stderr)
    }

    /// The finding about the bounded property; panics unless the exit code is this.
    fn finding(&self, engine: &PathBuf, code: i32, further: &[&str]) -> Value {
        let (found, json, stderr) = self.check(engine, &[&["-p", BOUNDED], further].concat());
        assert_eq!(found, code, "{json:#}{stderr}");
        assert_eq!(json["agree"], code == 0);
        json["findings"][0].clone()
    }

    /// What is said about an engine that gave no answer.
    fn failure(&self, script: &str, further: &[&str]) -> String {
        let finding = self.finding(&self.engine(script), 3, further);
        assert_eq!(finding["agreement"], "failed", "{finding:#}");
        assert!(finding["value"].is_null());
        finding["notes"][0].as_str().unwrap().to_owned()
    }
}

#[test]
fn a_recorded_run_agrees() {
    let scratch = Scratch::new();
    let engine = scratch.replay(LOG, VALUES, STRATEGY);
    let finding = scratch.finding(&engine, 0, &["--memory", "2g"]);
    assert_eq!(finding["agreement"], "agrees");
    assert_eq!(finding["engine"], "PRISM");
    assert!(finding["version"].as_str().unwrap().starts_with("4.10"));
    assert!(finding["difference"].as_f64().unwrap() < 1e-14);
    assert!(finding["strategy"]["shortfall"].as_f64().unwrap() < 1e-15);
    let arguments = fs::read_to_string(scratch.path("arguments")).unwrap();
    for expected in
        ["-importmodel\nmodel.tra,sta,lab\n-ex\n", "-javamaxmem\n1536m\n", &format!("-pf\n{BOUNDED}\n")]
    {
        assert!(arguments.contains(expected), "{arguments}");
    }
}

/// A real PRISM says today what was recorded.
#[test]
fn a_real_prism_agrees() {
    let Some(prism) = std::env::var_os("PRISM").filter(|name| !name.is_empty()).map(PathBuf::from) else {
        return;
    };
    let scratch = Scratch::new();
    let (code, json, stderr) = scratch.check(&prism, &["-p", BOUNDED, "-p", UNBOUNDED, "--memory", "1g"]);
    assert_eq!(code, 0, "{json:#}{stderr}");
    for finding in json["findings"].as_array().unwrap() {
        assert!(finding["difference"].as_f64().unwrap() < 1e-9);
        assert!(finding["strategy"]["decisions"].as_u64().unwrap() > 0);
    }
}

#[test]
fn a_wrong_value_of_any_state_disagrees() {
    for (state, line) in VALUES.lines().enumerate() {
        let wrong = if line == "0.0" { "0.000000001" } else { "0.9" };
        let values: Vec<_> =
            VALUES.lines().enumerate().map(|(s, l)| if s == state { wrong } else { l }).collect();
        let scratch = Scratch::new();
        let engine = scratch.replay(LOG, &values.join("\n"), STRATEGY);
        let finding = scratch.finding(&engine, 1, &[]);
        assert_eq!(finding["agreement"], "disagrees", "state {state}");
        assert_eq!(finding["state"], state);
    }
}

/// Without a bound on the steps, a value that is far off is wrong unless the engine was still on its way.
#[test]
fn a_wrong_unbounded_value_disagrees() {
    let scratch = Scratch::new();
    for (values, code) in [("0.46\n0.6\n1\n0\n", 0), ("0.45\n0.6\n1\n0\n", 1), ("0.46\n0.61\n1\n0\n", 1)] {
        let engine = scratch.replay(LOG, values, "");
        let (found, json, _) = scratch.check(&engine, &["-p", UNBOUNDED]);
        assert_eq!(found, code, "{values} {json:#}");
    }
}

#[test]
fn a_worse_strategy_disagrees() {
    let scratch = Scratch::new();
    let engine = scratch.replay(LOG, VALUES, &STRATEGY.replace("0,0=1", "0,0=2"));
    let finding = scratch.finding(&engine, 1, &[]);
    assert!(finding["strategy"]["shortfall"].as_f64().unwrap() > 0.1);
    assert!(finding["notes"][0].as_str().unwrap().contains("its strategy is worse than its values say"));
}

#[test]
fn a_strategy_of_another_model_is_refused() {
    let scratch = Scratch::new();
    for strategy in ["0,0=3\n", "9,0=0\n", "0,0\n"] {
        let finding = scratch.finding(&scratch.replay(LOG, VALUES, strategy), 3, &[]);
        assert!(finding["notes"][0].as_str().unwrap().contains("line 1 of its strategy"), "{finding:#}");
    }
}

#[test]
fn a_wrong_path_is_an_error() {
    let scratch = Scratch::new();
    for path in [scratch.path("nothing"), scratch.path("model.tra"), scratch.directory.path().to_path_buf()] {
        let (code, _, stderr) = scratch.check(&path, &["-p", BOUNDED]);
        assert_eq!(code, 2);
        assert!(stderr.contains("is no program") && stderr.contains("prismmodelchecker.org"), "{stderr}");
    }
}

#[test]
fn an_exit_code_is_a_failure_whatever_was_written() {
    let scratch = Scratch::new();
    let values = scratch.path("values");
    scratch.replay(LOG, VALUES, STRATEGY);
    let script = format!("cp '{}' values.txt\necho 'Error: no such thing.'\nexit 7", values.display());
    let said = scratch.failure(&script, &[]);
    assert!(said.contains("exit code 7") && said.contains("Error: no such thing."), "{said}");
}

/// PRISM ends with exit code 0 when it does not converge.
#[test]
fn an_error_without_exit_code_is_shown() {
    let said =
        Scratch::new().failure("echo; echo 'Error: Iterative method did not converge.'; echo more", &[]);
    assert!(said.contains("without an answer and said: Error: Iterative method did not converge."), "{said}");
}

#[test]
fn garbage_is_a_failure() {
    let scratch = Scratch::new();
    for (text, expected) in [
        ("<html>", "line 1 of its values: found \"<html>\""),
        ("0.5\\n0.5\\ntrue\\nfalse", "line 3 of its values: found \"true\""),
        ("\\377\\376\\n0\\n0\\n0", "line 1 of its values: found"),
    ] {
        let said = scratch.failure(&format!("printf '{text}' >values.txt"), &[]);
        assert!(said.contains(expected), "{said}");
    }
}

#[test]
fn missing_values_are_a_failure() {
    let said = Scratch::new().failure("echo 'Result: 0.46'", &[]);
    assert!(said.contains("without an answer") && said.contains("Result: 0.46"), "{said}");
}

#[test]
fn a_short_or_long_vector_is_a_failure() {
    let scratch = Scratch::new();
    for (text, found) in [("0.46\\n0.6\\n1\\n", 3), ("", 0), ("0.46\\n0.6\\n1\\n0\\n0\\n", 5)] {
        let said = scratch.failure(&format!("printf '{text}' >values.txt"), &[]);
        assert!(
            said.contains(&format!("its values: found {found}; expected one for each of the 4 states")),
            "{said}"
        );
    }
}

#[test]
fn what_is_no_probability_is_a_failure() {
    let scratch = Scratch::new();
    for value in ["NaN", "Infinity", "-0.1", "1.1"] {
        let said = scratch.failure(&format!("printf '0.46\\n{value}\\n1\\n0\\n' >values.txt"), &[]);
        assert!(said.contains("its value of state 1"), "{said}");
    }
}

/// The whole group is ended: the program and what it started.
#[test]
fn a_program_that_hangs_is_ended_with_its_children() {
    let scratch = Scratch::new();
    let mark = scratch.path("mark");
    let start = Instant::now();
    let script = format!("(sleep 3; touch '{}') &\nsleep 60", mark.display());
    let said = scratch.failure(&script, &["--timeout", "0.5"]);
    assert!(said.contains("did not answer within 0.5 s"), "{said}");
    assert!(start.elapsed() < Duration::from_secs(30));
    std::thread::sleep(Duration::from_secs(3).saturating_sub(start.elapsed()) + Duration::from_millis(500));
    assert!(!mark.exists(), "a child outlived the time limit");
}

/// Children that keep the output open do not keep us waiting.
#[test]
fn children_of_a_program_that_ended_are_ended() {
    let scratch = Scratch::new();
    let start = Instant::now();
    scratch.failure("sleep 60 &\nexit 1", &[]);
    assert!(start.elapsed() < Duration::from_secs(30));
}

#[test]
fn a_killed_program_is_a_failure() {
    let said = Scratch::new().failure("printf '0.46\\n0.6\\n1\\n0\\n' >values.txt\nkill -9 $$", &[]);
    assert!(said.contains("killed by signal 9"), "{said}");
}

#[test]
fn ctrl_c_ends_the_engine_and_leaves_nothing() {
    let scratch = Scratch::new();
    let mark = scratch.path("mark");
    let engine =
        scratch.engine(&format!("touch '{}.started'\nsleep 4\ntouch '{}'", mark.display(), mark.display()));
    let mut child = std::process::Command::new(assert_cmd::cargo::cargo_bin("dynabs-check"))
        .arg("crosscheck")
        .arg(scratch.path("model.tra"))
        .args(["--with", "prism", "--quiet", "-p", BOUNDED, "--prism"])
        .arg(&engine)
        .env("TMPDIR", scratch.temporary.path())
        .spawn()
        .unwrap();
    let started = scratch.path("mark.started");
    let start = Instant::now();
    while !started.exists() && start.elapsed() < Duration::from_secs(20) {
        std::thread::sleep(Duration::from_millis(20));
    }
    let pid = child.id().to_string();
    assert!(
        std::process::Command::new("sh")
            .args(["-c", &format!("kill -INT {pid}")])
            .status()
            .unwrap()
            .success()
    );
    assert_eq!(child.wait().unwrap().code(), Some(3));
    assert!(fs::read_dir(scratch.temporary.path()).unwrap().next().is_none());
    std::thread::sleep(Duration::from_millis(4500));
    assert!(!mark.exists(), "the engine outlived Ctrl-C");
}

/// One engine that agrees is not all of them.
#[test]
fn a_missing_engine_is_not_passed_over() {
    let scratch = Scratch::new();
    let mut command = Command::cargo_bin("dynabs-check").unwrap();
    command.arg("crosscheck").arg(scratch.path("model.tra")).args(["-p", BOUNDED, "--json", "--prism"]);
    command.arg(scratch.replay(LOG, VALUES, STRATEGY)).env("DYNABS_PYTHON", "/nothing/python");
    let output = command.output().unwrap();
    assert_eq!(output.status.code(), Some(3));
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(json["findings"][0]["agreement"], "agrees");
    assert_eq!((&json["missing"][0], &json["agree"]), (&"Storm".into(), &false.into()));
    assert!(String::from_utf8_lossy(&output.stderr).contains("pip install stormpy"));
}

/// A Python whose stormpy does this.
fn ask_storm(scratch: &Scratch, script: &str) -> (i32, String) {
    let python = scratch.engine(&format!("if [ \"$1\" = -c ]; then echo stormpy 2.0.0; exit; fi\n{script}"));
    let mut command = Command::cargo_bin("dynabs-check").unwrap();
    command
        .arg("crosscheck")
        .arg(scratch.path("model.tra"))
        .args(["-p", BOUNDED, "--with", "storm", "--json"]);
    command.args(["--timeout", "2", "--python"]).arg(python).env("TMPDIR", scratch.temporary.path());
    let output = command.output().unwrap();
    assert!(fs::read_dir(scratch.temporary.path()).unwrap().next().is_none());
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    let note = json["findings"][0]["notes"][0].as_str().unwrap_or_default().to_owned();
    (output.status.code().unwrap(), note)
}

/// 0.46, 0.6, 1 and 0 as little-endian doubles.
const STORM_VALUES: &str = r"printf '\161\075\012\327\243\160\335\077\063\063\063\063\063\063\343\077\000\000\000\000\000\000\360\077\000\000\000\000\000\000\000\000' >0.values";
const STORM_REPORT: &str = r#"echo '{"seconds": 0.1, "error": null}' >0.json"#;

#[test]
fn a_broken_storm_never_agrees() {
    let scratch = Scratch::new();
    let (code, note) = ask_storm(&scratch, &format!("{STORM_VALUES}\n{STORM_REPORT}"));
    assert_eq!((code, note.as_str()), (0, ""));
    for (script, expected) in [
        ("echo 'RuntimeError: no' >&2; exit 1".to_owned(), "exit code 1 and said: RuntimeError: no"),
        (STORM_VALUES.to_owned(), "without an answer"),
        (STORM_REPORT.to_owned(), "0.values"),
        (
            format!("{STORM_VALUES}\necho x >>0.values\n{STORM_REPORT}"),
            "expected one for each of the 4 states",
        ),
        (format!("{STORM_VALUES}\necho garbage >0.json"), "without an answer"),
        (
            r#"echo '{"seconds": 0.1, "error": "not supported"}' >0.json"#.to_owned(),
            "found an error of its own: not supported",
        ),
        (format!("{STORM_VALUES}\nsleep 30"), "did not answer within 2 s"),
        (format!("{STORM_VALUES}\nkill -9 $$"), "killed by signal 9"),
    ] {
        let (code, note) = ask_storm(&scratch, &script);
        assert!(code == 3 && note.contains(expected), "{script}: {code} {note}");
    }
    let wrong = STORM_VALUES.replacen(r"\161", r"\162", 1).replacen(r"\160", r"\150", 1);
    assert_eq!(ask_storm(&scratch, &format!("{wrong}\n{STORM_REPORT}")).0, 1);
}

/// Step-bounded values of interval models are wrong in stormpy 1.
#[test]
fn an_old_stormpy_is_refused() {
    let scratch = Scratch::new();
    let python = scratch.engine("echo stormpy 1.12.0");
    let mut command = Command::cargo_bin("dynabs-check").unwrap();
    command
        .arg("crosscheck")
        .arg(scratch.path("model.tra"))
        .args(["-p", BOUNDED, "--with", "storm", "--python"]);
    let output = command.arg(python).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("has stormpy 1.12.0, which is too old"));
}

/// Lower bounds of 0 are refused by PRISM: it gets a copy of the files with the smallest that matters to nobody.
#[test]
fn files_with_lower_bounds_of_zero_are_rewritten() {
    let scratch = Scratch::new();
    fs::write(scratch.path("model.tra"), TRA.replace("[0.2,0.5]", "[0,0.5]")).unwrap();
    let copy = scratch.path("copy");
    let engine = scratch.engine(&format!("cp model.tra '{}'; exit 1", copy.display()));
    scratch.finding(&engine, 3, &[]);
    let copied = fs::read_to_string(copy).unwrap();
    assert_eq!(copied, TRA.replace("[0.2,0.5]", "[1e-300,0.5]"));
}
