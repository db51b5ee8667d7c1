//! The one claim: its JSON, its words, and what a sweep costs.

use crate::common::{abstraction, problem, reference_mode, root};
use assert_cmd::Command;
use dynabs::guarantee::{Bound, Guarantee};
use serde_json::Value;
use std::fs;
use tempfile::TempDir;

/// What must not depend on the samples, each by the name that it has in the lists.
const FIXED: [&str; 10] =
    ["grid", "targets", "goal", "unsafe", "inputs U", "U'", "group_steps", "discard", "weights", "sweep"];

#[test]
fn json_says_it_in_words_and_is_read_again() {
    for sets in [vec![], vec![reference_mode()], vec!["/probabilities/sweep=3".to_owned()]] {
        let guarantee = abstraction("double_integrator", &sets).guarantee;
        let json = serde_json::to_value(&guarantee).unwrap();
        assert_eq!(serde_json::from_value::<Guarantee>(json.clone()).unwrap(), guarantee);
        let fixed = json["fixed_beforehand"].to_string();
        assert_eq!(FIXED.iter().all(|name| fixed.contains(name)), guarantee.samples().is_some(), "{fixed}");
        assert_eq!(json["confidence"].as_f64(), guarantee.confidence());
        assert_eq!(json["event"]["group_steps"], 2);
    }
}

#[test]
fn sentences_say_all_of_it() {
    let bound = Bound { initial_state: Some(vec![-20.0, 0.0]), bound: 0.987_654_321 };
    let text = abstraction("double_integrator", &[]).guarantee.sentences(&bound).join(" ");
    assert!(text.is_ascii());
    for part in
        ["x = (-20, 0)", "at least 0.987654.", "confidence 0.99", "1600 noise samples", "by looking at"]
    {
        assert!(text.contains(part), "{part}: {text}");
    }
    assert!(FIXED.iter().all(|name| text.contains(name)), "{text}");
    let text = abstraction("double_integrator", &[reference_mode()]).guarantee.sentences(&bound).join(" ");
    assert!(text.contains("nothing is guaranteed") && !text.contains("confidence"), "{text}");
    let text =
        abstraction("room_temperature", &["/probabilities/sweep=7".into()]).guarantee.sentences(&bound);
    assert!(text[0].contains("for all 7 settings"), "{text:?}");
}

/// Each of `m` settings may spend `β / m`, so that choosing the best of them on the same samples is covered.
#[test]
fn every_setting_of_a_sweep_has_its_part_of_beta() {
    let spent = |sweep: u64| {
        let compiled = abstraction("room_temperature", &[format!("/probabilities/sweep={sweep}")]);
        let samples = compiled.guarantee.samples().unwrap().clone();
        assert_eq!((samples.beta, samples.sweep), (0.01, sweep));
        (samples.budget.iter().map(|family| family.beta).sum::<f64>(), samples.unseen_mass)
    };
    let (one, unseen) = spent(1);
    let (part, more_unseen) = spent(20);
    assert!((one - 0.01).abs() < 1e-15 && (part - 0.0005).abs() < 1e-16, "{one}, {part}");
    assert!(more_unseen > unseen);
    // The same as asking for all of it alone.
    let alone = abstraction("room_temperature", &[r#"/probabilities={"mode":"pac","beta":0.0005}"#.into()]);
    let shared = abstraction("room_temperature", &["/probabilities/sweep=20".into()]);
    assert_eq!(alone.model, shared.model);
}

#[test]
fn a_sweep_needs_a_number_of_settings() {
    let refused = |setting: &str| {
        let error = problem("room_temperature", &[setting.to_owned()]).unwrap_err().to_string();
        assert!(error.contains("/probabilities/sweep"), "{error}");
    };
    refused("/probabilities/sweep=0");
    refused(r#"/probabilities={"mode":"reference","sweep":2}"#);
}

/// What `dynabs-check controller` writes carries the same statement.
#[test]
fn the_same_type_everywhere() {
    let json: Value = serde_json::to_value(abstraction("room_temperature", &[]).guarantee).unwrap();
    assert!(json["covers"].as_str().unwrap().contains("failed"));
    assert!(json["assumes"].as_array().unwrap().len() >= 3);
}

/// Whoever sees the number, in whatever form, is told what it rests on and what had to be fixed before.
#[test]
fn every_output_carries_the_statement() {
    let scratch = TempDir::new().unwrap();
    let path = |name: &str| scratch.path().join(name).display().to_string();
    let run = |program: &str, arguments: &[&str]| {
        let output = Command::cargo_bin(program).unwrap().args(arguments).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    let model = root().join("models/room_temperature.json").display().to_string();
    let sweep = ["--set", "/probabilities/sweep=5"];
    let summary = run("dynabs-compile", &[&[&*model, "-o", &path("run"), "--no-tra"], &sweep[..]].concat());
    run("dynabs-check", &["report", &path("run"), "-o", &path("page.html"), "--runs", "50", "-q"]);
    run("dynabs-check", &["controller", &path("run"), "-o", &path("c.c"), "-q"]);
    run("dynabs-check", &["controller", &path("run"), "-o", &path("c.json"), "-q"]);
    let read = |name: &str| fs::read_to_string(scratch.path().join(name)).unwrap();
    let spent: f64 = {
        let manifest: Value = serde_json::from_str(&read("run/manifest.json")).unwrap();
        let samples = &manifest["guarantee"]["evidence"];
        assert_eq!((samples["beta"].as_f64(), samples["sweep"].as_u64()), (Some(0.01), Some(5)));
        samples["budget"].as_array().unwrap().iter().map(|family| family["beta"].as_f64().unwrap()).sum()
    };
    assert!((spent - 0.002).abs() < 1e-15, "{spent}");
    let page = read("page.html").replace("&#39;", "'").replace("&#x27;", "'");
    let texts = [
        ("summary", summary),
        ("manifest", read("run/manifest.json")),
        ("page", page),
        ("C", read("c.c").replace("\n *", "")),
        ("JSON", read("c.json")),
    ];
    for (name, text) in texts {
        for fixed in FIXED {
            assert!(
                text.contains(fixed) || text.contains(&fixed.replace('\'', "_")),
                "{name}: {fixed}: {text}"
            );
        }
        assert!(text.contains("0.99"), "{name}: {text}");
        assert!(name == "manifest" || text.contains("5 settings"), "{name}: {text}");
    }
}
