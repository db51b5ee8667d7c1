//! What is promised holds: at every step, whatever the samples, and with a word where they look odd.
use crate::common::controllers::Loop;
use crate::common::{document, root};
use assert_cmd::Command;
use dynabs::Warning;
use dynabs::abstraction::{Abstraction, compile};
use dynabs::controller::{Noise, Simulation};
use dynabs::guarantee::Evidence;
use dynabs::model_file::Document;
use dynabs::noise::NoiseSamples;
use dynabs::problem::Problem;
use dynabs::task::Safety;
use imdp::solver::{Answer, SolverOptions};
use rand::SeedableRng;
use rand_chacha::ChaCha12Rng;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn data(name: &str) -> PathBuf {
    root().join("tests/data/promises").join(name)
}

fn case(name: &str, sets: &[&str]) -> Document {
    let path = data(&format!("{name}.json"));
    let mut document = Document::parse(&path, &fs::read_to_string(&path).unwrap()).unwrap();
    sets.iter().for_each(|set| document.set(&set.parse().unwrap()).unwrap());
    document
}

fn problem(name: &str, sets: &[&str]) -> Problem {
    case(name, sets).problem().unwrap()
}

fn value(abstraction: &Abstraction) -> f64 {
    Answer::new(&abstraction.model, &abstraction.property, &SolverOptions::default()).unwrap().lower
}

#[test]
fn a_wall_between_grouped_steps_cannot_be_crossed() {
    let problem = problem("between", &[]);
    assert_eq!(problem.safety(), Safety::EveryStep);
    let closed = Loop::new(problem);
    assert_eq!(closed.answer.lower, 0.0);
    // What is promised elsewhere holds at every step.
    let cells = (0..closed.controller.num_cells()).map(dynabs::partition::CellId);
    let best =
        cells.max_by(|&a, &b| closed.controller.bound(a).total_cmp(&closed.controller.bound(b))).unwrap();
    let axes = closed.problem.grid().axes().iter().enumerate();
    let start: Vec<f64> = axes
        .map(|(j, axis)| imdp::numeric::to_f64(&axis.center(closed.problem.grid().coordinate(best, j))))
        .collect();
    let noise = Noise::of_plant(closed.problem.noise());
    let tally = Simulation::new(&closed.problem, &closed.controller, noise, 0).tally(&start, 1, 4000, &());
    assert!(closed.controller.bound(best) > 0.9);
    assert!(
        !tally.satisfaction(Safety::EveryStep, 0.01).contradicts(closed.controller.bound(best)),
        "{tally:?}"
    );
}

#[test]
fn the_spacecraft_keeps_clear_of_the_obstacle_at_every_step() {
    let closed = Loop::new(document("every_step/spacecraft_disaligned", &[]).problem().unwrap());
    assert_eq!(closed.problem.safety(), Safety::EveryStep);
    assert!(closed.answer.lower > 0.57, "{}", closed.answer.lower);
    let start = closed.problem.initial_state().unwrap();
    let noise = Noise::of_plant(closed.problem.noise());
    let tally = Simulation::new(&closed.problem, &closed.controller, noise, 0).tally(start, 1, 4000, &());
    assert!(!tally.satisfaction(Safety::EveryStep, 0.01).contradicts(closed.answer.lower), "{tally:?}");
    // Without rows for actions that need room nothing is promised there.
    let rows = closed.abstraction.targets.len();
    assert!(rows > closed.problem.grid().num_cells() as usize, "{rows}");
}

#[test]
fn the_old_statement_is_on_request_and_every_run_shows_what_it_lacks() {
    let closed = Loop::new(problem("between", &["/task/check=grouped"]));
    assert!(closed.problem.safety() == Safety::GroupedInstants && closed.answer.lower > 0.99);
    let noise = Noise::of_plant(closed.problem.noise());
    let tally =
        Simulation::new(&closed.problem, &closed.controller, noise, 0).tally(&[-1.05, 0.05], 1, 2000, &());
    assert_eq!((tally.satisfied, tally.unsafe_between), (0, 2000));
    assert!(!tally.satisfaction(Safety::GroupedInstants, 0.01).contradicts(closed.answer.lower));
    assert!(tally.satisfaction(Safety::EveryStep, 0.01).contradicts(closed.answer.lower));
}

#[test]
fn commands_say_first_what_is_not_promised() {
    let scratch = TempDir::new().unwrap();
    let out = scratch.path().join("run");
    let run = |program: &str, arguments: &[&str]| {
        let output = Command::cargo_bin(program).unwrap().args(arguments).output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    };
    let (model, out) = (data("between.json").display().to_string(), out.display().to_string());
    let text = run("dynabs-compile", &[&model, "-o", &out, "--no-tra", "--set", "/task/check=grouped"]);
    assert!(text.lines().next().unwrap().contains("NOT promised"), "{text}");
    let text = run("dynabs-check", &["simulate", &out, "--runs", "500"]);
    assert!(text.contains("safe at every step: this is not promised"), "{text}");
    let text = run("dynabs-compile", &[&model, "--dry-run", "--solve"]);
    assert!(!text.contains("NOT promised") && text.contains("false"), "{text}");
}

#[test]
fn grouped_samples_say_nothing_about_steps_in_between() {
    let refused = |check: &str| {
        let document = document(
            "spacecraft_aligned",
            &[
                format!("/task/check={check}"),
                r#"/noise={"samples":{"file":"noise/spacecraft.csv","of":"grouped"}}"#.into(),
            ],
        );
        document.problem().map(|problem| problem.safety()).map_err(|error| error.to_string())
    };
    assert_eq!(refused("grouped"), Ok(Safety::GroupedInstants));
    let error = refused("every_step").unwrap_err();
    assert!(error.contains("/task/check: found \"every_step\" with samples of \"grouped\" steps"), "{error}");
}

#[test]
fn the_outside_counts_in_between_where_the_task_says_so() {
    // From x = 1.9 with v = 0.5, steering to x = 1.9 with v = −0.5 goes through x = 2.1.
    let noise = r#"/noise={"gaussian":{"covariance":[[1e-6,0],[0,1e-6]]},"count":1000,"seed":1}"#;
    let enabled = |list: &str| {
        let problem = problem("between", &[noise, &format!("/task/unsafe={list}")]);
        compile(&problem, &()).unwrap().model.size().choices
    };
    let (nothing, outside, wall) = (
        enabled("[]"),
        enabled(r#"["outside"]"#),
        enabled(r#"["outside",{"lower":[1.5,null],"upper":[2,null]}]"#),
    );
    assert!(nothing > outside && outside > wall, "{nothing} {outside} {wall}");
}

#[test]
fn an_overflowing_sample_makes_no_window_empty() {
    // The noise is 0 or 8.6 with equal chances: the goal is reached with probability .4994 of what is in the file.
    let abstraction = compile(&problem("overflow", &[]), &()).unwrap();
    let value = value(&abstraction);
    assert!(0.4 < value && value <= 0.4994, "{value}");
}

#[test]
fn one_far_sample_moves_neither_levels_nor_the_cell_of_a_target() {
    let rows = |file: &str| {
        let problem = problem("levels", &[&format!("/noise/samples/file={file}")]);
        let abstraction = compile(&problem, &()).unwrap();
        let rows: Vec<_> = abstraction
            .model
            .rows()
            .to_stored()
            .iter()
            .map(|row| (row.successors.to_vec(), row.lower.to_vec()))
            .collect();
        let Evidence::Samples(samples) = abstraction.guarantee.evidence else { panic!("samples") };
        (rows, samples.budget)
    };
    assert_eq!(rows("a.csv"), rows("b.csv"));
}

/// The model of a file in which the noise is what `noise` gives.
fn with_samples(scratch: &TempDir, noise: impl FnMut(usize) -> f64) -> Problem {
    let values: Vec<f64> = (0..1600).map(noise).collect();
    fs::write(scratch.path().join("noise.csv"), NoiseSamples::new(1, values).to_csv()).unwrap();
    let value: Value = json!({
        "name": "series", "dynamics": {"A": [[1]], "B": [[1]]},
        "noise": {"samples": {"file": "noise.csv", "of": "step"}},
        "input": {"lower": [-3], "upper": [3]},
        "partition": {"lower": [-10], "upper": [10], "cells": [20]},
        "task": {"goal": [{"lower": [-2], "upper": [2]}], "horizon": 3},
        "initial_state": [0.5],
    });
    let directory: &Path = scratch.path();
    Document { name: "series".into(), directory: directory.into(), value }.problem().unwrap()
}

fn uniform(random: &mut ChaCha12Rng) -> f64 {
    use rand::RngExt;
    random.random_range(-0.5..0.5)
}

fn looks_dependent(problem: &Problem) -> bool {
    problem.warnings().iter().any(|warning| matches!(warning, Warning::NotIndependent { .. }))
}

#[test]
fn dependent_samples_are_noticed() {
    let scratch = TempDir::new().unwrap();
    let mut random = ChaCha12Rng::seed_from_u64(1);
    assert!(!looks_dependent(&with_samples(&scratch, |_| uniform(&mut random))));
    let mut x = 0.0;
    assert!(looks_dependent(&with_samples(&scratch, |_| {
        x = 0.98 * x + 0.1 * uniform(&mut random);
        x
    })));
}

#[test]
fn a_warm_up_phase_does_not_decide_about_windows() {
    let scratch = TempDir::new().unwrap();
    let mut random = ChaCha12Rng::seed_from_u64(2);
    let steady = value(&compile(&with_samples(&scratch, |_| uniform(&mut random)), &()).unwrap());
    // As many samples as decide about the proportions of windows, all of them first.
    let warm_up = with_samples(&scratch, |i| uniform(&mut random) * if i < 48 { 0.01 } else { 1.0 });
    assert!(looks_dependent(&warm_up));
    let after = value(&compile(&warm_up, &()).unwrap());
    assert!((steady - after).abs() < 0.002, "{steady} {after}");
}
