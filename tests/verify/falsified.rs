//! False certificates, made from all honest ones of the test suite's cases.

use super::oracle::{Oracle, rational};
use crate::common::cases::{Case, for_every_case};
use crate::common::certified::{certified, files};
use imdp::certificate::{self, Certificate, Evidence, Step};
use imdp::model::{IntervalMdp, StateId};
use imdp::numeric::{Rational, to_f64_down, to_f64_up};
use imdp::property::Property;
use imdp::solver::SolverOptions;
use imdp::verify::check;
use num_traits::One;
use std::collections::BTreeMap;

/// How many certificates of each kind were rejected.
#[derive(Default)]
struct Rejected(BTreeMap<&'static str, usize>);

impl Rejected {
    /// The checker's verdict must be that of `honest`.
    fn judge(&mut self, kind: &'static str, certificate: &Certificate, model: &IntervalMdp, honest: bool) {
        let verdict = check(certificate, model, &files());
        assert_eq!(verdict.is_ok(), honest, "{kind}: {} {verdict:?}\n{certificate:?}", certificate.property);
        *self.0.entry(kind).or_default() += usize::from(!honest);
    }
}

#[test]
fn false_certificates_are_rejected() {
    let rejected = std::sync::Mutex::new(Rejected::default());
    for_every_case(|case, model, _| {
        let mut rejected = rejected.lock().unwrap();
        for_every_query(case, |property, exact| {
            let (_, certificate) = certified(model, &property, &SolverOptions::default());
            let oracle = Oracle::new(model, &property);
            falsify_header(&mut rejected, &certificate, model);
            match &certificate.evidence {
                Evidence::Steps(steps) => falsify_steps(&mut rejected, &certificate, steps, &oracle),
                Evidence::Inductive(_) => falsify_inductive(&mut rejected, &certificate, &oracle, exact),
                Evidence::RewardSteps(_) | Evidence::RewardInductive(_) => unreachable!(),
            }
        });
    });
    let Rejected(counts) = rejected.into_inner().unwrap();
    println!("{counts:?}");
    for kind in [
        "lower bound one ulp too high",
        "upper bound one ulp too low",
        "swapped action",
        "left out step",
        "swapped steps",
        "claim one ulp too high",
        "claim one ulp too low",
        "another model",
        "truncated",
        "lower bound above the value",
        "upper bound below the value",
        "no rank",
    ] {
        assert!(counts.get(kind).is_some_and(|&count| count >= 20), "{kind}: {counts:?}");
    }
    let but_truncated = counts.iter().filter(|(kind, _)| **kind != "truncated").map(|(_, count)| count);
    assert!(but_truncated.sum::<usize>() >= 1000, "{counts:?}");
}

fn for_every_query(case: &Case, mut run: impl FnMut(Property, &[Rational])) {
    for values in &case.values {
        for (operator, exact) in &values.of {
            let exact: Vec<Rational> = exact.split(' ').map(|value| value.parse().unwrap()).collect();
            run(format!("P{operator}=? [ {} ]", values.path).parse().unwrap(), &exact);
        }
    }
}

/// Claims, digests and the file itself.
fn falsify_header(rejected: &mut Rejected, honest: &Certificate, model: &IntervalMdp) {
    if honest.lower < 1.0 {
        // The claim is the least value of the initial states, so it has no room.
        let claim = Certificate { lower: honest.lower.next_up(), ..honest.clone() };
        rejected.judge("claim one ulp too high", &claim, model, false);
    }
    if honest.upper > 0.0 {
        let claim = Certificate { upper: honest.upper.next_down(), ..honest.clone() };
        rejected.judge("claim one ulp too low", &claim, model, false);
    }
    let mut other = honest.clone();
    other.files[0].sha256.replace_range(5..6, "1");
    rejected.judge("another model", &other, model, false);

    let mut bytes = vec![];
    certificate::write(honest, &mut bytes).unwrap();
    let starts = (0..bytes.len()).filter(|&at| at == 0 || bytes[at - 1] == b'\n');
    let places = starts.flat_map(|at| [at, at + 1, at + 9]).chain([bytes.len() - 1, bytes.len() - 20]);
    for length in places.filter(|&length| length < bytes.len()) {
        assert!(certificate::read(&bytes[..length]).is_err(), "{} bytes of {bytes:?}", length);
        *rejected.0.entry("truncated").or_default() += 1;
    }
}

/// Steps with claims that need no proof, so that nothing but the steps can be wrong.
fn with_steps(honest: &Certificate, steps: Vec<Step>) -> Certificate {
    Certificate { evidence: Evidence::Steps(steps), lower: 0.0, upper: 1.0, ..honest.clone() }
}

fn falsify_steps(rejected: &mut Rejected, honest: &Certificate, steps: &[Step], oracle: &Oracle<'_>) {
    let tables = oracle.tables(steps);
    // The first steps, the last one, and every tenth between them.
    let sample = (0..steps.len()).filter(|k| k % 10 < 2 || *k + 1 == steps.len());
    for k in sample {
        for &s in &oracle.moving {
            let choice = tables[k + 1].0[s];
            for lower in [true, false] {
                let before = if lower { &tables[k].1 } else { &tables[k].2 };
                let Some(limit) = oracle.limit(lower, s, choice, before) else { continue };
                let tight = if lower { to_f64_down(&limit) } else { to_f64_up(&limit) };
                let mut changed = steps.to_vec();
                set_bound(&mut changed[k], lower, s, tight);
                // In the last step, nothing depends on the bound but a repetition of the step.
                let honest_so = oracle.justifies(&changed);
                rejected.judge("tight bound", &with_steps(honest, changed.clone()), oracle.model, honest_so);
                let (beyond, kind) = match lower {
                    true => (tight.next_up(), "lower bound one ulp too high"),
                    false => (tight.next_down(), "upper bound one ulp too low"),
                };
                if (0.0..=1.0).contains(&beyond) {
                    set_bound(&mut changed[k], lower, s, beyond);
                    rejected.judge(kind, &with_steps(honest, changed), oracle.model, false);
                }
            }
        }
        for (at, &(s, choice)) in steps[k].choices.iter().enumerate() {
            let count = oracle.model.choices().rows(s).count() as u32;
            // One past the last choice is no choice at all.
            for other in (0..=count).filter(|&other| other != choice) {
                let mut changed = steps.to_vec();
                changed[k].choices[at].1 = other;
                let honest_so = oracle.justifies(&changed);
                rejected.judge("swapped action", &with_steps(honest, changed), oracle.model, honest_so);
            }
        }
        let mut changed = steps.to_vec();
        changed.remove(k);
        let honest_so = oracle.justifies(&changed);
        rejected.judge("left out step", &with_steps(honest, changed), oracle.model, honest_so);
        if k + 1 < steps.len() {
            let mut changed = steps.to_vec();
            changed.swap(k, k + 1);
            let honest_so = oracle.justifies(&changed);
            rejected.judge("swapped steps", &with_steps(honest, changed), oracle.model, honest_so);
        }
    }
}

fn set_bound(step: &mut Step, lower: bool, s: usize, value: f64) {
    set(if lower { &mut step.lower } else { &mut step.upper }, s, value);
}

fn set<T>(list: &mut Vec<(StateId, T)>, s: usize, item: T) {
    let s = StateId::from_index(s);
    match list.binary_search_by_key(&s, |entry| entry.0) {
        Ok(at) => list[at].1 = item,
        Err(at) => list.insert(at, (s, item)),
    }
}

/// `exact` are the values of the property, hence for `G` not those of the event.
fn falsify_inductive(rejected: &mut Rejected, honest: &Certificate, oracle: &Oracle<'_>, exact: &[Rational]) {
    let Evidence::Inductive(inductive) = &honest.evidence else { unreachable!() };
    let with = |inductive| Certificate {
        evidence: Evidence::Inductive(inductive),
        lower: 0.0,
        upper: 1.0,
        ..honest.clone()
    };
    for &s in &oracle.moving {
        let value = if oracle.complement { Rational::one() - &exact[s] } else { exact[s].clone() };
        let (down, up) = (to_f64_down(&value), to_f64_up(&value));
        if down < 1.0 {
            let mut changed = inductive.clone();
            set(&mut changed.lower, s, down.next_up());
            if !changed.ranks.iter().any(|entry| entry.0 == StateId::from_index(s)) {
                set(&mut changed.ranks, s, u32::MAX);
            }
            rejected.judge("lower bound above the value", &with(changed), oracle.model, false);
        }
        if up > 0.0 {
            let mut changed = inductive.clone();
            set(&mut changed.upper, s, up.next_down());
            rejected.judge("upper bound below the value", &with(changed), oracle.model, false);
        }
    }
    for at in 0..inductive.ranks.len() {
        let mut changed = inductive.clone();
        changed.ranks[at].1 = 0;
        rejected.judge("no rank", &with(changed), oracle.model, false);
    }
    let mut values = oracle.start();
    if !oracle.policy_max {
        oracle.moving.iter().for_each(|&s| values[s] = 1.0);
    }
    let bounds = if oracle.policy_max { &inductive.lower } else { &inductive.upper };
    bounds.iter().for_each(|&(s, value)| values[s.index()] = value);
    for (at, &(s, choice)) in inductive.choices.iter().enumerate() {
        let count = oracle.model.choices().rows(s).count() as u32;
        for other in (0..count).filter(|&other| other != choice) {
            let limit = oracle.limit(oracle.policy_max, s.index(), Some(other), &values).unwrap();
            let bound = rational(values[s.index()]);
            if if oracle.policy_max { limit < bound } else { limit > bound } {
                let mut changed = inductive.clone();
                changed.choices[at].1 = other;
                rejected.judge("swapped action", &with(changed), oracle.model, false);
            }
        }
    }
}
