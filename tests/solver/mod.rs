//! The solver against exact values.
mod cases;
pub mod models;
pub mod reference;
mod thresholds;

use crate::common::certified::certified;
use imdp::model::{IntervalMdp, StateId, StateSet};
use imdp::numeric::from_dyadic;
use imdp::property::Resolution;
use imdp::solver::{Event, Solution, SolverOptions, Status, ValueBounds, solve};
use num_rational::BigRational;
use proptest::prelude::*;
use reference::Exact;

const RESOLUTIONS: [(Resolution, (bool, bool)); 4] = [
    (Resolution::Pmaxmin, (true, false)),
    (Resolution::Pmaxmax, (true, true)),
    (Resolution::Pminmin, (false, false)),
    (Resolution::Pminmax, (false, true)),
];

/// Solves and has the result certified.
fn until(
    model: &IntervalMdp,
    safe: &StateSet,
    goal: &StateSet,
    steps: Option<u64>,
    resolution: Resolution,
) -> Solution {
    let steps = steps.map_or_else(String::new, |steps| format!("<={steps}"));
    let property = format!("{resolution}=? [ \"safe\" U{steps} \"goal\" ]").parse().unwrap();
    certified(&models::labelled(model, safe, goal), &property, &options()).0.solution
}

/// Solves without a certificate.
fn until_uncertified(
    model: &IntervalMdp,
    safe: &StateSet,
    goal: &StateSet,
    steps: Option<u64>,
    resolution: Resolution,
) -> Solution {
    solve(model, &Event::Until { safe, goal, steps }, resolution, &options()).unwrap()
}

fn options() -> SolverOptions<'static> {
    SolverOptions { policy: true, max_iterations: 2_000_000, ..Default::default() }
}

fn big(x: Exact) -> BigRational {
    BigRational::new((*x.numer()).into(), (*x.denom()).into())
}

fn assert_bracketed(bounds: &ValueBounds, exact: &[BigRational], what: &str) {
    for (s, exact) in exact.iter().enumerate() {
        let (lower, upper) = (bounds.lower[s], bounds.upper[s]);
        assert!(
            from_dyadic(lower).unwrap() <= *exact && *exact <= from_dyadic(upper).unwrap(),
            "{what}: state {s}: {lower} ≤ {exact} ≤ {upper}"
        );
    }
}

/// At least 400 cases; `PROPTEST_CASES` for more.
fn config() -> ProptestConfig {
    let default = ProptestConfig::default();
    ProptestConfig { cases: default.cases.max(400), failure_persistence: None, ..default }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn bounded_values_are_bracketed((model, safe, goal) in models::any_model(5, 8), steps in 0u64..7) {
        for (resolution, maxima) in RESOLUTIONS {
            let exact = reference::bounded(&model, &safe, &goal, steps, maxima, false);
            let solution = until(&model, &safe, &goal, Some(steps), resolution);
            assert_bracketed(&solution.values, &exact, &format!("{resolution}"));
            prop_assert_eq!(solution.status, Status::HorizonReached);
            prop_assert!(solution.values.gap() <= 1e-12);
            let exact = reference::bounded(&model, &safe, &goal, 1, maxima, true);
            let property = format!("{resolution}=? [ X \"goal\" ]").parse().unwrap();
            let next = certified(&models::labelled(&model, &safe, &goal), &property, &options()).0;
            assert_bracketed(&next.values, &exact, &format!("X {resolution}"));
            prop_assert!(next.values.gap() <= 1e-12);
        }
    }

    #[test]
    fn unbounded_values_are_bracketed((model, safe, goal) in models::any_model(3, 3)) {
        let exact = reference::unbounded(&model, &safe, &goal);
        for ((resolution, _), exact) in RESOLUTIONS.into_iter().zip(exact) {
            let solution = until(&model, &safe, &goal, None, resolution);
            let rationals: Vec<_> = exact.iter().copied().map(big).collect();
            assert_bracketed(&solution.values, &rationals, &format!("{resolution}"));
            prop_assert_eq!(solution.status, Status::Converged, "{} {:?}", resolution, solution);
            prop_assert!(solution.values.gap() <= 1e-6);
            // The extreme values are known exactly.
            for (s, value) in exact.iter().enumerate() {
                prop_assert_eq!(solution.values.upper[s] == 0.0, *value == Exact::from_integer(0));
                prop_assert_eq!(solution.values.lower[s] == 1.0, *value == Exact::from_integer(1));
            }
            policy_keeps_its_promise(&model, &safe, &goal, resolution, &solution);
        }
    }
}

/// Fixing the policy costs at most the distance of the bounds.
fn policy_keeps_its_promise(
    model: &IntervalMdp,
    safe: &StateSet,
    goal: &StateSet,
    resolution: Resolution,
    solution: &Solution,
) {
    let policy = solution.policy.as_ref().unwrap();
    let rows: Vec<_> =
        StateId::first(model.num_states()).map(|s| policy.row(model.choices(), s, 0)).collect();
    let [worst, best, ..] = reference::unbounded_with(model, safe, goal, Some(&rows));
    for s in 0..model.num_states() {
        let (lower, upper) = (solution.values.lower[s], solution.values.upper[s]);
        let (lower, upper) = (from_dyadic(lower).unwrap(), from_dyadic(upper).unwrap());
        let kept = match resolution {
            Resolution::Pmaxmin => big(worst[s]) >= lower,
            Resolution::Pmaxmax => big(best[s]) >= lower,
            Resolution::Pminmin => big(worst[s]) <= upper,
            Resolution::Pminmax => big(best[s]) <= upper,
        };
        assert!(kept, "{resolution}: state {s}, {rows:?}, {solution:?}");
    }
}
