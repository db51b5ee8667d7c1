//! The row-sharing encoding: sizes, and values that are those of the original.

use super::*;
use crate::common::{abstraction, shipped_models};
use crate::solver::models::any_model;
use imdp::formats::row_states::RowStates;
use imdp::property::Property;
use imdp::solver::{Answer, SolverOptions};
use proptest::prelude::*;

const OPERATORS: [&str; 4] = ["maxmin", "maxmax", "minmin", "minmax"];

/// Bounds of the states that both models have.
fn values(model: &IntervalMdp, property: &str, states: usize, epsilon: f64) -> Vec<(f64, f64)> {
    let property: Property = property.parse().unwrap_or_else(|error| panic!("{property}: {error}"));
    let options = SolverOptions { epsilon, ..SolverOptions::default() };
    let answer = Answer::new(model, &property, &options).unwrap();
    let bounds = answer.values.lower.iter().zip(&answer.values.upper);
    bounds.take(states).map(|(&lower, &upper)| (lower, upper)).collect()
}

/// Asks both models the same. A product with 1 is one more rounding in each step, outwards: hence not bitwise.
fn compare(model: &IntervalMdp, paths: &[&str], bounded: f64) {
    let encoded = RowStates::new(model).unwrap();
    let states = model.num_states();
    for path in paths {
        for operator in OPERATORS {
            let property = format!("P{operator}=? [ {path} ]");
            let translated = encoded.translate(&property.parse().unwrap()).unwrap();
            let epsilon = 1e-8;
            let tolerance = if path.contains("<=") { bounded } else { 0.0 };
            let original = values(model, &property, states, epsilon);
            let found = values(&encoded.model, &translated, states, epsilon);
            for (state, (a, b)) in original.iter().zip(&found).enumerate() {
                let at = format!("{property}, state {state}: {a:?} and {b:?}");
                // Both enclose the same value, closely where the number of steps is bounded.
                assert!(a.0 <= b.1 && b.0 <= a.1, "{at}");
                if tolerance > 0.0 {
                    assert!((a.0 - b.0).abs() <= tolerance && (a.1 - b.1).abs() <= tolerance, "{at}");
                }
            }
        }
    }
}

#[test]
fn shipped_models_have_the_same_values() {
    for name in shipped_models() {
        let abstraction = abstraction(&name, &[]);
        let path = abstraction.property.path.to_string();
        let unbounded = ["!\"failed\" U \"reached\"", "G<=5 !\"failed\" | x1=3"];
        let paths: Vec<&str> = match name.starts_with("double") {
            // Large: the task alone.
            true => vec![&path],
            false => std::iter::once(path.as_str()).chain(unbounded).collect(),
        };
        compare(&abstraction.model, &paths, 1e-12);
    }
}

#[test]
fn the_size_is_that_of_choices_and_rows() {
    let model =
        abstraction("double_integrator", &["/input={\"lower\":[-60],\"upper\":[60]}".to_owned()]).model;
    let encoded = RowStates::new(&model).unwrap().model;
    let (size, entries) = (model.size(), model.size().entries);
    assert_eq!(encoded.size().states, size.states + size.rows);
    assert_eq!(encoded.size().choices, size.choices + size.rows);
    let absorbing = model.choices().absorbing().count_ones(..) as u64;
    assert_eq!(encoded.size().transitions, (size.choices - absorbing) + entries + absorbing);
    assert!(encoded.size().transitions * 30 < size.transitions, "{:?}", encoded.size());
}

#[test]
fn names_and_labels_stay() {
    let model = tiny::model();
    let encoded = RowStates::new(&model).unwrap();
    assert_eq!(encoded.label, "row");
    assert_eq!(encoded.model.num_states(), 5 + 3);
    assert_eq!(encoded.model.labels().get("row").unwrap().ones().collect::<Vec<_>>(), [5, 6, 7]);
    assert_eq!(encoded.model.labels().get("goal").unwrap().ones().collect::<Vec<_>>(), [1, 4]);
    assert!(
        encoded.model.choices().is_deadlock(StateId(4)) && encoded.model.choices().is_absorbing(StateId(1))
    );
    let names: Vec<_> = (0..9).map(|choice| encoded.model.actions().name(choice, None)).collect();
    let names: Vec<_> = names.iter().map(|name| name.as_deref()).collect();
    assert_eq!(names[..6], [Some("a_0"), Some("b"), None, Some("b"), Some("c"), None]);
    assert!(names[6..].iter().all(Option::is_none));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn random_models_have_the_same_values((model, safe, goal) in any_model(6, 4)) {
        let mut parts = parts(&model);
        parts.labels.insert("safe", safe);
        parts.labels.insert("goal", goal);
        parts.variables.push("x", VariableValues::Int((0..model.num_states() as i32).collect()));
        let model = IntervalMdp::new(parts).unwrap();
        let paths = [
            "\"safe\" U<=7 \"goal\"",
            "F<=5 \"goal\" | x=2",
            "G<=6 (\"safe\" & x!=3)",
            "G<=4 x<=7",
            "\"safe\" U \"goal\"",
            "F x=1",
            "G !\"goal\"",
            "G (\"safe\" | x=0)",
        ];
        compare(&model, &paths, 1e-13);
    }
}
