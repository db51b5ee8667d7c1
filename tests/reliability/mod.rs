//! Files, processes and limits: nothing outside of the output is touched, nothing is lost, nothing hangs, and every exit
//! code is a documented one. The inputs are in `tests/data/reliability`.

mod appearing;
mod counts;
mod damage;
mod foreign;
mod limits;
mod places;
mod signals;
mod terminal;

use crate::common::root;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::Duration;

/// How a program ended.
#[derive(Debug)]
pub struct Ended {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

impl From<Output> for Ended {
    fn from(output: Output) -> Self {
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        Self { code: output.status.code(), out: text(&output.stdout), err: text(&output.stderr) }
    }
}

pub fn program(name: &str) -> Command {
    Command::new(assert_cmd::cargo::cargo_bin(name))
}

pub fn compile(arguments: &[&str]) -> Ended {
    program("dynabs-compile").args(arguments).output().unwrap().into()
}

pub fn check(arguments: &[&str]) -> Ended {
    program("dynabs-check").args(arguments).output().unwrap().into()
}

/// Runs a line of the shell with both programs in `$compile` and `$check` and the room in `$room`, in `directory`.
pub fn shell(directory: &Path, line: &str) -> Ended {
    let mut command = Command::new("bash");
    command.args(["-c", line]).current_dir(directory);
    command.env("compile", assert_cmd::cargo::cargo_bin("dynabs-compile"));
    command.env("check", assert_cmd::cargo::cargo_bin("dynabs-check"));
    command.env("room", room()).env("data", data(""));
    command.output().unwrap().into()
}

/// Runs a command that must end soon.
pub fn in_time(mut command: Command, seconds: u64) -> Ended {
    use std::process::Stdio;
    let mut child =
        command.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let start = std::time::Instant::now();
    while child.try_wait().unwrap().is_none() {
        if start.elapsed() > Duration::from_secs(seconds) {
            child.kill().unwrap();
            panic!("{command:?} did not end in {seconds} s");
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    child.wait_with_output().unwrap().into()
}

/// The model of one room.
pub fn room() -> PathBuf {
    root().join("models/room_temperature.json")
}

/// An input of these tests.
pub fn data(name: &str) -> PathBuf {
    root().join("tests/data/reliability").join(name)
}

/// The compiled room in `directory/name`.
pub fn compiled(directory: &Path, name: &str) -> PathBuf {
    let path = directory.join(name);
    let ended = compile(&[room().to_str().unwrap(), "-q", "-o", path.to_str().unwrap()]);
    assert_eq!(ended.code, Some(0), "{}", ended.err);
    path
}

/// All files of a directory.
pub fn contents(directory: &Path) -> BTreeMap<String, Vec<u8>> {
    let files = fs::read_dir(directory).unwrap().map(|entry| entry.unwrap());
    let files = files.filter(|entry| entry.file_type().unwrap().is_file());
    files.map(|file| (file.file_name().into_string().unwrap(), fs::read(file.path()).unwrap())).collect()
}

/// The names in a directory.
pub fn names(directory: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(directory)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}
