//! Counts are not believed before the bytes are there, and names are looked up in constant time.

use super::{Ended, check, data, in_time, program};
use flate2::write::GzEncoder;
use std::fs;
use std::io::{Read, Write};
use std::path::Path;
use std::process::Command;
use tempfile::TempDir;

const GOAL: [&str; 2] = ["-p", "Pmaxmin=? [ F \"goal\" ]"];

/// Solves within a few seconds and 1.5 GB.
fn solve(path: &Path) -> Ended {
    let mut command = Command::new("bash");
    command.args(["-c", "ulimit -v 1500000; exec \"$0\" \"$@\""]);
    command.arg(assert_cmd::cargo::cargo_bin("dynabs-check")).arg("solve").arg(path).args(GOAL);
    in_time(command, 30)
}

/// F08, F09: 27 bytes that say 10⁸ states, 852 bytes that say 2·10⁸ names.
#[test]
fn headers_that_lie_are_refused() {
    for (name, found) in [("08.tra", "100000000"), ("08b.tra", "2147483648")] {
        let ended = solve(&data(name));
        assert_eq!(ended.code, Some(2), "{name}: {}", ended.err);
        assert!(ended.err.contains("08") && ended.err.contains(found), "{name}: {}", ended.err);
    }
    for name in ["09-names-1e7.umb", "09-names.umb"] {
        let ended = solve(&data(name));
        // Names that no choice has cost nothing.
        assert_eq!(ended.code, Some(0), "{name}: {}", ended.err);
    }
    let scratch = TempDir::new().unwrap();
    let drn = scratch.path().join("m.drn");
    fs::write(&drn, "@type: MDP\n@value_type: double-interval\n@nr_states\n100000000\n@nr_choices\n1\n@model\nstate 0 init goal\n\taction 0\n\t\t0 : [1, 1]\n")
        .unwrap();
    let ended = solve(&drn);
    assert_eq!(ended.code, Some(2), "{}", ended.err);
    assert!(ended.err.contains("m.drn:4:1"), "{}", ended.err);
}

/// F09: names of members, of any length, in the ways that tar has for long ones.
#[test]
fn long_names_of_members_are_refused() {
    let scratch = TempDir::new().unwrap();
    let path = scratch.path().join("m.umb");
    for kind in [
        tar::EntryType::GNULongName,
        tar::EntryType::GNULongLink,
        tar::EntryType::XHeader,
        tar::EntryType::XGlobalHeader,
    ] {
        let mut header = tar::Header::new_ustar();
        header.set_path("name").unwrap();
        header.set_size(256 << 20);
        header.set_entry_type(kind);
        header.set_cksum();
        let mut out = GzEncoder::new(fs::File::create(&path).unwrap(), flate2::Compression::fast());
        out.write_all(header.as_bytes()).unwrap();
        std::io::copy(&mut std::io::repeat(b'x').take(256 << 20), &mut out).unwrap();
        out.finish().unwrap();
        let mut command = Command::new("bash");
        command.args(["-c", "ulimit -v 300000; exec \"$0\" \"$@\""]);
        command.arg(assert_cmd::cargo::cargo_bin("dynabs-check")).arg("solve").arg(&path).args(GOAL);
        let ended = in_time(command, 30);
        assert_eq!(ended.code, Some(2), "{kind:?}: {}", ended.err);
        assert!(ended.err.contains("name"), "{kind:?}: {}", ended.err);
    }
}

/// F10: as many names as there are bytes for.
#[test]
fn many_names_take_no_longer_than_they_are_long() {
    const COUNT: usize = 40_000;
    let scratch = TempDir::new().unwrap();
    let at = |name: &str| scratch.path().join(name);
    let names = |head: &str| (0..COUNT).map(|i| format!(" {head}{i}")).collect::<String>();
    let drn = |comments: &str, values: &str| {
        format!(
            "{comments}@type: MDP\n@value_type: double-interval\n@parameters\n\n@reward_models\n\n@nr_states\n2\n@nr_choices\n2\n@model\nstate 0 init\n{values}\taction 0\n\t\t1 : [1, 1]\nstate 1 goal\n{values}\taction 0\n\t\t1 : [1, 1]\n"
        )
    };
    fs::write(at("labels.drn"), drn(&format!("//! labels{}\n", names("l")), "")).unwrap();
    let values = format!("//! values{}\n", " 1".repeat(COUNT));
    fs::write(at("variables.drn"), drn(&format!("//! variables{}\n", names("v")), &values)).unwrap();
    let tra = "2 2 2\n0 0 1 [1,1]\n1 0 1 [1,1]\n";
    let labels: String = (0..COUNT).map(|i| format!(" {}=\"l{i}\"", i + 2)).collect();
    fs::write(at("labels.tra"), tra).unwrap();
    fs::write(at("labels.lab"), format!("0=\"init\" 1=\"goal\"{labels}\n0: 0\n1: 1\n")).unwrap();
    fs::write(at("variables.tra"), tra).unwrap();
    fs::write(at("variables.lab"), "0=\"init\" 1=\"goal\"\n0: 0\n1: 1\n").unwrap();
    let variables = names("v").trim().replace(' ', ",");
    let zeros = vec!["0"; COUNT].join(",");
    fs::write(at("variables.sta"), format!("({variables})\n0:({zeros})\n1:({zeros})\n")).unwrap();
    for name in ["labels.drn", "variables.drn", "labels.tra", "variables.tra"] {
        let ended = solve(&at(name));
        assert_eq!(ended.code, Some(0), "{name}: {}", ended.err);
        // The same names in the other formats, written and read again.
        for output in ["m.dynabs", "m.umb"] {
            let mut command = program("dynabs-check");
            command.arg("convert").arg(at(name)).arg(at(output)).args(["-q", "--force"]);
            assert_eq!(in_time(command, 30).code, Some(0), "{name} {output}");
            assert_eq!(solve(&at(output)).code, Some(0), "{name} {output}");
        }
    }
    // A name twice is still found.
    let twice = drn(&format!("//! variables{} v7\n", names("v")), "");
    fs::write(at("twice.drn"), twice).unwrap();
    let ended = check(&["solve", at("twice.drn").to_str().unwrap(), GOAL[0], GOAL[1]]);
    assert_eq!(ended.code, Some(2), "{}", ended.err);
}
