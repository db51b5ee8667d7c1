//! Memory that is short: refused with an estimate and the field to change, or ended with a message; never an abort.
#![cfg(unix)]

use crate::common::{abstraction, root};
use assert_cmd::cargo::cargo_bin;
use serde_json::{Value, json};
use std::path::Path;
use std::process::{Command, Output};
use tempfile::TempDir;

/// Runs a tool with so many KiB of address space, in `directory`.
fn limited(kib: u32, directory: &Path, tool: &str, arguments: &[&str]) -> Output {
    let mut command = Command::new("sh");
    command.arg("-c").arg(format!("ulimit -v {kib}; exec \"$0\" \"$@\""));
    command.arg(cargo_bin(tool)).args(arguments).current_dir(directory).output().unwrap()
}

fn model(name: &str) -> String {
    root().join("models").join(format!("{name}.json")).display().to_string()
}

/// A zero too many in the numbers of cells.
#[test]
fn a_typo_in_the_grid_is_refused_by_field() {
    let scratch = TempDir::new().unwrap();
    let spacecraft = model("spacecraft_disaligned");
    for (cells, kib, what) in [
        ("[140,60,140,60]", 6_000_000, "the cells of the partition"),
        ("[40,30,40,30]", 3_000_000, "the enabled actions"),
    ] {
        let set = format!("/partition/cells={cells}");
        let output =
            limited(kib, scratch.path(), "dynabs-compile", &[&spacecraft, "--dry-run", "--set", &set]);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{cells}: {error}");
        for part in ["/partition/cells: ", what, "MiB", "the limit of this process"] {
            assert!(error.contains(part), "{cells}: {part}: {error}");
        }
    }
}

#[test]
fn many_samples_are_refused_by_field() {
    let scratch = TempDir::new().unwrap();
    let room = model("room_temperature");
    let sets = ["--dry-run", "--set", "/noise/count=10000000"];
    let output = limited(200_000, scratch.path(), "dynabs-compile", &[&[&*room], &sets[..]].concat());
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(error.contains("/noise/count: found samples that would take about"), "{error}");
}

/// What is expected to be needed is shown before anything is written.
#[test]
fn a_dry_run_shows_what_it_takes() {
    let scratch = TempDir::new().unwrap();
    let double_integrator = model("double_integrator");
    let output = limited(2_000_000, scratch.path(), "dynabs-compile", &[&double_integrator, "--dry-run"]);
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let line = text.lines().find(|line| line.starts_with("  memory ")).unwrap_or_else(|| panic!("{text}"));
    assert!(
        line.contains("the enabled actions") && line.contains("available (the limit of this process"),
        "{line}"
    );
    let arguments = [&double_integrator, "--dry-run", "--json"];
    let output = limited(2_000_000, scratch.path(), "dynabs-compile", &arguments);
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    let needs = json["memory"]["needs"].as_array().unwrap();
    let sum: u64 = needs.iter().map(|need| need["bytes"].as_u64().unwrap()).sum();
    assert_eq!(json["memory"]["bytes"].as_u64(), Some(sum));
    assert!(json["memory"]["available"].as_u64().unwrap() < 2_000_000 << 10);
}

/// Rows of targets that sit differently in their cells fit into their estimate, which is not so large that what fits is refused:
/// grids are coarse in some dimensions. Rows that are shifts of one another take some bytes each, however long they are. (Rows
/// of actions that need room in between are estimated by themselves.)
#[test]
fn rows_take_about_what_was_estimated() {
    for (name, targets) in [
        ("predecessors/building_1_zone", r#"{"lower":[19.1,36],"upper":[22.9,40],"cells":[17,19]}"#),
        ("double_integrator", r#"{"lower":[-20,-20],"upper":[20,20],"cells":[37,37]}"#),
    ] {
        let estimated = |sets: &[String]| {
            let abstraction = abstraction(name, sets);
            let needs = abstraction.footprint.needs();
            let bytes = needs.iter().find(|need| need.what == "the rows of the model").unwrap().bytes;
            (bytes, abstraction.model)
        };
        let (bytes, model) = estimated(&[format!("/targets={targets}")]);
        let entries = model.rows().num_entries() as u64;
        assert_eq!(model.rows().stored_entries() as u64, entries);
        let estimate = bytes / 60;
        assert!(
            entries <= estimate && estimate <= 8 * entries,
            "{name}: {entries} entries, {estimate} estimated"
        );
        let (bytes, model) = estimated(&[]);
        assert_eq!((model.rows().stored_entries(), bytes), (0, 24 * model.rows().len() as u64));
    }
}

/// A problem whose actions are inputs.
fn inputs(directory: &Path, change: impl FnOnce(&mut Value)) -> String {
    let side = |from: f64, to: f64| json!([{"lower": [from, -10], "upper": [to, 10]}]);
    let mut value = json!({
        "name": "inputs",
        "dynamics": {"A": [[0.9, 0], [0, 0.9]], "B": [[1, 0], [0, 1]]},
        "noise": {"components": [{"gaussian": {"deviation": 1}}, {"gaussian": {"deviation": 1}}]},
        "input": {"lower": [-1, -1], "upper": [1, 1], "points": [2, 2]},
        "partition": {"lower": [-10, -10], "upper": [10, 10], "cells": [20, 20]},
        "regions": {"a": side(-9.0, -7.0), "b": side(-5.0, -3.0), "c": side(3.0, 5.0), "d": side(7.0, 9.0)},
        "task": {"type": "formula", "formula": "F (a & F (b & F (c & F d)))", "horizon": 3}
    });
    change(&mut value);
    let path = directory.join("inputs.json");
    std::fs::write(&path, value.to_string()).unwrap();
    path.display().to_string()
}

/// Every part of a problem whose actions are inputs has a field to change.
#[test]
fn parts_of_inputs_are_refused_by_field() {
    let scratch = TempDir::new().unwrap();
    let refused = |kib: u32, arguments: &[&str], words: &[&str], change: fn(&mut Value)| {
        let path = inputs(scratch.path(), change);
        let output = limited(kib, scratch.path(), "dynabs-compile", &[&[&*path], arguments].concat());
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{error}");
        assert!(words.iter().all(|word| error.contains(word)), "{words:?}: {error}");
        assert!(!scratch.path().join("out").exists());
    };
    refused(
        400_000,
        &["--dry-run"],
        &["/task: found what the task remembers in all cells", "MiB"],
        |value| {
            value["partition"]["cells"] = json!([1200, 1200]);
        },
    );
    refused(700_000, &["--dry-run"], &["/partition/cells: found the boxes of the noise", "MiB"], |value| {
        value["noise"] = json!({"gaussian": {"covariance": [[4, 0], [0, 4]]}, "count": 3000, "seed": 1});
        value["actions"] = "inputs".into();
        value["partition"]["cells"] = json!([40, 40]);
        value["partition"]["resolution"] = json!([64, 64]);
    });
    // The second component moves by up to a hundred cells with the first: boxes of many sizes, each with an array of its own.
    refused(600_000, &["--dry-run"], &["the arrays that noise moves", "/partition/cells", "MiB"], |value| {
        value["noise"] = json!({"gaussian": {"covariance": [[4, 400], [400, 40004]]}});
        value["partition"]["cells"] = json!([200, 200]);
        value["partition"]["resolution"] = json!([16, 16]);
    });
    refused(330_000, &["-o", "out"], &["the model of the lattice", "/partition/cells", "MiB"], |value| {
        value["partition"]["cells"] = json!([200, 200]);
    });
}

#[test]
fn dry_runs_show_what_inputs_and_rooms_take() {
    let scratch = TempDir::new().unwrap();
    let shown = |model: &str, words: &[&str]| {
        let output = limited(8_000_000, scratch.path(), "dynabs-compile", &[model, "--dry-run"]);
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let line =
            text.lines().find(|line| line.starts_with("  memory ")).unwrap_or_else(|| panic!("{text}"));
        assert!(words.iter().all(|word| line.contains(word)), "{words:?}: {line}");
    };
    let path = inputs(scratch.path(), |_| {});
    shown(&path, &["the cells", "what the task remembers", "the images of all cells", "available"]);
    shown(&model("every_step/spacecraft_disaligned"), &["rows for actions that need room in between"]);
}

/// Without any limit but the machine's, a typo is refused before anything is done for every cell.
#[test]
fn a_typo_is_refused_at_once() {
    let scratch = TempDir::new().unwrap();
    let arguments =
        [&*model("spacecraft_disaligned"), "--dry-run", "--set", "/partition/cells=[140,60,140,60]"];
    let start = std::time::Instant::now();
    // More than the cells take, less than the enabled actions.
    let output = limited(20_000_000, scratch.path(), "dynabs-compile", &arguments);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(error.contains("/partition/cells: found the enabled actions"), "{error}");
    println!("refused after {:.1?}", start.elapsed());
}

/// Whatever the limit, every command does its work or says what stopped it, and leaves nothing half done.
#[test]
fn no_command_aborts() {
    let scratch = TempDir::new().unwrap();
    let (tool, check) = ("dynabs-compile", "dynabs-check");
    let double_integrator = model("double_integrator");
    let input = ["--set", "/input/lower=[-6]", "--set", "/input/upper=[6]"];
    let compile = |further: &[&'static str]| {
        let mut arguments = vec![double_integrator.clone(), "-q".into()];
        arguments.extend(input.iter().chain(further).map(|&text| text.to_owned()));
        arguments
    };
    let own = |arguments: &[&str]| arguments.iter().map(|&text| text.to_owned()).collect::<Vec<_>>();
    let run = |kib, tool, arguments: &[String]| {
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        limited(kib, scratch.path(), tool, &arguments)
    };
    let prepared = [
        (tool, compile(&["-o", "base", "--format", "prism,drn,umb"])),
        (check, own(&["solve", "base", "-q", "--certificate", "base.cert"])),
    ];
    for (tool, arguments) in prepared {
        let output = run(8_000_000, tool, &arguments);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    let reach = r#"Pmaxmin=? [ F "reached" ]"#;
    let commands = [
        (tool, compile(&["-o", "out", "--format", "prism,drn,umb", "--solve"]), "out"),
        (tool, compile(&["-o", "out", "--encoding", "rows", "--format", "prism,umb"]), "out"),
        (tool, compile(&["-o", "out", "--prune"]), "out"),
        (check, own(&["solve", "base", "--values", "out", "-p", reach]), "out"),
        (check, own(&["solve", "base/model.tra", "-p", reach]), "out"),
        (check, own(&["solve", "base/model.drn", "-p", reach]), "out"),
        (check, own(&["solve", "base/model.umb", "-p", reach]), "out"),
        (check, own(&["solve", "base", "--certificate", "out"]), "out"),
        (check, own(&["verify", "base.cert", "base"]), "out"),
        (check, own(&["convert", "base/model.tra", "out.umb"]), "out.umb"),
        (check, own(&["report", "base", "-o", "out", "--runs", "100"]), "out"),
        (check, own(&["simulate", "base", "--runs", "100"]), "out"),
        (check, own(&["controller", "base", "-o", "out.c"]), "out.c"),
        (check, own(&["convert", "base/model.umb", "out.drn"]), "out.drn"),
        (check, own(&["simulate", "base", "--runs", "20", "--trajectories", "out"]), "out"),
        (check, own(&["diff", "base", "--write-reference", "out"]), "out"),
        (check, own(&["solve", "base", "-p", "(Pmaxmin=? [ F<=2 \"reached\" ])>=1"]), "out"),
        (check, own(&["diff", "base", "base"]), "out"),
    ];
    let mut ended = 0;
    // With less than this, the system cannot even load the programs.
    let starts =
        |kib: &u32| [tool, check].iter().all(|tool| run(*kib, tool, &own(&["--version"])).status.success());
    let least = (10_000..200_000).step_by(2000).find(starts).unwrap();
    // Twenty limits from hardly anything to enough: every command under five of them, and every fourth under each other.
    for step in 0..20 {
        let kib = least + (600.0 * 1.3f64.powi(step)) as u32;
        for (at, (tool, arguments, written)) in (0..).zip(&commands) {
            if step % 5 != 2 && (at + step) % 4 != 0 {
                continue;
            }
            let output = run(kib, tool, arguments);
            let error = String::from_utf8_lossy(&output.stderr).into_owned();
            let code = output.status.code();
            let path = scratch.path().join(written);
            match code {
                Some(0 | 1) => {}
                Some(2 | 4) => {
                    ended += 1;
                    assert!(!error.is_empty() && !path.exists(), "{kib} KiB: {arguments:?}: {error}");
                }
                _ => panic!("{kib} KiB: {arguments:?}: {code:?} {error}"),
            }
            for path in [path, scratch.path().join("out.props")] {
                let _ = std::fs::remove_dir_all(&path);
                let _ = std::fs::remove_file(&path);
            }
        }
    }
    assert!(ended > 10, "{ended}");
}
