//! State formulas and queries on a model of four states.

use crate::model::{
    ActionNames, ChoicesBuilder, IntervalMdp, Labels, ModelKind, Parts, RowId, RowRange, Rows, StateId,
    StateSet, StateVariables, VariableValues,
};
use crate::numeric::from_dyadic;
use crate::property::{Property, PropertyError, Query, QueryKind, Resolution};
use num_traits::One;
use proptest::prelude::*;

fn set(states: &[usize]) -> StateSet {
    let mut set = StateSet::with_capacity(4);
    set.extend(states.iter().copied());
    set
}

/// State 0 moves to 1 or 2, state 1 anywhere; 2 is absorbing and 3 is a deadlock.
fn model(labels: &[(&str, &[usize])]) -> IntervalMdp {
    let mut rows = Rows::new();
    rows.push_entry(StateId(1), 0.1, 0.9);
    rows.push_entry(StateId(2), 0.1, 0.9);
    rows.finish_row();
    (0..4).for_each(|state| rows.push_entry(StateId(state), 0.0, 1.0));
    rows.finish_row();
    let mut choices = ChoicesBuilder::with_capacity(4);
    for row in 0..2 {
        choices.push_range(RowRange { first: RowId(row), last: RowId(row) });
        choices.finish_state();
    }
    choices.push_absorbing();
    choices.finish_state();
    let mut all_labels = Labels::default();
    labels.iter().for_each(|(name, states)| all_labels.insert(*name, set(states)));
    let mut variables = StateVariables::default();
    variables.push("x", VariableValues::Int(vec![-1, 0, 1, 2]));
    variables.push("y", VariableValues::Int(vec![i32::MIN, 0, i32::MAX, 5]));
    variables.push("b", VariableValues::Bool(set(&[0, 1])));
    variables.push("c", VariableValues::Bool(set(&[0, 2])));
    IntervalMdp::new(Parts {
        kind: ModelKind::Imdp,
        rows,
        choices: choices.finish(),
        actions: ActionNames::None,
        initial: set(&[0, 1]),
        labels: all_labels,
        variables,
    })
    .unwrap()
}

fn query(text: &str, model: &IntervalMdp) -> Result<Query, PropertyError> {
    text.parse::<Property>().unwrap_or_else(|error| panic!("{error}")).resolve(model.kind())?.query(model)
}

fn states(formula: &str, model: &IntervalMdp) -> Result<StateSet, PropertyError> {
    match query(&format!("Pmaxmin=? [ X {formula} ]"), model)?.kind {
        QueryKind::Next { goal } => Ok(goal),
        kind => panic!("{kind:?}"),
    }
}

#[test]
fn formulas_hold_in_the_right_states() {
    let model = model(&[("goal", &[3]), ("bad", &[2, 3])]);
    for (formula, expected) in [
        ("true", &[0, 1, 2, 3][..]),
        ("false", &[]),
        ("\"goal\"", &[3]),
        ("\"init\"", &[0, 1]),
        ("\"deadlock\"", &[3]),
        ("!\"bad\"", &[0, 1]),
        ("b", &[0, 1]),
        ("b&c", &[0]),
        ("b|c", &[0, 1, 2]),
        ("b=>c", &[0, 2, 3]),
        ("b<=>c", &[0, 3]),
        ("b=c", &[0, 3]),
        ("b!=c", &[1, 2]),
        ("b=false", &[2, 3]),
        ("(x=0)=b", &[1, 2, 3]),
        ("x=0", &[1]),
        ("x!=0", &[0, 2, 3]),
        ("x<-0", &[0]),
        ("x<=0", &[0, 1]),
        ("x>0", &[2, 3]),
        ("x>=2", &[3]),
        ("2*x-1>=-x", &[2, 3]),
        ("x*x=x", &[1, 2]),
        ("-y>2147483647", &[0]),
        ("y+y+y<y", &[0]),
        ("1+1=2", &[0, 1, 2, 3]),
        ("1>2", &[]),
    ] {
        assert_eq!(states(formula, &model), Ok(set(expected)), "{formula}");
    }
}

#[test]
fn a_deadlock_label_counts_more_than_deadlocks() {
    let model = model(&[("deadlock", &[2])]);
    assert_eq!(states("\"deadlock\"", &model), Ok(set(&[2])));
}

#[test]
fn misfits_are_explained() {
    let model = model(&[("goal", &[3])]);
    for (formula, words) in [
        ("\"gaol\"", &["no label \"gaol\"", "did you mean \"goal\"?", "labels: init, deadlock, goal"][..]),
        ("\"xyzzy\"", &["init, deadlock, goal"]),
        ("z", &["no variable z", "one of its variables: x, y, b, c"]),
        ("goal", &["no variable goal", "did you mean \"goal\"?"]),
        ("\"x\"", &["no label \"x\"", "did you mean x?"]),
        ("x=z", &["no variable z"]),
        ("x", &["the integer variable x"]),
        ("b+1=2", &["the Boolean variable b"]),
        ("b<c", &["the Boolean variable b"]),
        ("x=b", &["the Boolean variable b"]),
        ("y*y*y*y>0", &["y*y*y", "state 0", "64 bits"]),
    ] {
        let error = states(formula, &model).unwrap_err().to_string();
        assert!(words.iter().all(|word| error.contains(word)), "{formula}: {error}");
    }
}

#[test]
fn path_formulas_have_a_normal_form() {
    let model = model(&[("goal", &[3])]);
    let all = || set(&[0, 1, 2, 3]);
    let until = |safe, goal: &[usize], steps| QueryKind::Until { safe, goal: set(goal), steps };
    for (text, resolution, kind, complement) in [
        ("Pmaxmin=? [ F x=0 ]", Resolution::Pmaxmin, until(all(), &[1], None), false),
        ("Pmaxmax=? [ F<3 x=0 ]", Resolution::Pmaxmax, until(all(), &[1], Some(2)), false),
        ("Pminmax=? [ b U<=0 \"goal\" ]", Resolution::Pminmax, until(set(&[0, 1]), &[3], Some(0)), false),
        ("Pminmin=? [ X c ]", Resolution::Pminmin, QueryKind::Next { goal: set(&[0, 2]) }, false),
        ("Pmaxmin=? [ G b ]", Resolution::Pminmax, until(all(), &[2, 3], None), true),
        ("Pminmin=? [ G<=7 b ]", Resolution::Pmaxmax, until(all(), &[2, 3], Some(7)), true),
        ("P>0.5 [ G b ]", Resolution::Pmaxmax, until(all(), &[2, 3], None), true),
    ] {
        assert_eq!(query(text, &model), Ok(Query { resolution, kind, complement }), "{text}");
    }
}

proptest! {
    #[test]
    fn complements_enclose(x in prop_oneof![0.0f64..=1.0, 0.0f64..1e-12, Just(0.0), Just(1.0), Just(5e-324)]) {
        let query = query("Pmaxmin=? [ G \"init\" ]", &model(&[])).unwrap();
        let (lower, upper) = query.value_bounds(x, x);
        let exact = num_rational::BigRational::one() - from_dyadic(x).unwrap();
        prop_assert!(from_dyadic(lower).unwrap() <= exact && exact <= from_dyadic(upper).unwrap());
        prop_assert!(0.0 <= lower && upper <= 1.0);
        // As tight as doubles can be.
        prop_assert!(lower == upper || lower.next_up() == upper || lower.next_up().next_up() == upper);
    }
}
