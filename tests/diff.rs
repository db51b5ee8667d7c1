//! `dynabs-check diff`: every kind of difference is found, located and ranked.
use assert_cmd::Command;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// Choices b and d of state 0 are the same, a is worse.
const TRA: &str = "\
4 6 12
0 0 1 [0.2,0.5] a
0 0 3 [0.5,0.8] a
0 1 1 [0.4,0.5] b
0 1 2 [0.1,0.2] b
0 1 3 [0.3,0.5] b
0 2 1 [0.4,0.5] d
0 2 2 [0.1,0.2] d
0 2 3 [0.3,0.5] d
1 0 2 [0.6,0.9] c
1 0 3 [0.1,0.4] c
2 0 2 [1,1]
3 0 3 [1,1]
";
const LAB: &str = "0=\"init\" 1=\"deadlock\" 2=\"goal\" 3=\"failed\"\n0: 0\n2: 2\n3: 3\n";
const PROPS: &str = "Pmaxmin=? [ F<=4 \"goal\" ]\n";
const RESULT: &str = r#"{"results":[{"property":"Pmaxmin=? [ F<=4 \"goal\" ]","lower":0.34,"upper":0.34,
    "satisfied":null,"status":"horizon reached","steps":2,"seconds":0.1}]}"#;

struct Scratch(TempDir);

impl Scratch {
    fn new() -> Self {
        Self(TempDir::new().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// A run directory with the model after a replacement in its transitions, and further files.
    fn run(&self, name: &str, (old, new): (&str, &str), files: &[(&str, &str)]) -> PathBuf {
        let directory = self.path(name);
        fs::create_dir(&directory).unwrap();
        assert!(TRA.contains(old));
        let given = [("model.tra", TRA.replacen(old, new, 1)), ("model.lab", LAB.into())];
        for (file, text) in given.iter().map(|(f, t)| (*f, t.as_str())).chain([("model.props", PROPS)]) {
            fs::write(directory.join(file), text).unwrap();
        }
        for (file, text) in files {
            fs::write(directory.join(file), text).unwrap();
        }
        directory
    }

    /// A directory with these files only.
    fn files(&self, name: &str, files: &[(&str, &str)]) -> PathBuf {
        let directory = self.path(name);
        fs::create_dir(&directory).unwrap();
        files.iter().for_each(|(file, text)| fs::write(directory.join(file), text).unwrap());
        directory
    }
}

const UNCHANGED: (&str, &str) = ("", "");

fn diff(left: &Path, right: &Path, further: &[&str]) -> (i32, String, String) {
    let mut command = Command::cargo_bin("dynabs-check").unwrap();
    let output = command.arg("diff").arg(left).arg(right).args(further).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// The comparison as JSON; panics unless the exit code is this.
fn compare(left: &Path, right: &Path, code: i32) -> Value {
    let (found, stdout, stderr) = diff(left, right, &["--json"]);
    assert_eq!(found, code, "{stdout}{stderr}");
    let comparison: Value = serde_json::from_str(&stdout).unwrap();
    assert_eq!(comparison["same"], code == 0);
    comparison
}

fn section<'a>(comparison: &'a Value, part: &str) -> &'a Value {
    let sections = comparison["sections"].as_array().unwrap();
    sections.iter().find(|section| section["part"] == part).unwrap_or_else(|| panic!("{comparison:#}"))
}

fn worst<'a>(comparison: &'a Value, part: &str) -> &'a Value {
    &section(comparison, part)["worst"][0]
}

fn assert_near(value: &Value, expected: f64) {
    assert!((value.as_f64().unwrap() - expected).abs() < 1e-9, "{value} {expected}");
}

fn write_reference(file: &Path, of: &Path) {
    let mut command = Command::cargo_bin("dynabs-check").unwrap();
    command.arg("diff").arg(of).arg("--write-reference").arg(file).assert().success();
}

#[test]
fn equal_runs_do_not_differ() {
    let scratch = Scratch::new();
    let (a, b) = (scratch.run("a", UNCHANGED, &[]), scratch.run("b", UNCHANGED, &[]));
    compare(&a, &b, 0);
    compare(&a.join("model"), &b.join("model.tra"), 0);
    let reference = scratch.path("reference.json");
    write_reference(&reference, &a);
    let comparison = compare(&b, &reference, 0);
    assert_eq!(section(&comparison, "values")["compared"], 4);
    assert_eq!(section(&comparison, "results")["compared"], 4);
    compare(&reference, &reference, 0);
    let (code, stdout, _) = diff(&a, &b, &["--quiet"]);
    assert_eq!((code, stdout.as_str()), (0, ""));
}

#[test]
fn intervals_are_located_and_ranked() {
    let scratch = Scratch::new();
    let a = scratch.run("a", UNCHANGED, &[]);
    let b = scratch.run("b", ("[0.6,0.9]", "[0.6,0.900001]"), &[]);
    let comparison = compare(&a, &b, 1);
    let difference = worst(&comparison, "intervals");
    assert_eq!(difference["place"], "state 1, choice 0 c, successor 2");
    assert_eq!(difference["left"], "[0.6, 0.9]");
    assert_eq!(difference["right"], "[0.6, 0.900001]");
    assert_near(&difference["by"], 1e-6);
    assert_eq!(section(&comparison, "intervals")["differences"], 1);
    assert_eq!(section(&comparison, "intervals")["compared"], 10);
    // Computed on both sides: the change does not matter to the value.
    assert_eq!(section(&comparison, "values")["differences"], 0);
    assert_eq!(diff(&a, &b, &["--absolute", "1e-5"]).0, 0);
    assert_eq!(diff(&a, &b, &["--relative", "1e-5"]).0, 0);

    let c = scratch.run("c", ("[0.6,0.9] c\n1 0 3 [0.1,0.4]", "[0.59,0.9] c\n1 0 3 [0.1,0.43]"), &[]);
    let comparison = compare(&a, &c, 1);
    let places: Vec<_> = (0..2).map(|i| &section(&comparison, "intervals")["worst"][i]["place"]).collect();
    assert_eq!(places, ["state 1, choice 0 c, successor 3", "state 1, choice 0 c, successor 2"]);
    let (_, stdout, _) = diff(&a, &c, &["--most", "1"]);
    assert_eq!(stdout.matches("choice 0 c").count(), 1, "{stdout}");
    assert!(stdout.contains("by 3.0e-2") && stdout.contains("2 of 10 differ"), "{stdout}");
    // 0.6 of state 1 became 0.59, which is also in the value of state 0.
    assert_near(&worst(&comparison, "values")["by"], 0.01);
    assert_eq!(section(&comparison, "values")["differences"], 2);
}

#[test]
fn references_locate_what_changed() {
    let scratch = Scratch::new();
    let reference = scratch.path("reference.json");
    write_reference(&reference, &scratch.run("a", UNCHANGED, &[]));
    // An interval that the model did not have, and one that it had elsewhere.
    let b = scratch.run("b", ("[0.6,0.9]", "[0.600001,0.9]"), &[]);
    let comparison = compare(&reference, &b, 1);
    let difference = worst(&comparison, "intervals");
    assert_eq!(difference["place"], "state 1, choice 0, successor 2");
    assert_eq!(difference["left"], "nearest: [0.6, 0.9] in 1 entries");
    assert_near(&difference["by"], 1e-6);
    assert_eq!(section(&comparison, "rows")["differences"], 0, "{comparison:#}");
    let c = scratch.run("c", ("0 2 2 [0.1,0.2] d", "0 2 2 [0.4,0.5] d"), &[]);
    let c = {
        let text = fs::read_to_string(c.join("model.tra")).unwrap();
        fs::write(c.join("model.tra"), text.replace("0 2 1 [0.4,0.5]", "0 2 1 [0.1,0.2]")).unwrap();
        c
    };
    let comparison = compare(&reference, &c, 1);
    assert_eq!(section(&comparison, "intervals")["differences"], 0);
    assert_eq!(worst(&comparison, "rows")["place"], "row 2, first in state 0, choice 2");
    assert_eq!(worst(&comparison, "choices")["place"], "state 0");
    let changed = scratch.path("changed.json");
    write_reference(&changed, &c);
    assert_eq!(worst(&compare(&reference, &changed, 1), "choices")["place"], "state 0");
}

#[test]
fn sizes_labels_and_choices_are_compared() {
    let scratch = Scratch::new();
    let a = scratch.run("a", UNCHANGED, &[]);
    let fewer = TRA.replace("4 6 12", "4 5 10").replace("0 0 1 [0.2,0.5] a\n0 0 3 [0.5,0.8] a\n", "");
    let fewer = fewer.replace("\n0 1", "\n0 0").replace("\n0 2", "\n0 1");
    let b = scratch.run("b", UNCHANGED, &[("model.tra", &fewer)]);
    let comparison = compare(&a, &b, 1);
    assert_eq!(section(&comparison, "sizes")["worst"].as_array().unwrap().len(), 4, "{comparison:#}");
    assert_eq!(worst(&comparison, "choices")["place"], "state 0");
    assert_eq!(worst(&comparison, "choices")["left"], "3 choices, 1 of its own: a");
    assert_eq!(section(&comparison, "intervals")["differences"], 0, "b and d are paired by name");

    let lab = LAB.replace("3: 3", "1: 3\n3: 3");
    let c = scratch.run("c", UNCHANGED, &[("model.lab", &lab)]);
    let comparison = compare(&a, &c, 1);
    assert_eq!(worst(&comparison, "labels")["place"], "label \"failed\" of 1 state(s), the first is 1");
    let reference = scratch.path("reference.json");
    write_reference(&reference, &a);
    let comparison = compare(&reference, &c, 1);
    assert_eq!(worst(&comparison, "labels")["place"], "label \"failed\", first in state 1");
    assert_eq!(worst(&comparison, "labels")["right"], "2 states");
}

#[test]
fn results_and_values_are_compared() {
    let scratch = Scratch::new();
    let (a, b) = (scratch.path("a.json"), scratch.path("b.json"));
    fs::write(&a, RESULT).unwrap();
    compare(&a, &a, 0);
    fs::write(&b, RESULT.replacen("0.34", "0.33", 1).replace("null", "false")).unwrap();
    let comparison = compare(&a, &b, 1);
    assert_eq!(section(&comparison, "results")["differences"], 2);
    let run = scratch.run("run", UNCHANGED, &[]);
    let comparison = compare(&run, &b, 1);
    let bound = &section(&comparison, "results")["worst"][1];
    assert_eq!(bound["place"], "lower bound of Pmaxmin=? [ F<=4 \"goal\" ]");
    assert_near(&bound["by"], 0.01);

    let values = |name, text| scratch.files(name, &[("values.txt", text)]);
    let right = values("right", "0.34\n0.6\n1.0\n0\n");
    compare(&run, &right, 0);
    let wrong = values("wrong", "0.34\n0.600001\n0.99\n0\n");
    let comparison = compare(&run, &wrong, 1);
    let worst: Vec<_> = (0..2).map(|i| &section(&comparison, "values")["worst"][i]["place"]).collect();
    assert_eq!(worst, ["state 2", "state 1"]);
    compare(&right, &values("short", "0.34\n0.6\n"), 1);
    let verdicts = (values("left", "true\nfalse\n"), values("other", "true\nundecided\n"));
    assert_eq!(section(&compare(&verdicts.0, &verdicts.1, 1), "values")["differences"], 1);
}

#[test]
fn policies_are_compared_by_what_they_achieve() {
    let scratch = Scratch::new();
    let policy = |name, text| scratch.files(name, &[("policy.txt", text)]);
    let best = scratch.run("best", UNCHANGED, &[("policy.txt", "0,0=b\n0,1=b\n0,3=b\n1,0=c\n")]);
    let comparison = compare(&best, &policy("tie", "0,0=d\n0,1=b\n0,3=d\n"), 0);
    assert_eq!(section(&comparison, "policies")["compared"], 3);
    assert!(comparison["notes"].to_string().contains("decides 1 case"), "{comparison:#}");
    let comparison = compare(&best, &policy("worse", "0,0=d\n0,1=a\n0,3=a\n"), 1);
    let list = &section(&comparison, "policies")["worst"];
    // With four steps b is worth 0.4·0.6 + 0.1 and a is worth 0.2·0.6; with one step b 0.1 and a nothing.
    assert_eq!(list[0]["place"], "state 0 after 1 steps");
    assert_near(&list[0]["by"], 0.22);
    assert_eq!(list[1]["place"], "state 0 after 3 steps");
    assert_near(&list[1]["by"], 0.1);
    // Without a model nobody can tell.
    let comparison = compare(&policy("x", "0=a\n"), &policy("y", "0=b\n"), 1);
    assert!(comparison["notes"].to_string().contains("worth"), "{comparison:#}");

    let unbounded = [("policy.txt", "0=b\n"), ("model.props", "Pmaxmin=? [ F \"goal\" ]\n")];
    let stationary = scratch.run("stationary", UNCHANGED, &unbounded);
    compare(&stationary, &policy("stationary-tie", "0=d\n"), 0);
    let comparison = compare(&stationary, &policy("stationary-worse", "0=a\n"), 1);
    assert_near(&worst(&comparison, "policies")["by"], 0.22);
}

/// Formats without labels share the file of properties with those that have them.
#[test]
fn properties_that_one_side_does_not_know_are_left_out() {
    let scratch = Scratch::new();
    let run = scratch.run("run", UNCHANGED, &[]);
    let [whole, bare] = ["model.tra", "model.txt"].map(|file| run.join(file));
    Command::cargo_bin("dynabs-check").unwrap().arg("convert").args([&whole, &bare]).assert().success();
    let comparison = compare(&whole, &bare, 1);
    assert_eq!(section(&comparison, "intervals")["differences"], 0);
    let notes = comparison["notes"].to_string();
    assert!(notes.contains("no label") && notes.contains("not compared"), "{notes}");
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let scratch = Scratch::new();
    let run = scratch.run("run", UNCHANGED, &[("policy.txt", "0=b\n")]);
    let reference = scratch.path("reference.json");
    write_reference(&reference, &run);
    let text = fs::read_to_string(&reference).unwrap();
    let refused = |path: &Path, words: &str| {
        for (left, right) in [(run.as_path(), path), (path, run.as_path())] {
            let (code, stdout, stderr) = diff(left, right, &[]);
            assert_eq!((code, stdout.as_str()), (2, ""), "{stderr}");
            assert!(stderr.contains(words), "{stderr}");
        }
    };
    refused(&scratch.path("none"), "found nothing");
    refused(&scratch.files("empty", &[]), "none of the files of a run");
    refused(&scratch.files("words", &[("values.txt", "0.5\nx\n")]), "values.txt:2");
    refused(&scratch.files("line", &[("policy.txt", "0=b\n1\n")]), "policy.txt:2");
    refused(&scratch.files("action", &[("policy.txt", "0=up\n")]), "\"up\" in state 0");
    refused(&scratch.files("state", &[("policy.txt", "0=a\n9=b\n")]).join("policy.txt"), "another file");
    refused(&scratch.files("manifest", &[("manifest.json", "{}")]), "manifest.json");
    refused(&scratch.files("native", &[("model.dynabs", "DYNABS\r\n")]), "model.dynabs");
    let bad = [
        ("garbage.json", "\u{1}garbage", "line 1"),
        ("truncated.json", &text[..text.len() / 2], "line"),
        ("other.json", "{\"a\": 1}", "results"),
        ("version.json", &text.replace("\"format_version\": 1", "\"format_version\": 9"), "version 9"),
        ("short.json", &text.replace("\"stay\",", ""), "3 choices for 4 states"),
    ];
    for (name, content, words) in bad {
        fs::write(scratch.path(name), content).unwrap();
        refused(&scratch.path(name), words);
    }
    fs::write(scratch.path("binary.json"), [0xff, 0xfe, 0]).unwrap();
    refused(&scratch.path("binary.json"), "not text");
    let foreign = scratch.files("only-values", &[("values.txt", "1\n")]);
    let results = scratch.path("results.json");
    fs::write(&results, RESULT).unwrap();
    let (code, _, stderr) = diff(&foreign, &results, &[]);
    assert!(code == 2 && stderr.contains("nothing in common"), "{stderr}");
    assert_eq!(diff(&run, &run, &["--absolute", "-1"]).0, 2);
}
