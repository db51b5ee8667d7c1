//! Random models and random lies: whatever is accepted is true.

use super::oracle::{Oracle, rational};
use crate::common::certified::{certified, files};
use crate::solver::models::{any_model, labelled};
use crate::solver::reference as exact;
use imdp::certificate::{Certificate, Evidence};
use imdp::numeric::Rational;
use imdp::property::{Property, Resolution};
use imdp::solver::SolverOptions;
use imdp::verify::check;
use proptest::prelude::*;

/// What to change: which list, which entry, and how.
type Lie = (u8, prop::sample::Index, u8, u32);

fn lies() -> impl Strategy<Value = Vec<Lie>> {
    prop::collection::vec((0u8..4, any::<prop::sample::Index>(), any::<u8>(), 0u32..6), 1..4)
}

fn bend(value: f64, kind: u8) -> f64 {
    let bent = match kind % 6 {
        0 => value.next_up(),
        1 => value.next_down(),
        2 => value + 1e-7,
        3 => value - 1e-7,
        4 => f64::from(kind / 12) / 20.0,
        _ => f64::from(kind % 2),
    };
    bent.clamp(0.0, 1.0)
}

/// 250 cases; `PROPTEST_CASES` for more.
fn config() -> ProptestConfig {
    let default = ProptestConfig::default();
    let cases = if std::env::var_os("PROPTEST_CASES").is_some() { default.cases } else { 250 };
    ProptestConfig { cases, failure_persistence: None, ..default }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn accepted_inductive_bounds_hold((model, safe, goal) in any_model(3, 3), lies in prop::collection::vec(lies(), 12)) {
        let all = exact::unbounded(&model, &safe, &goal);
        let model = labelled(&model, &safe, &goal);
        for (resolution, exact) in Resolution::ALL.into_iter().zip(all) {
            let property: Property = format!("{resolution}=? [ \"safe\" U \"goal\" ]").parse().unwrap();
            let honest = certified(&model, &property, &SolverOptions::default()).1;
            for lies in &lies {
                let Evidence::Inductive(mut inductive) = honest.evidence.clone() else { unreachable!() };
                for &(list, index, kind, number) in lies {
                    // An empty list cannot be bent.
                    match list {
                        0 if !inductive.choices.is_empty() => index.get_mut(&mut inductive.choices).1 = number % 3,
                        1 if !inductive.lower.is_empty() => {
                            let entry = index.get_mut(&mut inductive.lower);
                            entry.1 = bend(entry.1, kind);
                        }
                        2 if !inductive.upper.is_empty() => {
                            let entry = index.get_mut(&mut inductive.upper);
                            entry.1 = bend(entry.1, kind);
                        }
                        3 if !inductive.ranks.is_empty() => index.get_mut(&mut inductive.ranks).1 = number,
                        _ => {}
                    }
                }
                let evidence = Evidence::Inductive(inductive.clone());
                let claim = Certificate { evidence, lower: 0.0, upper: 1.0, ..honest.clone() };
                if check(&claim, &model, &files()).is_ok() {
                    let value = |s: u32| -> Rational {
                        let exact = exact[s as usize];
                        Rational::new((*exact.numer()).into(), (*exact.denom()).into())
                    };
                    for &(s, lower) in &inductive.lower {
                        prop_assert!(rational(lower) <= value(s.0), "{} {}: {:?}", resolution, s, claim);
                    }
                    for &(s, upper) in &inductive.upper {
                        prop_assert!(value(s.0) <= rational(upper), "{} {}: {:?}", resolution, s, claim);
                    }
                }
            }
        }
    }

    #[test]
    fn steps_are_judged_by_the_definition(
        (model, safe, goal) in any_model(5, 8), steps in 0u64..5, lies in prop::collection::vec(lies(), 6),
    ) {
        let model = labelled(&model, &safe, &goal);
        for resolution in Resolution::ALL {
            for path in [format!("\"safe\" U<={steps} \"goal\""), "X \"goal\"".to_owned()] {
                let property: Property = format!("{resolution}=? [ {path} ]").parse().unwrap();
                let honest = certified(&model, &property, &SolverOptions::default()).1;
                let oracle = Oracle::new(&model, &property);
                for lies in &lies {
                    let Evidence::Steps(mut steps) = honest.evidence.clone() else { unreachable!() };
                    for &(list, index, kind, number) in lies {
                        if steps.is_empty() {
                            continue;
                        }
                        let step = index.get_mut(&mut steps);
                        let bounds = if list == 1 { &mut step.lower } else { &mut step.upper };
                        match list {
                            0 if !step.choices.is_empty() => index.get_mut(&mut step.choices).1 = number % 3,
                            1 | 2 if !bounds.is_empty() => {
                                let entry = index.get_mut(bounds);
                                entry.1 = bend(entry.1, kind);
                            }
                            3 => {
                                steps.truncate(number as usize);
                            }
                            _ => {}
                        }
                    }
                    let truth = oracle.justifies(&steps);
                    let claim =
                        Certificate { evidence: Evidence::Steps(steps), lower: 0.0, upper: 1.0, ..honest.clone() };
                    let found = check(&claim, &model, &files());
                    prop_assert_eq!(found.is_ok(), truth, "{}: {:?} {:?}", property, found, claim);
                }
            }
        }
    }
}
