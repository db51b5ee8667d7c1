//! Which answers are claims about the system: by hand, and against all paths of a small system.

use crate::common::{abstraction, root};
use assert_cmd::Command;
use dynabs::guarantee::{Coverage, Evidence, Gap, Guarantee, SampleEvidence};
use imdp::model::{
    ActionNames, ChoicesBuilder, IntervalMdp, Labels, ModelKind, Parts, RowId, RowRange, Rows, StateId,
    StateSet, StateVariables, VariableValues,
};
use imdp::property::{
    IntegerExpression, PathFormula, Property, Relation, Resolution, StateFormula, parse_property,
};
use proptest::prelude::*;
use serde_json::Value;
use std::fs;
use std::path::Path;
use tempfile::TempDir;

/// Properties of `room_temperature`, whether the answer is covered, and if not why.
#[test]
fn what_is_covered_and_why_not() {
    use Gap::{AfterReached, FalseInFailed, ReadsReached, TrueInFailed};
    let lower = || Coverage::Lower;
    let not = |gaps: &[Gap]| Coverage::None(gaps.to_vec());
    let cases = [
        (r#"Pmaxmin=? [ !"failed" U<=6 "reached" ]"#, lower()),
        (r#"(Pmaxmin=? [ !"failed" U<=6 "reached" ])>=0.9"#, lower()),
        (r#"Pmaxmin=? [ F "reached" ]"#, lower()),
        (r#"Pminmin=? [ F "reached" ]"#, lower()),
        (r#"P>=0.5 [ F<=3 "reached" ]"#, lower()),
        (r#"Pmaxmin=? [ X "reached" ]"#, lower()),
        (r#"Pmaxmin=? [ F x1=7 ]"#, lower()),
        (r#"Pmaxmin=? [ x1<40 U "reached" ]"#, lower()),
        (r#"Pmaxmin=? [ G<=6 (x1<40 & !"failed" & !"reached") ]"#, lower()),
        (r#"Pmaxmin=? [ (x1<40 & !"failed") U<=6 "reached" ]"#, lower()),
        // A run ends in `reached`; what comes then, nobody knows.
        (r#"Pmaxmin=? [ G !"failed" ]"#, not(&[AfterReached])),
        (r#"Pmaxmin=? [ G<=6 !"failed" ]"#, not(&[AfterReached])),
        (r#"Pminmax=? [ F "failed" ]"#, not(&[AfterReached])),
        (r#"Pmaxmin=? [ G<=6 x1<40 & !"failed" ]"#, not(&[AfterReached, ReadsReached])),
        // `failed` is also for noise of which nothing is known.
        (r#"Pmaxmin=? [ F "failed" ]"#, not(&[TrueInFailed])),
        (r#"Pmaxmin=? [ F x1<40 ]"#, not(&[TrueInFailed, ReadsReached])),
        (r#"Pmaxmin=? [ F !"reached" ]"#, not(&[TrueInFailed])),
        (r#"Pmaxmax=? [ F "reached" ]"#, not(&[FalseInFailed])),
        (r#"Pminmax=? [ !"failed" U "reached" ]"#, not(&[FalseInFailed])),
        // What is in special states instead of a cell's index is no index.
        (r#"Pmaxmin=? [ F x1=-2 ]"#, not(&[ReadsReached])),
        // Upper bounds of failing before the goal is reached.
        (r#"Pminmax=? [ !"reached" U "failed" ]"#, Coverage::Upper),
        (r#"Pmaxmax=? [ !"reached" U<=6 "failed" ]"#, Coverage::Upper),
    ];
    let room = abstraction("room_temperature", &[]);
    for (text, expected) in cases {
        let property = parse_property(text).unwrap();
        assert_eq!(room.guarantee.coverage(&property, &room.model).unwrap(), expected, "{text}");
    }
    let published = abstraction("room_temperature", &[crate::common::reference_mode()]);
    let property = parse_property(r#"Pmaxmin=? [ F "reached" ]"#).unwrap();
    let found = published.guarantee.coverage(&property, &published.model).unwrap();
    assert_eq!(found, not(&[Gap::Published]));
}

/// Compiles a model with all its files.
fn compiled(model: &str, directory: &Path) {
    let model = root().join(model);
    let mut command = Command::cargo_bin("dynabs-compile").unwrap();
    command.arg(model).arg("-o").arg(directory).arg("-q").assert().success();
}

/// The answers of `dynabs-check solve --json`.
fn solved(path: &Path, arguments: &[&str]) -> Vec<Value> {
    let mut command = Command::cargo_bin("dynabs-check").unwrap();
    let output = command.arg("solve").arg(path).args(arguments).arg("--json").output().unwrap();
    let json: Value = serde_json::from_slice(&output.stdout).unwrap();
    json["results"].as_array().unwrap().clone()
}

/// Doubling makes every input from 3.75 leave the partition: nothing is enabled there, and failing is certain.
#[test]
fn a_run_that_starts_where_nothing_is_enabled_has_failed() {
    let scratch = TempDir::new().unwrap();
    let run = scratch.path().join("run");
    compiled("tests/data/soundness/blk.json", &run);
    let asked = [
        ("Pmaxmax=? [ F \"failed\" ]", 1.0, false),
        ("Pmaxmin=? [ G !\"failed\" ]", 0.0, false),
        ("Pmaxmin=? [ F \"reached\" ]", 0.0, true),
        ("Pminmax=? [ !\"reached\" U \"failed\" ]", 1.0, true),
    ];
    let arguments: Vec<&str> = asked.iter().flat_map(|(property, ..)| ["-p", property]).collect();
    for (result, (property, value, covered)) in solved(&run, &arguments).iter().zip(asked) {
        assert_eq!([&result["lower"], &result["upper"]], [value, value], "{property}");
        assert_eq!(result["guarantee"]["covered"], covered, "{property}");
        assert_eq!(result["guarantee"]["confidence"], if covered { 0.99.into() } else { Value::Null });
    }
}

/// Nothing is claimed of a file that is not the run's, or not its numbers.
#[test]
fn claims_are_about_the_file_that_was_compiled() {
    let scratch = TempDir::new().unwrap();
    let (run, other) = (scratch.path().join("run"), scratch.path().join("other"));
    compiled("models/room_temperature.json", &run);
    compiled("tests/data/soundness/blk.json", &other);
    let claim = |path: &Path, arguments: &[&str]| solved(path, arguments)[0]["guarantee"].clone();
    assert_eq!(claim(&run, &[])["covered"], true);
    assert!(claim(&run, &["--explicit"])["text"].as_str().unwrap().contains("raised"));
    // A file by itself is of no run.
    assert_eq!(claim(&run.join("model.dynabs"), &[]), Value::Null);
    // Another run's file in its place is refused.
    fs::copy(other.join("model.dynabs"), run.join("model.dynabs")).unwrap();
    Command::cargo_bin("dynabs-check").unwrap().arg("solve").arg(&run).assert().code(2);
}

/// People read the same.
#[test]
fn the_table_says_it_too() {
    let scratch = TempDir::new().unwrap();
    let run = scratch.path().join("run");
    compiled("models/room_temperature.json", &run);
    let mut command = Command::cargo_bin("dynabs-check").unwrap();
    let asked = ["-p", "Pmaxmin=? [ F \"reached\" ]", "-p", "Pmaxmin=? [ G !\"failed\" ]"];
    let output = command.arg("solve").arg(&run).args(asked).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("\n  covered: a controller attains at least 0.99"), "{text}");
    assert!(text.contains("\n  not covered: the model stays in \"reached\""), "{text}");
}

/// The cells of a small system: three ordinary ones, a goal cell and an unsafe one.
const CELLS: usize = 5;
const GOAL: usize = 3;
const UNSAFE: usize = 4;
/// States of its model: `failed`, `reached`, then ordinary cells.
const FAILED: usize = 0;
const REACHED: usize = 1;

fn small_model() -> IntervalMdp {
    let set = |states: &[usize]| {
        let mut set = StateSet::with_capacity(5);
        set.extend(states.iter().copied());
        set
    };
    let mut rows = Rows::new();
    (0..5).for_each(|state| rows.push_entry(StateId(state), 0.0, 1.0));
    rows.finish_row();
    let mut choices = ChoicesBuilder::with_capacity(5);
    choices.push_absorbing();
    choices.push_absorbing();
    for _ in 2..5 {
        choices.push_range(RowRange { first: RowId(0), last: RowId(0) });
        choices.finish_state();
    }
    let mut labels = Labels::default();
    labels.insert("reached", set(&[REACHED]));
    labels.insert("failed", set(&[FAILED]));
    let mut variables = StateVariables::default();
    variables.push("x1", VariableValues::Int(vec![-1, -2, 0, 1, 2]));
    IntervalMdp::new(Parts {
        kind: ModelKind::Imdp,
        rows,
        choices: choices.finish(),
        actions: ActionNames::OfRow,
        initial: set(&[2]),
        labels,
        variables,
    })
    .unwrap()
}

fn guarantee() -> Guarantee {
    let (budget, components) = (vec![], None);
    let samples = SampleEvidence {
        number: 100,
        beta: 0.01,
        sweep: 1,
        budget,
        unseen_mass: 0.1,
        components,
        follows_plan: false,
    };
    Guarantee { evidence: Evidence::Samples(samples), ..Guarantee::none() }
}

/// Where a path is: labels and the value of `x1`.
#[derive(Clone, Copy)]
struct Place {
    reached: bool,
    failed: bool,
    x: i64,
}

/// A cell, as the system sees it.
fn place_of_cell(cell: usize) -> Place {
    Place { reached: cell == GOAL, failed: cell == UNSAFE, x: cell as i64 }
}

/// A path of the model: the system's until it is over, or until its mass is moved to `failed`.
fn model_path(cells: &[usize], moved: Option<usize>) -> Vec<Place> {
    let failed = Place { reached: false, failed: true, x: -1 };
    let reached = Place { reached: true, failed: false, x: -2 };
    let mut over = None;
    let at = |(t, &cell): (usize, &usize)| {
        over = over.or(match cell {
            _ if moved == Some(t) => Some(failed),
            GOAL => Some(reached),
            UNSAFE => Some(failed),
            _ => None,
        });
        over.unwrap_or(place_of_cell(cell))
    };
    cells.iter().enumerate().map(at).collect()
}

fn holds(formula: &StateFormula, place: Place) -> bool {
    let number = |expression: &IntegerExpression| match expression {
        IntegerExpression::Literal(value) => i64::from(*value),
        IntegerExpression::Negate(_) => -2,
        _ => place.x,
    };
    match formula {
        StateFormula::True => true,
        StateFormula::Label(name) => {
            if name == "reached" {
                place.reached
            } else {
                place.failed
            }
        }
        StateFormula::Compare(left, Relation::Less, right) => number(left) < number(right),
        StateFormula::Compare(left, _, right) => number(left) == number(right),
        StateFormula::Not(operand) => !holds(operand, place),
        StateFormula::And(operands) => operands.iter().all(|operand| holds(operand, place)),
        StateFormula::Or(operands) => operands.iter().any(|operand| holds(operand, place)),
        other => unreachable!("{other}"),
    }
}

/// Whether a path that stays where it ends satisfies a formula.
fn satisfies(path: &PathFormula, places: &[Place]) -> bool {
    let within = |steps: &Option<u64>| steps.map_or(places.len() - 1, |k| (k as usize).min(places.len() - 1));
    match path {
        PathFormula::Next(formula) => holds(formula, places[1]),
        PathFormula::Finally { formula, steps } => (0..=within(steps)).any(|t| holds(formula, places[t])),
        PathFormula::Globally { formula, steps } => (0..=within(steps)).all(|t| holds(formula, places[t])),
        PathFormula::Until { left, right, steps } => {
            (0..=within(steps)).any(|t| holds(right, places[t]) && (0..t).all(|i| holds(left, places[i])))
        }
    }
}

fn state_formula() -> impl Strategy<Value = StateFormula> {
    let x = || IntegerExpression::Variable("x1".into());
    let leaf = prop_oneof![
        Just(StateFormula::True),
        Just(StateFormula::label("reached")),
        Just(StateFormula::label("failed")),
        (0u32..5)
            .prop_map(move |c| { StateFormula::Compare(x(), Relation::Less, IntegerExpression::Literal(c)) }),
        (0u32..5).prop_map(move |c| {
            StateFormula::Compare(x(), Relation::Equal, IntegerExpression::Literal(c))
        }),
        Just(StateFormula::Compare(
            x(),
            Relation::Equal,
            IntegerExpression::Negate(Box::new(IntegerExpression::Literal(2)))
        )),
    ];
    leaf.prop_recursive(3, 8, 2, |inner| {
        prop_oneof![
            inner.clone().prop_map(StateFormula::negation),
            prop::collection::vec(inner.clone(), 2).prop_map(StateFormula::And),
            prop::collection::vec(inner, 2).prop_map(StateFormula::Or),
        ]
    })
}

fn path_formula() -> impl Strategy<Value = PathFormula> {
    let steps = || prop::option::of(0u64..3);
    prop_oneof![
        state_formula().prop_map(PathFormula::Next),
        (state_formula(), steps()).prop_map(|(formula, steps)| PathFormula::Finally { formula, steps }),
        (state_formula(), steps()).prop_map(|(formula, steps)| PathFormula::Globally { formula, steps }),
        (state_formula(), state_formula(), steps()).prop_map(|(left, right, steps)| PathFormula::Until {
            left,
            right,
            steps
        }),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Where a lower bound is covered, no path of the model satisfies the formula unless the system's does, whatever it does
    /// after the run is over and wherever its mass was moved; for upper bounds the other way round.
    #[test]
    fn covered_answers_hold_for_every_path(path in path_formula()) {
        const LENGTH: usize = 4;
        let (model, guarantee) = (small_model(), guarantee());
        let coverage = |resolution| {
            guarantee.coverage(&Property::value(resolution, path.clone()), &model).unwrap()
        };
        let below = coverage(Resolution::Pmaxmin) == Coverage::Lower;
        let above = coverage(Resolution::Pminmax) == Coverage::Upper;
        prop_assert_eq!(below, coverage(Resolution::Pminmin) == Coverage::Lower);
        prop_assert_eq!(above, coverage(Resolution::Pmaxmax) == Coverage::Upper);
        let (mut fails_below, mut fails_above) = (false, false);
        for number in 0..CELLS.pow(LENGTH as u32 - 1) {
            // All paths from the first cell.
            let cells: Vec<usize> = std::iter::once(0)
                .chain((0..LENGTH as u32 - 1).map(|t| number / CELLS.pow(t) % CELLS))
                .collect();
            let of_system: Vec<Place> = cells.iter().map(|&cell| place_of_cell(cell)).collect();
            let system = satisfies(&path, &of_system);
            for moved in std::iter::once(None).chain((1..LENGTH).map(Some)) {
                let model = satisfies(&path, &model_path(&cells, moved));
                fails_below |= model && !system;
                fails_above |= system && !model;
            }
        }
        prop_assert!(!(below && fails_below), "{} is not covered from below", path);
        prop_assert!(!(above && fails_above), "{} is not covered from above", path);
    }
}
