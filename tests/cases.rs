//! Models and exact values as data (`tests/cases/*.json`), through everything that reads and solves.
//!
//! A case lists for every state its choices, a choice being `successor bounds + successor bounds …` with
//! the bounds as PRISM writes them. `values` gives for a path formula and each operator the exact values of
//! all states, `verdicts` whether a property holds in all initial states. `fragile` cases change their
//! values when lower bounds of 0 are raised to something positive.
#![allow(missing_docs, clippy::unwrap_used)]

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::Path;

use dynabs::formats::native;
use dynabs::formats::prism::{self, TraWriter};
use dynabs::imdp::{IntervalMdp, ModelKind};
use dynabs::numeric::{Rational, from_dyadic};
use dynabs::property::{Property, Verdict};
use dynabs::solver::{Query, SolverOptions, Status, solve};
use num_traits::Zero;
use serde::Deserialize;

const EPSILON: f64 = 1e-6;
const BOUNDED_EPSILON: f64 = 1e-12;
/// How far raised lower bounds, and the widening of sums that they make necessary, may move a value.
const RAISING: f64 = 1e-12;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Case {
    name: String,
    #[serde(rename = "why")]
    _why: String,
    #[serde(default)]
    kind: Kind,
    #[serde(default)]
    fragile: bool,
    states: Vec<Vec<String>>,
    labels: BTreeMap<String, Vec<usize>>,
    #[serde(default)]
    variables: BTreeMap<String, Vec<serde_json::Value>>,
    values: Vec<Values>,
    #[serde(default)]
    verdicts: Vec<Expected>,
}

#[derive(Deserialize, Default, PartialEq)]
#[serde(rename_all = "lowercase")]
enum Kind {
    #[default]
    Imdp,
    Idtmc,
}

/// A path formula and, by operator, its values in all states.
#[derive(Deserialize)]
struct Values {
    path: String,
    #[serde(flatten)]
    of: BTreeMap<String, String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Expected {
    property: String,
    satisfied: bool,
}

impl Case {
    /// The texts of the transition, state and label files.
    fn files(&self) -> [(&'static str, String); 3] {
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

    /// Solves everything that is asked and compares; exact values may be missed by `slack`.
    fn check(&self, model: &IntervalMdp, how: &str, slack: f64) {
        let slack = from_dyadic(slack).unwrap();
        for values in &self.values {
            let expected = if self.kind == Kind::Imdp { 4 } else { 2 };
            assert_eq!(values.of.len(), expected, "{}: {} misses an operator", self.name, values.path);
            for (operator, exact) in &values.of {
                let text = format!("P{operator}=? [ {} ]", values.path);
                let at = format!("{}, {how}: {text}", self.name);
                let exact: Vec<Rational> = exact.split(' ').map(|value| value.parse().unwrap()).collect();
                let found = bounds(model, &text, &at).0;
                assert_eq!(found.len(), exact.len(), "{at}");
                for (state, (&(lower, upper), exact)) in found.iter().zip(&exact).enumerate() {
                    let (low, high) = (from_dyadic(lower).unwrap(), from_dyadic(upper).unwrap());
                    assert!(
                        low <= exact + &slack && exact - &slack <= high,
                        "{at}: state {state}: {lower} ≤ {exact} ≤ {upper}"
                    );
                }
            }
        }
        for Expected { property, satisfied } in &self.verdicts {
            let at = format!("{}, {how}: {property}", self.name);
            let (bounds, verdict) = bounds(model, property, &at);
            let expected = if *satisfied { Verdict::Holds } else { Verdict::Fails };
            assert_eq!(verdict, Some(expected), "{at}: {bounds:?}");
        }
    }
}

/// Bounds of all states, close enough to each other, and the verdict about the initial states if asked.
fn bounds(model: &IntervalMdp, text: &str, at: &str) -> (Vec<(f64, f64)>, Option<Verdict>) {
    let property: Property = text.parse().unwrap_or_else(|error| panic!("{at}: {error}"));
    let objective = property.resolve(model.kind()).unwrap();
    let query = objective.query(model).unwrap_or_else(|error| panic!("{at}: {error}"));
    let options = SolverOptions { epsilon: EPSILON, policy: true, ..Default::default() };
    let solution = solve(model, &Query::from(&query.kind), query.resolution, &options).unwrap();
    let bounded = objective.path.steps().is_some();
    let status = if bounded { Status::HorizonReached } else { Status::Converged };
    assert_eq!(solution.status, status, "{at}");
    let values = &solution.values;
    let ends = values.lower.iter().zip(&values.upper);
    let bounds: Vec<_> = ends.map(|(&lower, &upper)| query.value_bounds(lower, upper)).collect();
    let epsilon = if bounded { BOUNDED_EPSILON } else { EPSILON };
    for &(lower, upper) in &bounds {
        assert!(0.0 <= lower && lower <= upper && upper <= 1.0, "{at}: [{lower},{upper}]");
        // One rounding more for complements.
        assert!(upper - lower <= epsilon + f64::EPSILON, "{at}: [{lower},{upper}]");
    }
    let verdict = objective.threshold.map(|threshold| {
        let verdicts: Vec<_> =
            model.initial().ones().map(|state| threshold.decide(bounds[state].0, bounds[state].1)).collect();
        let all_hold = verdicts.iter().all(|&verdict| verdict == Verdict::Holds);
        match all_hold {
            true => Verdict::Holds,
            false if verdicts.contains(&Verdict::Fails) => Verdict::Fails,
            false => Verdict::Unknown,
        }
    });
    (bounds, verdict)
}

fn all_cases() -> Vec<Case> {
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
fn for_every_case(check: impl Fn(&Case, &IntervalMdp, &Path)) {
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

#[test]
fn explicit_files_are_solved_with_one_thread_and_with_four() {
    for threads in [1, 4] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            for_every_case(|case, model, _| case.check(model, &format!("{threads} threads"), 0.0));
        });
    }
}

#[test]
fn native_files_are_solved() {
    for_every_case(|case, model, directory| {
        let path = directory.join("case.dynabs");
        native::write_file(model, &path).unwrap();
        let again = native::read(&path).unwrap();
        assert_eq!(again, *model, "{}", case.name);
        case.check(&again, "native", 0.0);
    });
}

#[test]
fn files_written_for_prism_are_solved() {
    for_every_case(|case, model, directory| {
        if case.fragile {
            return;
        }
        let tra = directory.join("again.tra");
        TraWriter::new(model).write(&mut std::fs::File::create(&tra).unwrap(), &()).unwrap();
        prism::write_sta(model, &mut std::fs::File::create(tra.with_extension("sta")).unwrap()).unwrap();
        prism::write_lab(model, &mut std::fs::File::create(tra.with_extension("lab")).unwrap()).unwrap();
        let again = prism::import(&tra, None, None).unwrap().model;
        let raised = model.rows().iter().any(|row| row.lower.contains(&0.0));
        case.check(&again, "written for PRISM", if raised { RAISING } else { 0.0 });
    });
}

#[test]
fn fragile_cases_are_those_with_zero_lower_bounds() {
    for_every_case(|case, model, _| {
        let zero = model.rows().iter().any(|row| row.lower.iter().any(Zero::is_zero));
        assert!(zero || !case.fragile, "{}", case.name);
    });
}
