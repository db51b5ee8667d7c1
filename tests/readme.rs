//! The commands of the README are run as they stand there, and print what it shows.
use crate::common::root;
use assert_cmd::cargo::cargo_bin;
use std::fs;
use std::process::Command;
use tempfile::TempDir;

/// A block of commands, and what the text shows of the output of the last one.
struct Block {
    commands: Vec<String>,
    shown: Option<String>,
}

fn blocks(text: &str) -> Vec<Block> {
    let block = |rest: &str| {
        let (commands, after) = rest.split_once("```\n").unwrap();
        let shown = after.trim_start().strip_prefix("```text\n").and_then(|shown| shown.split("```").next());
        Block { commands: commands.lines().map(str::to_owned).collect(), shown: shown.map(str::to_owned) }
    };
    text.split("```sh\n").skip(1).map(block).collect()
}

/// Whether every line is the one that is shown; `…` at its end stands for more.
fn is_shown(shown: &str, output: &str) -> bool {
    let is_line = |(shown, line): (&str, &str)| match shown.strip_suffix('…') {
        Some(beginning) => line.starts_with(beginning),
        None => line == shown,
    };
    shown.lines().count() == output.lines().count() && shown.lines().zip(output.lines()).all(is_line)
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
    let blocks = blocks(&readme);
    assert_eq!(blocks[0].commands[0], "cargo install --path .", "what a newcomer does first");
    let (mut ran, mut compared) = (0, 0);
    for Block { commands, shown } in &blocks {
        let mut printed = String::new();
        for line in commands {
            // This test is run by `cargo test`: the programs are those that it has built.
            let line = line
                .strip_prefix("cargo run --release --bin ")
                .map_or(line.clone(), |run| run.replacen(" --", "", 1));
            let (program, arguments) = line.split_once(' ').unwrap();
            let path = match program {
                "dynabs" => cargo_bin(program),
                "cargo" if ["install --path .", "test"].contains(&arguments) => continue,
                other => panic!("{other}: a program that this test does not know, in {line}"),
            };
            let shell = format!("'{}' {arguments}", path.display());
            let output =
                Command::new("sh").args(["-c", &shell]).current_dir(scratch.path()).output().unwrap();
            let said = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success(), "{line}\n{said}");
            printed = String::from_utf8(output.stdout).unwrap();
            ran += 1;
        }
        if let Some(shown) = shown {
            assert!(is_shown(shown, &printed), "shown:\n{shown}\nprinted:\n{printed}");
            compared += 1;
        }
    }
    assert!(ran >= 10 && compared >= 1, "{ran} commands, {compared} outputs");
}
