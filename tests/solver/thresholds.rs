//! Thresholds equal to the value, which no bounds in doubles decide.

use super::reference::{self, Exact};
use super::{RESOLUTIONS, models, options};
use crate::common::certified::{certified, files};
use imdp::certificate::{Certificate, Evidence};
use imdp::evaluation::Evaluation;
use imdp::model::{IntervalMdp, StateId, StateSet};
use imdp::numeric::{Rational, from_decimal};
use imdp::property::{Definitions, Inquiry, Probability, Property, Resolution, Verdict, parse_inquiry};
use imdp::solver::{Answer, Inexact, SolverOptions};
use imdp::verify::check;
use num_rational::BigRational;
use proptest::prelude::*;

/// The comparisons, and whether a value equal to the threshold satisfies them.
const COMPARISONS: [(&str, bool); 4] = [(">=", true), (">", false), ("<=", true), ("<", false)];

/// Every comparison with the exact value is decided, and proved.
fn assert_decided(model: &IntervalMdp, resolution: Resolution, path: &str, exact: &BigRational) {
    for (comparison, holds) in COMPARISONS {
        let threshold = Probability::of_rational(exact.clone()).unwrap();
        let text = format!("({resolution}=? [ {path} ]){comparison}{threshold}");
        let property: Property = text.parse().unwrap();
        let (answer, certificate) = certified(model, &property, &options());
        assert_eq!(answer.satisfied(), Some(holds), "{text}: {answer:?}");
        for forged in forged(&certificate) {
            assert!(check(&forged, model, &files()).is_err(), "{text}: {forged:?}");
        }
    }
}

/// What claims a little more than the exact values in one of its places.
fn forged(honest: &Certificate) -> Vec<Certificate> {
    let little = from_decimal(1e-30).unwrap();
    let most = Rational::from_integer(1.into()) - &little;
    let with = |evidence| Certificate { evidence, ..honest.clone() };
    let mut list = vec![];
    match &honest.evidence {
        Evidence::Steps(steps) => {
            for (k, step) in steps.iter().enumerate() {
                for i in 0..step.exact_lower.len() {
                    let mut changed = steps.clone();
                    changed[k].exact_lower[i].1 += &little;
                    list.push(with(Evidence::Steps(changed)));
                    let mut changed = steps.clone();
                    changed[k].exact_upper[i].1 *= &most;
                    list.extend((steps[k] != changed[k]).then(|| with(Evidence::Steps(changed))));
                }
            }
        }
        Evidence::Inductive(inductive) => {
            for i in 0..inductive.exact_lower.len() {
                let mut changed = inductive.clone();
                changed.exact_lower[i].1 += &little;
                list.push(with(Evidence::Inductive(changed)));
                let mut changed = inductive.clone();
                changed.exact_upper[i].1 *= &most;
                list.push(with(Evidence::Inductive(changed)));
                let mut changed = inductive.clone();
                changed.ranks.iter_mut().for_each(|rank| rank.1 = 0);
                list.push(with(Evidence::Inductive(changed)));
            }
        }
        Evidence::RewardSteps(_) | Evidence::RewardInductive(_) => unreachable!(),
    }
    list.truncate(40);
    list
}

fn big(x: Exact) -> BigRational {
    BigRational::new((*x.numer()).into(), (*x.denom()).into())
}

/// Fewer cases than elsewhere: each is solved for every comparison, with a certificate.
fn config() -> ProptestConfig {
    let default = ProptestConfig::default();
    ProptestConfig { cases: default.cases.min(60), failure_persistence: None, ..default }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn bounded_thresholds_are_decided((model, safe, goal) in models::any_model(4, 6), steps in 0u64..6) {
        let labelled = models::labelled(&model, &safe, &goal);
        for (resolution, maxima) in RESOLUTIONS {
            let exact = reference::bounded(&model, &safe, &goal, steps, maxima, false);
            assert_decided(&labelled, resolution, &format!("\"safe\" U<={steps} \"goal\""), &exact[0]);
            let exact = reference::bounded(&model, &safe, &goal, 1, maxima, true);
            assert_decided(&labelled, resolution, "X \"goal\"", &exact[0]);
        }
    }

    #[test]
    fn unbounded_thresholds_are_decided((model, safe, goal) in models::any_model(3, 3)) {
        let exact = reference::unbounded(&model, &safe, &goal);
        let labelled = models::labelled(&model, &safe, &goal);
        for ((resolution, _), exact) in RESOLUTIONS.into_iter().zip(&exact) {
            assert_decided(&labelled, resolution, "\"safe\" U \"goal\"", &big(exact[0]));
        }
        let mut all = StateSet::with_capacity(safe.len());
        all.insert_range(..);
        let exact = reference::unbounded(&model, &all, &goal);
        for ((resolution, _), exact) in RESOLUTIONS.into_iter().zip(exact) {
            // Both sides change direction.
            let path = "G !\"goal\"";
            assert_decided(&labelled, resolution.flipped(), path, &(BigRational::from_integer(1.into()) - big(exact[0])));
        }
    }
}

/// Thresholds 0 and 1 are decided without any exact arithmetic, inside of formulas too.
fn assert_extremes_are_decided(model: &IntervalMdp, resolution: Resolution, path: &str, exact: &BigRational) {
    let options = SolverOptions { exact_work: 0, ..options() };
    for threshold in 0..=1 {
        let bound = BigRational::from_integer(threshold.into());
        for (comparison, _) in COMPARISONS {
            let holds = match comparison {
                ">=" => *exact >= bound,
                ">" => *exact > bound,
                "<=" => *exact <= bound,
                _ => *exact < bound,
            };
            let text = format!("({resolution}=? [ {path} ]){comparison}{threshold}");
            let expected = |holds| (if holds { Verdict::Holds } else { Verdict::Fails }, None);
            assert_eq!(verdict(model, &text, &options), expected(holds), "{text}: {exact}");
            assert_eq!(verdict(model, &format!("!({text})"), &options), expected(!holds), "{text}: {exact}");
        }
    }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn zero_and_one_are_decided_by_the_graph((model, safe, goal) in models::any_model(4, 6), steps in 0u64..6) {
        let labelled = models::labelled(&model, &safe, &goal);
        for (resolution, maxima) in RESOLUTIONS {
            let exact = reference::bounded(&model, &safe, &goal, steps, maxima, false);
            assert_extremes_are_decided(&labelled, resolution, &format!("\"safe\" U<={steps} \"goal\""), &exact[0]);
            let exact = reference::bounded(&model, &safe, &goal, 1, maxima, true);
            assert_extremes_are_decided(&labelled, resolution, "X \"goal\"", &exact[0]);
        }
    }

    #[test]
    fn zero_and_one_are_decided_for_ever((model, safe, goal) in models::any_model(3, 3)) {
        let exact = reference::unbounded(&model, &safe, &goal);
        let labelled = models::labelled(&model, &safe, &goal);
        for ((resolution, _), exact) in RESOLUTIONS.into_iter().zip(&exact) {
            assert_extremes_are_decided(&labelled, resolution, "\"safe\" U \"goal\"", &big(exact[0]));
        }
    }
}

/// State 0 meets the goal, state 1, with a probability in `[0.4, 0.6]`, else it stays or is lost in state 2.
fn coin() -> IntervalMdp {
    let rows = [vec![(0, 0.1, 0.2), (1, 0.4, 0.6), (2, 0.2, 0.5)]];
    let model = models::model(&rows, &[Some(vec![(0, 0)]), None, None]);
    models::labelled(&model, &models::set(3, &[0, 1, 2]), &models::set(3, &[1]))
}

fn verdict(model: &IntervalMdp, text: &str, options: &SolverOptions<'_>) -> (Verdict, Option<Inexact>) {
    match parse_inquiry(text, &Definitions::default()).unwrap() {
        Inquiry::Probability(property) => {
            let answer = Answer::new(model, &property, options).unwrap();
            (answer.verdict.unwrap(), answer.inexact)
        }
        Inquiry::Compound(compound) => {
            let evaluation = Evaluation::new(model, &compound, None, options).unwrap();
            (evaluation.verdict(StateId::from_index(0)).unwrap(), evaluation.inexact)
        }
    }
}

#[test]
fn thresholds_inside_of_formulas_are_decided() {
    let model = coin();
    for (text, holds) in [
        // The example of everyday.
        ("(Pmaxmin=? [ F<=1 \"goal\" ])>=0.4", true),
        ("(Pmaxmin=? [ F<=1 \"goal\" ])>0.4", false),
        ("P>=0.4 [ F<=1 \"goal\" ]", true),
        ("P>0.4 [ F<=1 \"goal\" ]", false),
        ("P<=0.6 [ F<=1 \"goal\" ]", true),
        ("P<0.6 [ F<=1 \"goal\" ]", false),
        // 0.4 + 0.1 · 0.4, 0.4 / 0.9 (to stay is worst for nature), and the other way round 0.6 / 0.8.
        ("(Pmaxmin=? [ F<=2 \"goal\" ])>=0.44", true),
        ("(Pmaxmin=? [ F<=2 \"goal\" ])>0.44", false),
        ("(Pmaxmin=? [ F \"goal\" ])<=4/9", true),
        ("(Pmaxmin=? [ F \"goal\" ])<4/9", false),
        ("(Pmaxmax=? [ F \"goal\" ])>=3/4", true),
        ("(Pmaxmin=? [ G !\"goal\" ])>=1/4", true),
        ("(Pmaxmin=? [ G !\"goal\" ])>1/4", false),
        // Expressions with numbers of both kinds, and equalities.
        ("1-(Pmaxmin=? [ F<=1 \"goal\" ])<=0.6", true),
        ("(Pmaxmax=? [ F<=1 \"goal\" ])-(Pmaxmin=? [ F<=1 \"goal\" ])=0.2", true),
        ("(Pmaxmax=? [ F \"goal\" ])>(Pmaxmin=? [ F \"goal\" ])+11/36", false),
        ("min(Pmaxmax=? [ F \"goal\" ], Pmaxmin=? [ F \"goal\" ])>=4/9", true),
        // Inside of path formulas, and twice.
        ("P>=1 [ X (P>=0.4 [ F<=1 \"goal\" ] | x!=0) ]", true),
        ("P>=0.4 [ F<=1 ((Pmaxmin=? [ F<=1 \"goal\" ])>=1) ]", true),
        ("P>0.4 [ F<=1 ((Pmaxmin=? [ F<=1 \"goal\" ])>=1) ]", false),
        ("(Pmaxmin=? [ F<=1 (P>=0.4 [ F<=1 \"goal\" ]) ])>=1", true),
        // Steps from a first one on: stay, then meet the goal.
        ("(Pmaxmin=? [ x=0 U[2,2] \"goal\" ])>=0.04", true),
        ("(Pmaxmin=? [ x=0 U[2,2] \"goal\" ])>0.04", false),
        ("(Pmaxmin=? [ F[1,1] \"goal\" ])>=0.4", true),
        // Through an automaton.
        ("(Pmaxmin=? [ (F \"goal\") & (F x=0) ])>=4/9", true),
        ("(Pmaxmin=? [ (F \"goal\") & (F x=0) ])>4/9", false),
        // Filters.
        ("filter(min, Pmaxmin=? [ F \"goal\" ], x<2)>=4/9", true),
        ("filter(avg, Pmaxmin=? [ F<=1 \"goal\" ], x<2)<0.7", false),
        ("filter(forall, (Pmaxmin=? [ F \"goal\" ])>=4/9, x<2)", true),
    ] {
        let expected = if holds { Verdict::Holds } else { Verdict::Fails };
        assert_eq!(verdict(&model, text, &SolverOptions::default()).0, expected, "{text}");
    }
}

#[test]
fn too_much_work_leaves_a_threshold_undecided() {
    let model = coin();
    for (text, enough) in [
        ("(Pmaxmin=? [ F<=2 \"goal\" ])>=0.44", 10_000),
        ("(Pmaxmin=? [ F \"goal\" ])>=4/9", 10_000),
        ("1-(Pmaxmin=? [ F \"goal\" ])>=5/9", 10_000),
    ] {
        let options = |exact_work| SolverOptions { exact_work, ..SolverOptions::default() };
        for work in [0, 10, 100, 300] {
            let (verdict, inexact) = verdict(&model, text, &options(work));
            assert_eq!((verdict, inexact), (Verdict::Unknown, Some(Inexact::TooLarge)), "{text} {work}");
        }
        assert_eq!(verdict(&model, text, &options(enough)), (Verdict::Holds, None), "{text}");
    }
    // Beside an initial state, others may take more than there is.
    let property: Property = "(Pmaxmin=? [ F \"goal\" ])>=4/9".parse().unwrap();
    let answer = Answer::new(&model, &property, &SolverOptions::default()).unwrap();
    assert_eq!(answer.exact.get(&StateId::from_index(0)), Some(&Rational::new(4.into(), 9.into())));
}
