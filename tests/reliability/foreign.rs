//! What others wrote: no name in it is a path, and nothing in it vouches for anything.

use super::{check, compile, compiled, data, in_time, names, program, room};
use std::fs;
use tempfile::TempDir;

/// F01: a manifest that somebody made lists `../victim`, an absolute path and a file of the user's.
#[test]
fn names_in_a_manifest_are_not_paths() {
    let scratch = TempDir::new().unwrap();
    let (evil, victim) = (scratch.path().join("evil"), scratch.path().join("victim"));
    fs::create_dir(&evil).unwrap();
    fs::write(&victim, "precious").unwrap();
    fs::write(evil.join("thesis.tex"), "precious").unwrap();
    let manifest = fs::read_to_string(data("01-manifest.json")).unwrap();
    for name in ["../victim", victim.to_str().unwrap(), "thesis.tex", "../evil/../victim"] {
        fs::write(evil.join("manifest.json"), manifest.replace("../victim", name)).unwrap();
        let ended =
            compile(&[room().to_str().unwrap(), "-q", "--no-tra", "-o", evil.to_str().unwrap(), "--force"]);
        assert_eq!(ended.code, Some(0), "{}", ended.err);
        assert_eq!(fs::read_to_string(&victim).unwrap(), "precious", "{name}");
        assert_eq!(fs::read_to_string(evil.join("thesis.tex")).unwrap(), "precious", "{name}");
        assert_eq!(names(scratch.path()), ["evil", "victim"]);
    }
}

/// A run that somebody made reads nothing outside of its directory.
#[test]
fn a_run_reads_nothing_outside_of_its_directory() {
    let scratch = TempDir::new().unwrap();
    let run = compiled(scratch.path(), "run");
    fs::write(scratch.path().join("secret.csv"), "1\nroot:x:0\n").unwrap();
    let text = fs::read_to_string(run.join("problem.json")).unwrap();
    let mut problem: serde_json::Value = serde_json::from_str(&text).unwrap();
    for file in ["../secret.csv", scratch.path().join("secret.csv").to_str().unwrap()] {
        problem["noise"] = serde_json::json!({"samples": {"file": file, "of": "step"}});
        let text = problem.to_string();
        let manifest = fs::read_to_string(run.join("manifest.json")).unwrap();
        let mut manifest: serde_json::Value = serde_json::from_str(&manifest).unwrap();
        let entry = manifest["outputs"].as_array_mut().unwrap();
        let entry = entry.iter_mut().find(|entry| entry["name"] == "problem.json").unwrap();
        entry["sha256"] = imdp::formats::sha256_hex(text.as_bytes()).into();
        entry["bytes"] = text.len().into();
        fs::write(run.join("problem.json"), &text).unwrap();
        fs::write(run.join("manifest.json"), manifest.to_string()).unwrap();
        let page = scratch.path().join("page.html");
        for arguments in [
            &["simulate", run.to_str().unwrap()][..],
            &["report", run.to_str().unwrap(), "-o", page.to_str().unwrap()],
        ] {
            let ended = check(arguments);
            assert_eq!(ended.code, Some(2), "{}", ended.err);
            assert!(ended.err.contains("noise.csv") && !ended.err.contains("root:x"), "{}", ended.err);
        }
        // Without a model beside it, `diff` compiles the problem.
        let bare = scratch.path().join("bare");
        fs::create_dir_all(&bare).unwrap();
        for name in ["problem.json", "manifest.json"] {
            fs::copy(run.join(name), bare.join(name)).unwrap();
        }
        let ended = check(&["diff", bare.to_str().unwrap(), run.to_str().unwrap()]);
        assert_eq!(ended.code, Some(2), "{}", ended.err);
        assert!(!ended.err.contains("root:x"), "{}", ended.err);
    }
}

/// F07: results of another model that lie in the directory are not shown as those of this one.
#[test]
fn cross_checks_of_another_model_are_not_shown() {
    let scratch = TempDir::new().unwrap();
    let run = compiled(scratch.path(), "run");
    fs::copy(data("07-crosscheck.json"), run.join("crosscheck.json")).unwrap();
    let sets = ["--set", "/input/lower=[-0.9]", "--set", "/input/upper=[0.9]"];
    let arguments = [room().to_str().unwrap().to_owned(), "-q".into(), "--force".into(), "-o".into()];
    let mut command = program("dynabs-compile");
    command.args(arguments).arg(&run).args(sets);
    assert_eq!(in_time(command, 60).code, Some(0));
    assert!(run.join("crosscheck.json").exists(), "a file of the user's stays");
    let page = scratch.path().join("page.html");
    let ended = check(&["report", run.to_str().unwrap(), "-o", page.to_str().unwrap(), "--runs", "100"]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    assert!(ended.err.contains("crosscheck.json") && ended.err.contains("another model"), "{}", ended.err);
    assert!(!fs::read_to_string(&page).unwrap().contains("agrees"));
}

/// Every file of a run is held against the manifest before it is read.
#[test]
fn a_changed_file_of_a_run_is_refused() {
    let scratch = TempDir::new().unwrap();
    let other = compiled(scratch.path(), "other");
    let page = scratch.path().join("page.html");
    for (name, arguments) in [
        ("model.dynabs", &["solve"][..]),
        ("model.dynabs", &["simulate"]),
        ("model.lab", &["solve", "--explicit"]),
        ("model.tra", &["solve", "--explicit"]),
        ("model.sta", &["solve", "--explicit"]),
        ("model.props", &["solve"]),
        ("problem.json", &["simulate"]),
        ("model.dynabs", &["report", "-o", page.to_str().unwrap()]),
    ] {
        let run = compiled(scratch.path(), "run");
        // Still a proper file of its kind, but of another model.
        let mut command = program("dynabs-compile");
        command.arg(room()).args([
            "-q",
            "--force",
            "--set",
            "/partition/cells=[24]",
            "--set",
            "/task/horizon=5",
        ]);
        assert_eq!(
            in_time(
                {
                    command.arg("-o").arg(&other);
                    command
                },
                60
            )
            .code,
            Some(0)
        );
        fs::copy(other.join(name), run.join(name)).unwrap();
        let mut command = program("dynabs-check");
        command.arg(arguments[0]).arg(&run).args(&arguments[1..]);
        let ended = in_time(command, 60);
        assert_eq!(ended.code, Some(2), "{name}: {}", ended.err);
        assert!(ended.err.contains(name) && ended.err.contains("other bytes"), "{name}: {}", ended.err);
        fs::remove_dir_all(&run).unwrap();
    }
}
