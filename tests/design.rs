//! Designs that are left to the tool: how inputs share what is to be done, how many steps become one.
use crate::common::root;
use dynabs::abstraction::compile;
use dynabs::abstraction::inputs::InputAbstraction;
use dynabs::controller::Controller;
use dynabs::explain::{Reason, explain, explain_inputs};
use dynabs::model_file::{Document, StatedProblem};
use dynabs::problem::Problem;
use imdp::solver::{Answer, SolverOptions};
use std::fs;
use std::path::Path;

fn problem(name: &str, sets: &[&str]) -> Problem {
    let path = root().join(format!("tests/data/design/{name}.json"));
    let mut document = Document::parse(&path, &fs::read_to_string(&path).unwrap()).unwrap();
    sets.iter().for_each(|set| document.set(&set.parse().unwrap()).unwrap());
    document.problem().unwrap()
}

fn value(name: &str, sets: &[&str]) -> f64 {
    value_of(&problem(name, sets))
}

fn value_of(problem: &Problem) -> f64 {
    let abstraction = compile(problem, &()).unwrap();
    Answer::new(&abstraction.model, &abstraction.property, &SolverOptions::default()).unwrap().lower
}

/// A heater and a cooler that can each do as much are worth what one input is that can do both.
#[test]
fn opposed_inputs_are_as_good_as_one() {
    let two = value("heat_and_cool", &[]);
    let one = value("heat_and_cool", &["/dynamics/B=[[0.1]]", "/input/lower=[-10]", "/input/upper=[10]"]);
    assert!(two >= one && one > 0.99, "{two} {one}");
}

#[test]
fn an_input_more_does_not_harm_and_units_do_not_matter() {
    let both = value("weak_input", &[]);
    let strong = value("weak_input", &["/dynamics/B=[[1]]", "/input/lower=[-2]", "/input/upper=[2]"]);
    assert!(both >= strong && strong > 0.99, "{both} {strong}");
    // The weak one in thousandths.
    let sets = ["/dynamics/B=[[0.001, 1]]", "/input/lower=[-10, -2]", "/input/upper=[10, 2]"];
    assert_eq!(value("weak_input", &sets), both);
}

/// Three inputs for two states, one of them one-sided: about 0 nothing can be done with it.
#[test]
fn one_sided_inputs_are_used_about_their_middle() {
    let three = value("three_inputs", &[]);
    let sets = ["/dynamics/B=[[500, 0.2, 0.1], [100, 0.4, -0.3]]", "/input/lower=[-0.001, -1, 0]"];
    let other = value("three_inputs", &[sets[0], sets[1], "/input/upper=[0.001, 1, 2]"]);
    assert!(three > 0.4 && (three - other).abs() < 1e-6, "{three} {other}");
    // Without one of them it is less.
    let without = ["/dynamics/B=[[0.5, 0.2], [0.1, 0.4]]", "/input/lower=[-1, -1]", "/input/upper=[1, 1]"];
    let two = value("three_inputs", &without);
    assert!(three > two, "{three} {two}");
}

/// The fewest steps that make the grouped `B` of full rank let nothing be enabled here.
#[test]
fn as_many_steps_are_grouped_as_it_takes() {
    let problem = problem("slow_chain", &[]);
    let (last, others) = problem.grouping().split_last().unwrap();
    assert!(last.works() && last.steps == problem.group_steps());
    assert!(others.iter().all(|trial| trial.share > 0.5 || !trial.works()));
    assert_eq!(problem.grouping()[0].steps, 2);
    assert!(problem.grouping()[0].share > 1.0);
    assert!(value_of(&problem) > 0.9);
}

fn reasons(sets: &[&str]) -> Vec<Reason> {
    let problem = problem("heat_and_cool", sets);
    let abstraction = compile(&problem, &()).unwrap();
    let options = SolverOptions { policy: true, ..SolverOptions::default() };
    let answer = Answer::new(&abstraction.model, &abstraction.property, &options).unwrap();
    let controller = Controller::new(&problem, &abstraction, &answer).unwrap();
    let explanation = explain(&problem, &abstraction, &answer, &controller, &());
    assert_eq!(explanation.bound, answer.lower);
    assert!(explanation.to_string().lines().count() > explanation.reasons.len());
    explanation.reasons
}

#[test]
fn what_is_low_is_explained() {
    // Good as it is: runs succeed, and nothing else is to say.
    let good = reasons(&[]);
    assert!(matches!(&good[0], Reason::Losses { simulated, .. } if *simulated > 0.99), "{good:?}");
    assert!(
        matches!(&good[1], Reason::Noise { spreads } if (0.4..0.6).contains(&spreads[0].deviation)),
        "{good:?}"
    );
    // From 16.1 to 20 it takes several steps.
    let far = reasons(&["/task/horizon=1"]);
    assert!(matches!(far[0], Reason::TooFar { steps: Some(2..), horizon: Some(1), .. }), "{far:?}");
    // A hundred samples do not prove what a thousand do.
    let few = reasons(&["/noise/count=300"]);
    assert!(
        matches!(few[0], Reason::Samples { exact, samples: 300, needed: Some(600..) } if exact > 0.99),
        "{few:?}"
    );
    // Far more noise than room.
    let noisy = reasons(&["/noise/gaussian/covariance=[[9]]"]);
    let lost = |reason: &Reason| match reason {
        Reason::Losses { losses, .. } => {
            losses.iter().any(|loss| loss.end.contains("leave the partition at x1"))
        }
        _ => false,
    };
    assert!(noisy.iter().any(lost), "{noisy:?}");
    // From 16.5 the state comes to 16.85 ± 0.03, which is no target for a cell that moves by ± 0.09.
    let weak = reasons(&["/input/upper=[1.2, 1.2]", "/initial_state=[16.5]", "/dynamics/group_steps=1"]);
    assert!(matches!(&weak[0], Reason::NothingAtStart { idle: 1.., .. }), "{weak:?}");
    assert!(matches!(reasons(&["/initial_state=null"])[0], Reason::NoStart { .. }));
}

/// The reasons of a small problem whose actions are inputs.
fn input_reasons(sets: &[&str]) -> Vec<Reason> {
    let walk = serde_json::json!({
        "name": "walk", "dynamics": {"A": [[1]], "B": [[1]]}, "noise": {"components": [{"gaussian": {"deviation": 0.5}}]},
        "input": {"lower": [-1], "upper": [1], "points": [3]}, "partition": {"lower": [-5], "upper": [5], "cells": [20]},
        "task": {"goal": [{"lower": [3], "upper": [4]}], "horizon": 6}, "initial_state": [-1.25]
    });
    let mut document = Document::parse(Path::new("walk.json"), &walk.to_string()).unwrap();
    sets.iter().for_each(|set| document.set(&set.parse().unwrap()).unwrap());
    let StatedProblem::Inputs(problem) = document.stated().unwrap() else { panic!("inputs") };
    let abstraction = InputAbstraction::new(&problem).unwrap();
    let options = SolverOptions { policy: true, ..SolverOptions::default() };
    let solution = abstraction.question().solve(&options);
    let controller = Controller::of_inputs(&problem, &abstraction, &solution);
    let explanation = explain_inputs(&document, &problem, &abstraction, &solution, &controller, &());
    assert!(explanation.to_string().starts_with("why the bound is 0."), "{explanation}");
    explanation.reasons
}

#[test]
fn bounds_of_inputs_are_explained() {
    let between = |reasons: &[Reason]| {
        let found = reasons.iter().find_map(|reason| match reason {
            Reason::Between { lower, upper, .. } => Some((*lower, *upper)),
            _ => None,
        });
        found.unwrap()
    };
    let noiseless = |reasons: &[Reason]| {
        let found = reasons.iter().find_map(|reason| match reason {
            Reason::WithoutNoise { lower, upper } => Some((*lower, *upper)),
            _ => None,
        });
        found.unwrap()
    };
    let reasons = input_reasons(&[]);
    let (lower, upper) = between(&reasons);
    assert!(noiseless(&reasons).0 <= noiseless(&reasons).1 && noiseless(&reasons).1 == 1.0);
    let trials = reasons.iter().find_map(|reason| match reason {
        Reason::Trials { trials } => Some(trials),
        _ => None,
    });
    let trial = |field: &str| {
        let found = trials.unwrap().iter().find(|trial| trial.change.starts_with(&format!("{field}=")));
        found.unwrap_or_else(|| panic!("{field} {reasons:?}"))
    };
    // More inputs among which the old ones are can only do more; finer cells only know more.
    assert!(trial("/input/points").upper >= upper && trial("/partition/cells").lower >= lower, "{reasons:?}");
    assert!(trial("/partition/cells").upper <= upper + 1e-9, "{reasons:?}");
    let Some(Reason::Losses { simulated, losses }) =
        reasons.iter().find(|reason| matches!(reason, Reason::Losses { .. }))
    else {
        panic!("{reasons:?}")
    };
    assert!(lower <= simulated + 0.05 && *simulated <= upper + 0.05, "{lower} {simulated} {upper}");
    assert!(losses.iter().any(|loss| loss.end == "run out of time"), "{reasons:?}");
    assert!(
        matches!(reasons.last(), Some(Reason::Noise { spreads }) if (spreads[0].deviation - 1.0).abs() < 0.1)
    );
    // What is changed as it says has the bounds that it says.
    let change = &trial("/feedback").change;
    let changed = between(&input_reasons(&[change]));
    assert!((changed.0 - trial("/feedback").lower).abs() < 1e-3, "{changed:?}");

    // No input leads far enough in two steps, with or without noise.
    let far = input_reasons(&["/task/horizon=2"]);
    assert_eq!(noiseless(&far), (0.0, 0.0), "{far:?}");
    let text = far.iter().map(ToString::to_string).collect::<String>();
    assert!(text.contains("without noise no controller with these inputs does it"), "{text}");
}
