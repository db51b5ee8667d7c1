//! The commands of the README are run as they stand there.
use crate::common::root;
use assert_cmd::cargo::cargo_bin;
use std::fs;
use std::process::Command;
use tempfile::TempDir;

/// The lines of all blocks of shell commands.
fn commands(text: &str) -> Vec<String> {
    let blocks = text.split("```sh\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    blocks.flat_map(str::lines).map(str::to_owned).collect()
}

#[test]
fn its_commands_work_in_this_order() {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    assert!(readme.lines().count() <= 150, "{} lines", readme.lines().count());
    let scratch = TempDir::new().unwrap();
    for name in ["models", "src", "docs"] {
        #[cfg(unix)]
        std::os::unix::fs::symlink(root().join(name), scratch.path().join(name)).unwrap();
    }
    let mut ran = 0;
    for line in commands(&readme) {
        // This test is run by `cargo test`; programs are those that it has built.
        let line = line.replace("cargo run --release --bin dynabs-compile --", "dynabs-compile");
        let (program, arguments) = line.split_once(' ').unwrap();
        let path = match program {
            "dynabs-compile" | "dynabs-check" => cargo_bin(program),
            "cargo" if arguments == "test" => continue,
            other => panic!("{other}: a program that this test does not know, in {line}"),
        };
        let shell = format!("'{}' {arguments}", path.display());
        let output = Command::new("sh").args(["-c", &shell]).current_dir(scratch.path()).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{line}\n{said}");
        ran += 1;
    }
    assert!(ran >= 9, "{ran} commands");
}
