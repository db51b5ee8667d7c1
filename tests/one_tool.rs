//! `dynabs` does what its two halves do.
use assert_cmd::Command;
use std::fs;

fn run(program: &str, arguments: &[&str]) -> (bool, String) {
    let output = Command::cargo_bin(program).unwrap().args(arguments).output().unwrap();
    (output.status.success(), String::from_utf8(output.stdout).unwrap())
}

#[test]
fn every_subcommand_has_help_and_a_manual_page() {
    let (_, help) = run("dynabs", &["--help"]);
    let listed = help.split("Commands:").nth(1).unwrap().split("Options:").next().unwrap();
    let names: Vec<&str> = (listed.lines())
        .filter(|line| line.starts_with("  ") && !line.starts_with("   "))
        .filter_map(|line| line.split_whitespace().next())
        .filter(|&name| name != "help")
        .collect();
    let scratch = tempfile::tempdir().unwrap();
    assert!(run("dynabs", &["man", scratch.path().to_str().unwrap()]).0);
    for name in &names {
        let (done, help) = run("dynabs", &[name, "--help"]);
        assert!(done && help.contains("Example"), "{name}: {help}");
        for line in help.lines().filter(|line| !line.contains("  dynabs ")) {
            assert!(line.chars().count() <= 100, "{name}: {line}");
        }
        let page = fs::read_to_string(scratch.path().join(format!("dynabs-{name}.1"))).unwrap();
        assert!(page.contains(".SH SYNOPSIS"), "{name}");
    }
    assert!(names.len() >= 14, "{names:?}");
    for shell in ["bash", "zsh", "fish"] {
        let (done, script) = run("dynabs", &["completions", shell]);
        assert!(done && names.iter().all(|name| script.contains(name)), "{shell}");
    }
}

#[test]
fn a_model_is_begun_compiled_and_solved() {
    let scratch = tempfile::tempdir().unwrap();
    let path = |name: &str| scratch.path().join(name).to_str().unwrap().to_owned();
    assert!(run("dynabs", &["init", &path("my.json")]).0);
    assert!(!run("dynabs", &["init", &path("my.json")]).0, "never overwritten");
    assert!(
        run("dynabs", &["compile", &path("my.json"), "-q", "--solve", "--threads", "1", "-o", &path("one")])
            .0
    );
    assert!(
        run("dynabs-compile", &[&path("my.json"), "-q", "--solve", "--threads", "1", "-o", &path("two")]).0
    );
    for file in ["manifest.json", "model.dynabs", "model.tra", "solution.bin"] {
        let read = |run: &str| fs::read(scratch.path().join(run).join(file)).unwrap();
        assert_eq!(read("one"), read("two"), "{file}");
    }
    assert!(run("dynabs", &["export", &path("one"), "-o", &path("my.c")]).0);
    assert_eq!(run("dynabs", &["schema"]), run("dynabs-compile", &["--schema"]));
}

/// The verdict is the last line; what there is to know besides is asked for.
#[test]
fn the_verdict_is_the_last_line() {
    let scratch = tempfile::tempdir().unwrap();
    let out = scratch.path().join("room").to_str().unwrap().to_owned();
    let model = crate::common::root().join("models/room_temperature.json");
    let compiled = |more: &[&str]| {
        let arguments =
            [&["compile", model.to_str().unwrap(), "--solve", "--force", "-o", &out], more].concat();
        let output = Command::cargo_bin("dynabs").unwrap().args(arguments).output().unwrap();
        (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap())
    };
    let verdict = "  true   value in [0.993345, 0.993346] against >=0.9 at the initial state";
    let (text, said) = compiled(&[]);
    assert_eq!((text.lines().last(), said.as_str()), (Some(verdict), ""));
    assert_eq!(text.matches("U<=6").count(), 1, "the property once: {text}");
    let (more, said) = compiled(&["--verbose"]);
    assert_eq!(more.lines().last(), Some(verdict));
    assert!(said.starts_with("times: model file "), "{said}");
    for detail in ["  budget       cells ", "  unseen mass  at most ", "  solved: [0.9933455"] {
        assert!(more.contains(detail) && !text.contains(detail), "{detail}: {more}");
    }
    let (_, text) = run("dynabs", &["solve", &out]);
    assert_eq!(text.lines().last(), Some(verdict));
    let (_, text) = run("dynabs", &["solve", &out, "-p", "(Pmaxmin=? [ F \"reached\" ])>=0.9999"]);
    let last = text.lines().last().unwrap();
    assert!(
        last.starts_with("  false   value in [0.99334")
            && last.ends_with("against >=0.9999 at the initial state"),
        "{last}"
    );
}

/// Files are called what they are.
#[test]
fn names_that_promise_something_else_are_refused() {
    let scratch = tempfile::tempdir().unwrap();
    let path = |name: &str| scratch.path().join(name).to_str().unwrap().to_owned();
    assert!(run("dynabs", &["init", &path("my.json")]).0);
    assert!(run("dynabs", &["compile", &path("my.json"), "-q", "--solve", "--no-tra", "-o", &path("run")]).0);
    let (directory, foo) = (path("run"), path("x.foo"));
    for arguments in [
        &["init", &foo][..],
        &["export", &directory, "-o", &foo],
        &["report", &directory, "-o", &foo],
        &["simulate", &directory, "--runs", "10", "--trajectories", &foo],
        &["convert", &directory, &foo],
        &["diff", &directory, "--write-reference", &foo],
        &["solve", &foo],
    ] {
        let output = Command::cargo_bin("dynabs").unwrap().args(arguments).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(
            said.contains("x.foo") && said.contains(" end") && said.contains("expected"),
            "{arguments:?}: {said}"
        );
        assert!(!scratch.path().join("x.foo").exists());
    }
}
