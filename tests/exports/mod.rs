//! Controllers in every language they are exported to: all do what the library does, bit by bit.

mod asked;
mod languages;

use crate::common::tasks::{self, formula, sequence};
use crate::common::{document, root};
use asked::Exported;
use dynabs::model_file::Document;
use languages::{Comparison, interpreter, skipped};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

fn shipped(model: &str, sets: &[&str]) -> Exported {
    Exported::of(&document(model, &sets.iter().map(|&set| set.to_owned()).collect::<Vec<_>>()))
}

fn given(model: &Value) -> Exported {
    Exported::of(&Document::parse(Path::new("m.json"), &model.to_string()).unwrap())
}

/// The room of the tests of tasks, with a name that no language likes.
fn room(task: &Value, inputs: bool) -> Value {
    let mut model = tasks::room(task, inputs);
    model["name"] = json!("A room, 2*/");
    model
}

/// The room turned into a tube, with a feedback that is not zero.
fn tube() -> Value {
    let mut model = room(&json!({"goal": ["a"], "unsafe": ["b"], "horizon": 6}), true);
    // What the S-function has is called otherwise.
    model["name"] = json!("kept");
    model["partition"]["periodic"] = json!([false, true]);
    model["feedback"] = json!({"gain": [[0.7, 0.1], [0, 0.3]]});
    model["input"]["points"] = json!([9, 9]);
    model
}

/// Nothing to decide: a system without an input.
fn uncontrolled() -> Value {
    let noise = json!({"gaussian": {"deviation": 0.4}});
    json!({
        "name": "next",
        "dynamics": {"A": [[0.9, 0.1], [0, 0.8]]},
        "noise": {"components": [noise, noise]},
        "actions": "inputs",
        "partition": {"lower": [-3, -3], "upper": [3, 3], "cells": [12, 12]},
        "task": {"type": "stay", "safe": [{"lower": [-2, -2], "upper": [2, 2]}], "horizon": 5},
        "initial_state": [0, 0]
    })
}

/// Every kind of law, memory and horizon.
fn controllers() -> Vec<Exported> {
    vec![
        shipped("room_temperature", &[r#"/task/unsafe=[{"lower":[10],"upper":[null]}]"#]),
        shipped("room_temperature", &[r#"/task/horizon="infinite""#]),
        shipped("double_integrator", &[]),
        shipped("double_integrator_two_layer", &[]),
        shipped("spacecraft_aligned_two_layer", &[]),
        shipped("tracking/double_integrator", &[]),
        given(&room(&sequence(8), true)),
        given(&room(&sequence(8), false)),
        given(&room(&formula("(F a) &\n G !b", "ltlf", 4), true)),
        given(&room(&formula("(F a) & G !b", "ltlf", 4), false)),
        given(&room(
            &json!({"type": "stay", "safe": [{"lower": [-2, -2], "upper": [2, 2]}], "horizon": 5}),
            true,
        )),
        given(&tube()),
        given(&uncontrolled()),
    ]
}

fn compare(exported: Exported, everything: bool) -> Comparison {
    let comparison = Comparison::new(exported, 25_000, 4);
    comparison.c();
    let (python, octave) = (interpreter("DYNABS_NUMPY"), interpreter("DYNABS_OCTAVE"));
    assert!(!everything || (python.is_some() && octave.is_some()), "an interpreter is missing");
    if let Some(python) = &python {
        comparison.python(python);
    }
    match (&octave, &python) {
        (Some(octave), Some(_)) => comparison.octave(octave),
        (Some(_), None) => {
            skipped("Octave compares with tables that Python writes: DYNABS_OCTAVE needs DYNABS_NUMPY");
        }
        (None, _) => {}
    }
    comparison
}

#[test]
fn every_export_equals_the_library() {
    let mut all = [0; 6];
    for exported in controllers() {
        let comparison = compare(exported, false);
        let statuses = comparison.statuses();
        assert!(statuses[0] > 5_000, "{statuses:?}");
        all.iter_mut().zip(statuses).for_each(|(all, status)| *all += status);
    }
    assert!(all.iter().all(|&count| count > 10_000), "{all:?}");
}

/// A model file in 100,000 states: the one that DYNABS_MODEL names, as `scripts/compare-exports.sh` does.
#[test]
fn every_export_of_a_model() {
    let named = std::env::var("DYNABS_MODEL").ok();
    let path = named.clone().map_or_else(|| root().join("examples/systems/switching.json"), PathBuf::from);
    let document = Document::parse(&path, &std::fs::read_to_string(&path).unwrap()).unwrap();
    let statuses = compare(Exported::of(&document), named.is_some()).statuses();
    assert!(statuses[0] > 0, "{statuses:?}");
    println!(
        "{}: 100,000 states: {statuses:?} (acts, reached, unsafe, outside, no action, over)",
        path.display()
    );
}
