//! The cases of `tests/cases/*.json`.
//!
//! A case lists for every state its choices, a choice being `successor bounds + successor bounds …` with
//! the bounds as PRISM writes them. `values` gives for a path formula and each operator the exact values of
//! all states, `verdicts` whether a property holds in all initial states. `fragile` cases change their
//! values when lower bounds of 0 are raised to something positive.
#![allow(dead_code)]

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use imdp::formats::prism;
use imdp::model::{IntervalMdp, ModelKind};
use serde::Deserialize;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    pub name: String,
    #[serde(rename = "why")]
    _why: String,
    #[serde(default)]
    pub kind: Kind,
    #[serde(default)]
    pub fragile: bool,
    pub states: Vec<Vec<String>>,
    pub labels: BTreeMap<String, Vec<usize>>,
    #[serde(default)]
    pub variables: BTreeMap<String, Vec<serde_json::Value>>,
    pub values: Vec<Values>,
    #[serde(default)]
    pub verdicts: Vec<Expected>,
}

#[derive(Deserialize, Default, PartialEq)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    #[default]
    Imdp,
    Idtmc,
}

/// A path formula and, by operator, its values in all states.
#[derive(Deserialize)]
pub struct Values {
    pub path: String,
    #[serde(flatten)]
    pub of: BTreeMap<String, String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expected {
    pub property: String,
    pub satisfied: bool,
}

impl Case {
    /// The texts of the transition, state and label files.
    pub fn files(&self) -> [(&'static str, String); 3] {
        let (mut lines, mut choices, mut transitions) = (String::new(), 0, 0);
        for (state, of_state) in self.states.iter().enumerate() {
            for (choice, row) in of_state.iter().enumerate() {
                choices += 1;
                for entry in row.split(" + ") {
                    transitions += 1;
                    let source = match self.kind {
                        Kind::Imdp => format!("{state} {choice}"),
                        Kind::Idtmc => state.to_string(),
                    };
                    writeln!(lines, "{source} {entry}").unwrap();
                }
            }
        }
        let states = self.states.len();
        let tra = match self.kind {
            Kind::Imdp => format!("{states} {choices} {transitions}\n{lines}"),
            Kind::Idtmc => format!("{states} {transitions}\n{lines}"),
        };

        let names: Vec<_> = self.variables.keys().map(String::as_str).collect();
        let mut sta = format!("({})\n", if names.is_empty() { "s".to_owned() } else { names.join(",") });
        let mut lab = "0=\"init\"".to_owned();
        let others: Vec<_> = self.labels.iter().filter(|(name, _)| *name != "init").collect();
        (1..).zip(&others).for_each(|(i, (name, _))| write!(lab, " {i}=\"{name}\"").unwrap());
        lab.push('\n');
        for state in 0..states {
            let values: Vec<_> = self.variables.values().map(|values| values[state].to_string()).collect();
            let values = if values.is_empty() { state.to_string() } else { values.join(",") };
            writeln!(sta, "{state}:({values})").unwrap();
            let labels =
                std::iter::once(&self.labels["init"]).chain(others.iter().map(|(_, states)| *states));
            let held: Vec<_> = labels
                .enumerate()
                .filter(|(_, of)| of.contains(&state))
                .map(|(i, _)| i.to_string())
                .collect();
            if !held.is_empty() {
                writeln!(lab, "{state}: {}", held.join(" ")).unwrap();
            }
        }
        [("tra", tra), ("sta", sta), ("lab", lab)]
    }
}

pub fn all_cases() -> Vec<Case> {
    let directory = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    let mut paths: Vec<_> =
        std::fs::read_dir(directory).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let read = |path: &std::path::PathBuf| -> Vec<Case> {
        let text = std::fs::read_to_string(path).unwrap();
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
    };
    paths.iter().flat_map(read).collect()
}

/// Runs `check` on every case, imported from explicit files in a directory of its own.
pub fn for_every_case(check: impl Fn(&Case, &IntervalMdp, &Path)) {
    let cases = all_cases();
    assert!(cases.len() >= 25, "{} cases", cases.len());
    for case in cases {
        let directory = tempfile::tempdir().unwrap();
        let tra = directory.path().join("case.tra");
        for (extension, text) in case.files() {
            std::fs::write(tra.with_extension(extension), text).unwrap();
        }
        let read = prism::import(&tra, None, None).unwrap_or_else(|error| panic!("{}: {error}", case.name));
        let kind = if case.kind == Kind::Imdp { ModelKind::Imdp } else { ModelKind::Idtmc };
        assert_eq!(read.model.kind(), kind, "{}", case.name);
        check(&case, &read.model, directory.path());
    }
}
