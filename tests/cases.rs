//! Models and exact values as data (`tests/cases/*.json`), through everything that reads and solves.
use crate::common::cases::{Case, Expected, Kind, for_every_case};
use crate::common::certified::certified;
use imdp::formats::native;
use imdp::formats::prism::{self, TraWriter};
use imdp::formats::row_states::RowStates;
use imdp::formats::umb::Compression;
use imdp::formats::{Format, ModelWriter};
use imdp::model::IntervalMdp;
use imdp::numeric::{Rational, from_dyadic};
use imdp::property::{Property, Verdict};
use imdp::solver::{SolverOptions, Status};
use num_traits::Zero;

const EPSILON: f64 = 1e-6;
const BOUNDED_EPSILON: f64 = 1e-12;
/// How far raised lower bounds, and the widening of sums that they make necessary, may move a value.
const RAISING: f64 = 1e-12;

/// Solves everything that is asked and compares; exact values may be missed by `slack`.
fn check(case: &Case, model: &IntervalMdp, how: &str, slack: f64) {
    let slack = from_dyadic(slack).unwrap();
    for values in &case.values {
        let expected = if case.kind == Kind::Imdp { 4 } else { 2 };
        assert_eq!(values.of.len(), expected, "{}: {} misses an operator", case.name, values.path);
        for (operator, exact) in &values.of {
            let text = format!("P{operator}=? [ {} ]", values.path);
            let at = format!("{}, {how}: {text}", case.name);
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
    for Expected { property, satisfied } in &case.verdicts {
        let at = format!("{}, {how}: {property}", case.name);
        let (bounds, verdict) = bounds(model, property, &at);
        let expected = if *satisfied { Verdict::Holds } else { Verdict::Fails };
        assert_eq!(verdict, Some(expected), "{at}: {bounds:?}");
    }
}

/// Certified bounds of all states, close enough to each other, and the verdict about the initial states if asked.
fn bounds(model: &IntervalMdp, text: &str, at: &str) -> (Vec<(f64, f64)>, Option<Verdict>) {
    let property: Property = text.parse().unwrap_or_else(|error| panic!("{at}: {error}"));
    let options = SolverOptions { epsilon: EPSILON, policy: true, ..Default::default() };
    let (answer, _) = certified(model, &property, &options);
    let bounded = answer.objective.path.steps().is_some();
    let status = if bounded { Status::HorizonReached } else { Status::Converged };
    assert_eq!(answer.solution.status, status, "{at}");
    let bounds: Vec<_> =
        answer.values.lower.iter().copied().zip(answer.values.upper.iter().copied()).collect();
    let epsilon = if bounded { BOUNDED_EPSILON } else { EPSILON };
    for &(lower, upper) in &bounds {
        assert!(0.0 <= lower && lower <= upper && upper <= 1.0, "{at}: [{lower},{upper}]");
        // One rounding more for complements.
        assert!(upper - lower <= epsilon + f64::EPSILON, "{at}: [{lower},{upper}]");
    }
    (bounds, answer.verdict)
}

#[test]
fn explicit_files_are_solved_with_one_thread_and_with_four() {
    for threads in [1, 4] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            for_every_case(|case, model, _| check(case, model, &format!("{threads} threads"), 0.0));
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
        check(case, &again, "native", 0.0);
    });
}

#[test]
fn files_of_other_formats_are_solved() {
    for_every_case(|case, model, directory| {
        for format in [Format::Drn, Format::Umb] {
            let path = directory.join("case").with_extension(format.extension());
            let writer = ModelWriter::new(model, format, Compression::Gzip).unwrap();
            writer.write(format.extension(), &mut std::fs::File::create(&path).unwrap(), &()).unwrap();
            let again = format.import(&path, &()).unwrap().model;
            assert_eq!(again, *model, "{} as {format}", case.name);
            check(case, &again, &format.to_string(), 0.0);
        }
    });
}

#[test]
fn models_with_row_states_have_the_same_values() {
    for_every_case(|case, model, _| {
        // Slow ones take more than twice as long with twice the states on the way.
        if case.name.starts_with("slow") {
            return;
        }
        let encoded = RowStates::new(model).unwrap();
        for values in case.values.iter().filter(|values| !values.path.starts_with('X')) {
            for (operator, exact) in &values.of {
                let property: Property = format!("P{operator}=? [ {} ]", values.path).parse().unwrap();
                let text = encoded.translate(&property).unwrap();
                let at = format!("{}, with row states: {text}", case.name);
                let found = bounds(&encoded.model, &text, &at).0;
                for (exact, (lower, upper)) in exact.split(' ').zip(found) {
                    let exact: Rational = exact.parse().unwrap();
                    let (low, high) = (from_dyadic(lower).unwrap(), from_dyadic(upper).unwrap());
                    assert!(low <= exact && exact <= high, "{at}: {lower} ≤ {exact} ≤ {upper}");
                }
            }
        }
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
        let raised = model.rows().to_stored().iter().any(|row| row.lower.contains(&0.0));
        check(case, &again, "written for PRISM", if raised { RAISING } else { 0.0 });
    });
}

#[test]
fn fragile_cases_are_those_with_zero_lower_bounds() {
    for_every_case(|case, model, _| {
        let zero = model.rows().to_stored().iter().any(|row| row.lower.iter().any(Zero::is_zero));
        assert!(zero || !case.fragile, "{}", case.name);
    });
}
