//! Certificates of rewards, LTL and nested probabilities: honest ones are accepted, and nothing false is.

use crate::common::certified::files;
use crate::solver::models::{any_model, labelled};
use imdp::certificate::{self, Claim, Derivation, Evidence, Statement, Step};
use imdp::evaluation::{Evaluation, check_derivation};
use imdp::model::{IntervalMdp, RewardStructure, StateId};
use imdp::property::{Compound, Definitions, Inquiry, Verdict, parse_inquiry};
use imdp::solver::SolverOptions;
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use std::cell::Cell;

const PATHS: [&str; 21] = [
    "R{K}=? [ F \"goal\" ]",
    "R{K}=? [ F !\"safe\" ]",
    "R{K}=? [ C<=4 ]",
    "R{K}=? [ C<=3, discount=0.7 ]",
    "R{K}=? [ C, discount=0.75 ]",
    "R{K}=? [ I=3 ]",
    "R{K}=? [ X (F \"goal\") ]",
    "P{K}=? [ F (P>=0.3 [ \"safe\" U<=3 \"goal\" ]) ]",
    "P{K}=? [ G (P<0.9 [ X \"goal\" ]) ]",
    "P{K}=? [ (P>0.2 [ F \"goal\" ]) U (P<=0.4 [ F \"goal\" ]) ]",
    "P{K}=? [ F (R<3 [ C<=3 ]) ]",
    "P{K}=? [ G (F \"goal\") ]",
    "P{K}=? [ F (G \"safe\") ]",
    "P{K}=? [ (G (F \"safe\")) & (G (F \"goal\")) ]",
    "P{K}=? [ (F (G \"safe\")) | (G (F !\"goal\")) ]",
    "P{K}=? [ (G (F \"safe\")) => (G (F \"goal\")) ]",
    "P{K}=? [ G (\"safe\" => (F \"goal\")) ]",
    "P{K}=? [ F (\"safe\" & (X (X \"goal\"))) ]",
    "P{K}=? [ \"safe\" U (\"goal\" & (X !\"safe\")) ]",
    "(R{K}=? [ C<=2 ])>1.5",
    "2*P{K}=? [ F \"goal\" ] + min(1, R{K}=? [ C<=2 ])",
];

fn expression(path: &str, kind: &str) -> Compound {
    match parse_inquiry(&path.replace("{K}", kind), &Definitions::default()).unwrap() {
        Inquiry::Compound(compound) => compound,
        Inquiry::Probability(property) => panic!("{property} has certificates of its own"),
    }
}

/// The evaluation and its certificate, if there is one, which has been through a file and was accepted.
fn derived(model: &IntervalMdp, compound: &Compound) -> Option<(Claim, Derivation)> {
    let options = SolverOptions { evidence: true, ..SolverOptions::default() };
    let mut evaluation = Evaluation::new(model, compound, None, &options).ok()?;
    let honest = evaluation.derivation(compound, None, model, files())?;
    let mut bytes = vec![];
    certificate::write_derivation(&honest, &mut bytes).unwrap();
    assert_eq!(certificate::read_statement(&bytes).unwrap(), Statement::Expression(honest.clone()));
    check_derivation(&honest, model, &files())
        .unwrap_or_else(|rejection| panic!("{compound}: {rejection}\n{model:?}\n{honest:?}"));
    Some((honest.claim, honest))
}

fn rewarded(model: IntervalMdp, earned: &[u8]) -> IntervalMdp {
    let mut rewards = RewardStructure::new("cost");
    let at = |i: usize| f64::from(earned[i % earned.len()] % 8) / 4.0;
    rewards.states = (0..model.num_states()).map(at).collect();
    rewards.choices = (0..model.size().choices as usize).map(|c| at(c + 3)).collect();
    let first_choices = model.choices().first_choices();
    let lists = StateId::first(model.num_states()).flat_map(|s| {
        let first = first_choices[s.index()];
        (first..).zip(model.choices().rows(s)).map(|(c, row)| (c, model.rows().row_len(row)))
    });
    let some = lists.filter(|(choice, _)| earned[*choice as usize % earned.len()].is_multiple_of(5));
    rewards.branches =
        some.map(|(c, length)| (c, (0..length).map(|i| at(c as usize + i)).collect())).collect();
    model.with_rewards(vec![rewards]).unwrap()
}

/// What to change: which proof, which list, which entry, and how.
type Lie = (prop::sample::Index, u8, prop::sample::Index, u8);

fn bend(value: f64, kind: u8) -> f64 {
    let bent = match kind % 5 {
        0 => value.next_up(),
        1 => value + 1e-3,
        2 => value * 1.01 + 0.01,
        3 => value * 0.99 - 0.01,
        _ => value - 1e-3,
    };
    bent.max(0.0)
}

fn lie_about(derivation: &mut Derivation, (proof, list, entry, kind): Lie) {
    /// One entry, or all of them: what is false in all states may feed itself.
    fn pick<T>(list: &mut [(StateId, T)], entry: prop::sample::Index, change: impl Fn(&mut T)) {
        if entry.index(3) == 0 {
            list.iter_mut().for_each(|item| change(&mut item.1));
        } else if !list.is_empty() {
            change(&mut entry.get_mut(list).1);
        }
    }
    fn step(steps: &mut [Step], entry: prop::sample::Index) -> Option<&mut Step> {
        if steps.is_empty() { None } else { Some(entry.get_mut(steps)) }
    }
    if derivation.proofs.is_empty() {
        return;
    }
    let probability = |value: &mut f64| *value = bend(*value, kind).min(1.0);
    let reward = |value: &mut f64| *value = bend(*value, kind);
    let choice = |value: &mut u32| *value = u32::from(kind % 3);
    match (proof.get_mut(&mut derivation.proofs), list % 4) {
        (Evidence::Inductive(proof), 0) => pick(&mut proof.choices, entry, choice),
        (Evidence::Inductive(proof), 1) => pick(&mut proof.lower, entry, probability),
        (Evidence::Inductive(proof), 2) => pick(&mut proof.upper, entry, probability),
        (Evidence::Inductive(proof), _) => pick(&mut proof.ranks, entry, choice),
        (Evidence::RewardInductive(proof), 0) => pick(&mut proof.choices, entry, choice),
        (Evidence::RewardInductive(proof), 1) => pick(&mut proof.lower, entry, reward),
        (Evidence::RewardInductive(proof), 2) => pick(&mut proof.upper, entry, reward),
        (Evidence::RewardInductive(proof), _) => pick(&mut proof.missed, entry, probability),
        (Evidence::Steps(steps), list) => {
            if let Some(step) = step(steps, entry) {
                match list {
                    0 => pick(&mut step.choices, entry, choice),
                    1 => pick(&mut step.lower, entry, probability),
                    _ => pick(&mut step.upper, entry, probability),
                }
            }
        }
        (Evidence::RewardSteps(steps), list) => {
            if let Some(step) = step(steps, entry) {
                match list {
                    0 => pick(&mut step.choices, entry, choice),
                    1 => pick(&mut step.lower, entry, reward),
                    _ => pick(&mut step.upper, entry, reward),
                }
            }
        }
    }
}

/// Claims that say something false, given what is true.
fn false_claims(truth: Claim) -> Vec<Claim> {
    match truth {
        Claim::Between(lower, upper) => {
            let mut claims = vec![];
            if upper.is_finite() {
                claims.push(Claim::Between(upper.next_up(), f64::INFINITY));
                claims.push(Claim::Between(upper + 1e-3, f64::INFINITY));
            }
            claims.push(Claim::Between(0.0, if lower.is_finite() { lower.next_down() } else { 1e9 }));
            claims
        }
        Claim::Verdict(truth) => {
            let all = [Verdict::Holds, Verdict::Fails, Verdict::Unknown];
            all.into_iter().filter(|claim| *claim != truth).map(Claim::Verdict).collect()
        }
    }
}

#[test]
fn what_is_accepted_is_true() {
    let cases =
        if std::env::var_os("PROPTEST_CASES").is_some() { ProptestConfig::default().cases } else { 40 };
    let config = ProptestConfig { cases, failure_persistence: None, ..ProptestConfig::default() };
    let lies = prop::collection::vec(
        (any::<prop::sample::Index>(), any::<u8>(), any::<prop::sample::Index>(), any::<u8>()),
        1..4,
    );
    let strategy = (
        any_model(3, 3),
        prop::collection::vec(any::<u8>(), 11),
        0..PATHS.len(),
        0..4usize,
        prop::collection::vec(lies, 10),
    );
    let (accepted, rejected, without) = (Cell::new(0), Cell::new(0), Cell::new(0));
    TestRunner::new(config)
        .run(&strategy, |((model, safe, goal), earned, path, kind, lies)| {
            let model = rewarded(labelled(&model, &safe, &goal), &earned);
            for path in [path, (path + 7) % PATHS.len(), (path + 14) % PATHS.len()] {
                let compound = expression(PATHS[path], ["maxmin", "maxmax", "minmin", "minmax"][kind]);
                let Some((truth, honest)) = derived(&model, &compound) else {
                    without.set(without.get() + 1);
                    continue;
                };
                accepted.set(accepted.get() + 1);
                for lies in &lies {
                    let mut bent = honest.clone();
                    lies.iter().for_each(|&lie| lie_about(&mut bent, lie));
                    for claim in false_claims(truth) {
                        let forged = Derivation { claim, ..bent.clone() };
                        let outcome = check_derivation(&forged, &model, &files());
                        prop_assert!(
                            outcome.is_err(),
                            "{}: {:?} is {:?}: {:?}",
                            compound,
                            claim,
                            truth,
                            forged
                        );
                        rejected.set(rejected.get() + 1);
                    }
                }
            }
            Ok(())
        })
        .unwrap();
    println!(
        "{} accepted, {} forged ones rejected, {} without",
        accepted.get(),
        rejected.get(),
        without.get()
    );
    assert!(accepted.get() > 2 * without.get() && rejected.get() > 500, "{} without", without.get());
}

#[test]
fn numbers_too_large_to_be_added_up_prove_nothing() {
    let rows = [vec![(0, 0.2, 0.5), (1, 0.5, 0.8)]];
    let model = crate::solver::models::model(&rows, &[Some(vec![(0, 0)]), None]);
    let goal = crate::solver::models::set(2, &[1]);
    let model = labelled(&model, &goal, &goal);
    let earning = |reward: f64| {
        let mut rewards = RewardStructure::new("cost");
        rewards.branches.insert(0, vec![reward, 0.0]);
        model.clone().with_rewards(vec![rewards]).unwrap()
    };
    let (_, honest) = derived(&earning(1.0), &expression(PATHS[0], "maxmax")).unwrap();
    for reward in [1e300, f64::MAX] {
        let rejection = check_derivation(&honest, &earning(reward), &files()).unwrap_err().to_string();
        assert!(rejection.contains("less than 1e300"), "{rejection}");
    }
    let mut forged = honest.clone();
    let Evidence::RewardInductive(proof) = &mut forged.proofs[0] else { unreachable!() };
    proof.upper[0].1 = f64::MAX;
    assert!(check_derivation(&forged, &earning(1.0), &files()).is_err());
}

#[test]
fn a_proof_is_about_what_it_says() {
    let model =
        crate::solver::models::model(&[vec![(0, 0.2, 0.5), (1, 0.5, 0.8)]], &[Some(vec![(0, 0)]), None]);
    let goal = crate::solver::models::set(2, &[1]);
    let model = rewarded(labelled(&model, &goal, &goal), &[4]);
    let (_, honest) = derived(&model, &expression(PATHS[0], "maxmax")).unwrap();
    let mut missing = honest.clone();
    missing.proofs.clear();
    let mut too_many = honest.clone();
    too_many.proofs.push(Evidence::Steps(vec![]));
    let mut other = honest.clone();
    other.proofs = vec![Evidence::Steps(vec![])];
    let mut other_states = honest.clone();
    other_states.states = 3;
    let renamed = Derivation { expression: "Rmaxmax=? [ F".to_owned(), ..honest.clone() };
    for (forged, why) in [
        (missing, "found fewer proofs than operators"),
        (too_many, "found 1 proofs more than operators"),
        (other, "something else"),
        (other_states, "found 2 states in the model"),
        (renamed, "unexpected end"),
    ] {
        let rejection = check_derivation(&forged, &model, &files()).unwrap_err().to_string();
        assert!(rejection.contains(why) || why == "unexpected end", "{rejection}");
    }
}
