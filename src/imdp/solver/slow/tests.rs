//! Random models solved by strategies alone, and by iteration; the exact checker judges both.

use super::super::query::Players;
use super::super::unbounded::until_with_patience;
use super::super::{Solution, SolverOptions};
use crate::certificate::{Certificate, FileDigest};
use crate::model::{
    ActionNames, ChoicesBuilder, IntervalMdp, Labels, ModelKind, Parts, RowRange, Rows, StateId, StateSet,
    StateVariables,
};
use crate::property::{Property, Resolution};
use crate::verify::check;
use proptest::prelude::*;

const STATES: usize = 7;

/// Weights in sixteenths: `(successor, centre, radius)`; small exits make models slow.
type Weights = Vec<(usize, u32, u32)>;

fn model(states: &[Vec<Weights>], exit: f64) -> IntervalMdp {
    let (mut rows, mut choices) = (Rows::new(), ChoicesBuilder::with_capacity(STATES + 2));
    for own in states {
        for weights in own {
            let mut masses = [(0.0, 0.0); STATES];
            let total: u32 = weights.iter().map(|w| w.1).sum();
            for &(successor, centre, radius) in weights {
                let (centre, radius) = (f64::from(centre) / f64::from(total), f64::from(radius) / 16.0);
                masses[successor].0 += (centre - radius).max(0.0);
                masses[successor].1 += centre + radius;
            }
            // Room for the exits.
            for (s, &(lower, upper)) in masses.iter().enumerate().filter(|(_, m)| m.1 > 0.0) {
                rows.push_entry(StateId(s as u32), lower * (1.0 - 4.0 * exit), upper.min(1.0));
            }
            rows.push_entry(
                StateId(STATES as u32),
                if weights.len() % 2 == 0 { exit } else { 0.0 },
                2.0 * exit,
            );
            rows.push_entry(StateId(STATES as u32 + 1), 0.0, exit * f64::from(total));
            let id = rows.finish_row();
            choices.push_range(RowRange { first: id, last: id });
        }
        choices.finish_state();
    }
    choices.push_absorbing();
    choices.push_absorbing();
    let set = |states: &[usize]| {
        let mut set = StateSet::with_capacity(STATES + 2);
        states.iter().for_each(|&s| set.insert(s));
        set
    };
    let mut labels = Labels::default();
    labels.insert("goal".to_owned(), set(&[STATES]));
    let kind = ModelKind::Imdp;
    let (choices, initial, variables) = (choices.finish(), set(&[0]), StateVariables::default());
    IntervalMdp::new(Parts { kind, rows, choices, actions: ActionNames::None, initial, labels, variables })
        .unwrap()
}

fn assert_accepted(model: &IntervalMdp, resolution: Resolution, solution: &mut Solution) {
    let property: Property = format!("{resolution}=? [ F \"goal\" ]").parse().unwrap();
    let files = vec![FileDigest { kind: "dynabs".to_owned(), sha256: String::new() }];
    let (lower, upper) = (solution.values.lower[0], solution.values.upper[0]);
    let evidence = solution.evidence.take().unwrap();
    let states = model.num_states() as u64;
    let certificate = Certificate { property, files: files.clone(), states, lower, upper, evidence };
    check(&certificate, model, &files).unwrap_or_else(|rejection| panic!("{rejection}\n{certificate:?}"));
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 40, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn strategies_and_iteration_agree(
        states in prop::collection::vec(prop::collection::vec(
            prop::collection::vec((0..STATES, 1u32..5, 0u32..4), 1..4), 1..3), STATES),
        slowness in 1i32..9,
    ) {
        let model = model(&states, 0.01 * 10f64.powi(-slowness));
        let all = { let mut all = StateSet::with_capacity(STATES + 2); all.insert_range(..); all };
        let goal = model.labels().get("goal").unwrap().clone();
        let options = SolverOptions { evidence: true, max_iterations: 2_000, ..SolverOptions::default() };
        for resolution in Resolution::ALL {
            let solve = |patience| {
                until_with_patience(&model, (&all, &goal), Players::from(resolution), &options, patience).unwrap()
            };
            let (mut fast, mut slow) = (solve(1), solve(u64::MAX));
            for s in 0..STATES {
                prop_assert!(fast.values.lower[s] <= slow.values.upper[s], "{} {} {:?}", resolution, s, fast);
                prop_assert!(slow.values.lower[s] <= fast.values.upper[s], "{} {} {:?}", resolution, s, fast);
                prop_assert!(fast.values.lower[s] <= fast.values.upper[s]);
            }
            prop_assert!(fast.values.gap() <= 1e-6, "{} {:?}", resolution, fast);
            assert_accepted(&model, resolution, &mut fast);
            assert_accepted(&model, resolution, &mut slow);
        }
    }
}
