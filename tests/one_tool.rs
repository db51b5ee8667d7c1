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
        assert!(run("dynabs", &[name, "--help"]).0, "{name}");
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
