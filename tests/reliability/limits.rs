//! Where the system ends: files that are none, numbers, memory, threads.

use super::{compile, compiled, data, in_time, shell};
use std::process::Command;
use tempfile::TempDir;

/// F16: exact numbers have a size from which on they are refused.
#[test]
fn numbers_too_long_to_compute_with_are_refused() {
    let scratch = TempDir::new().unwrap();
    let mut command = super::program("dynabs-compile");
    command.arg(data("16.json")).args(["--dry-run", "-q"]);
    let ended = in_time(command, 20);
    assert_eq!(ended.code, Some(2), "{}", ended.err);
    assert!(ended.err.contains("/dynamics"), "{}", ended.err);

    // Twenty dimensions with full decimals are refused or done.
    let n = 20;
    let number = |i: usize, j: usize| {
        0.123_456_789_012_345_6 * ((3 * i + 7 * j) % 11 + 1) as f64 / 10.0 + f64::from(u8::from(i == j))
    };
    let matrix = |entry: &dyn Fn(usize, usize) -> f64| -> Vec<Vec<f64>> {
        (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
    };
    let identity = |i: usize, j: usize| f64::from(u8::from(i == j));
    let model = serde_json::json!({
        "name": "dense",
        "dynamics": {"A": matrix(&number), "B": matrix(&identity)},
        "noise": {"gaussian": {"covariance": matrix(&|i, j| 0.01 * identity(i, j))}, "count": 100, "seed": 1},
        "input": {"lower": vec![-9; n], "upper": vec![9; n]},
        "partition": {"lower": vec![0; n], "upper": vec![2; n], "cells": vec![1; n]},
        "task": {"goal": [{"lower": vec![0; n], "upper": vec![2; n]}], "horizon": 5},
    });
    let path = scratch.path().join("dense.json");
    std::fs::write(&path, model.to_string()).unwrap();
    let mut command = super::program("dynabs-compile");
    command.arg(&path).args(["--dry-run", "-q"]);
    let ended = in_time(command, 20);
    assert!(matches!(ended.code, Some(0 | 2)), "{:?}: {}", ended.code, ended.err);
}

/// F17: nothing but regular files is read, wherever a file is read.
#[cfg(unix)]
#[test]
fn pipes_devices_and_made_up_files_are_refused() {
    let scratch = TempDir::new().unwrap();
    compiled(scratch.path(), "run");
    let prepared = shell(
        scratch.path(),
        "mkfifo pipe; ln -s /dev/zero zero; printf '0=\"init\"\\n0: 0\\n' | tee pipe.lab > zero.lab
         $check solve run -q --certificate certificate; $check convert run m.tra -q
         sed 's|/proc/self/environ|pipe|' $data/17.json > 17-pipe.json; sed 's|/proc/self/environ|zero|' $data/17.json > 17-zero.json",
    );
    assert_eq!(prepared.code, Some(0), "{}", prepared.err);
    for special in ["pipe", "zero"] {
        let mut lines = vec![
            format!("$compile 17-{special}.json --dry-run"),
            format!("$compile {special} --dry-run"),
            format!("$check verify {special} run"),
            format!("$check solve run -p {special}.props"),
            format!("ln -s {special} {special}.props; $check solve run -p {special}.props"),
            format!("$check simulate run --noise {special}"),
            format!("ln -sf {special} {special}.json; $check diff {special}.json run"),
            format!("ln -sf {special} m.lab; $check solve m.tra -p 'Pmaxmin=? [ F \"reached\" ]'"),
            format!("ln -sf {special} m.sta; $check solve m.tra -p 'Pmaxmin=? [ F \"reached\" ]'"),
            format!("ln -sf {special} m.props; $check convert m.tra other.drn"),
        ];
        for extension in ["tra", "drn", "umb", "dynabs"] {
            lines.push(format!("ln -sf {special} {special}.{extension}; $check solve {special}.{extension} -p 'Pmaxmin=? [ F \"reached\" ]'"));
        }
        for name in ["manifest.json", "problem.json", "model.dynabs", "model.props"] {
            lines.push(format!("cp -r run r; ln -sf $PWD/{special} r/{name}; $check simulate r && $check solve r; code=$?; rm -r r; exit $code"));
        }
        for name in ["crosscheck.json", "values.txt", "policy.txt", "results.json"] {
            let command =
                if name == "crosscheck.json" { "report r -o page.html --runs 10" } else { "diff r run" };
            lines.push(format!(
                "cp -r run r; ln -sf $PWD/{special} r/{name}; $check {command}; code=$?; rm -r r; exit $code"
            ));
        }
        for line in lines {
            let mut command = Command::new("bash");
            let limited = format!("ulimit -v 1500000; {line}");
            command.args(["-c", &limited]).current_dir(scratch.path());
            command.env("compile", assert_cmd::cargo::cargo_bin("dynabs-compile"));
            command.env("check", assert_cmd::cargo::cargo_bin("dynabs-check"));
            let ended = in_time(command, 20);
            assert_eq!(ended.code, Some(2), "{line}: {}", ended.err);
            assert!(
                ended.err.contains("not a regular file")
                    || line.contains("-p pipe.props")
                    || line.contains("-p zero.props"),
                "{line}: {}",
                ended.err
            );
        }
    }
    let ended = compile(&[data("17.json").to_str().unwrap(), "--dry-run"]);
    assert_eq!(ended.code, Some(2), "{}", ended.err);
    assert!(ended.err.contains("not a regular file") && !ended.err.contains("PATH"), "{}", ended.err);
}

/// F20: the limits of the system have the exit code for that.
#[cfg(unix)]
#[test]
fn limits_of_the_system_have_an_exit_code() {
    let scratch = TempDir::new().unwrap();
    compiled(scratch.path(), "run");
    for line in [
        "$check solve run -q --threads 8000",
        "$check solve run -q --threads 2000",
        "$compile $room --dry-run -q --threads 8000",
    ] {
        let ended = shell(scratch.path(), &format!("timeout 20 bash -c '{line}'"));
        assert_eq!(ended.code, Some(2), "{line}: {}", ended.err);
        assert!(ended.err.contains("--threads"), "{line}: {}", ended.err);
    }
    let size = std::fs::metadata(assert_cmd::cargo::cargo_bin("dynabs-check")).unwrap().len() >> 10;
    for limit in ["-v 20000", "-v 30000", "-v 60000", "-u 0", "-n 4", "-n 8", "-s 64", "-t 1"] {
        // The kernel kills what it cannot load.
        let memory = limit.strip_prefix("-v ").and_then(|kib| kib.parse::<u64>().ok());
        let is_unloadable = memory.is_some_and(|kib| kib < size);
        for line in [
            "$check solve run --explicit -q",
            "$compile $room -q -o other --force",
            "$check report run -q -o page.html",
        ] {
            let ended = shell(scratch.path(), &format!("ulimit {limit}; timeout 60 {line}"));
            // The loader of the system has an exit code of its own.
            let loader =
                ended.err.contains("error while loading shared libraries") || ended.err.contains("fork");
            assert!(
                loader
                    || matches!(ended.code, Some(0 | 2 | 4))
                    || is_unloadable && ended.code.is_none() && ended.err.is_empty(),
                "{limit}: {line}: {:?} {}",
                ended.code,
                ended.err
            );
        }
    }
}
