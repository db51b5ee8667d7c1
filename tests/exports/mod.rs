//! Controllers in every language they are exported to: all do what the library does, bit by bit.

mod asked;
mod languages;

use crate::common::document;
use crate::common::tasks::{formula, sequence};
use asked::Exported;
use dynabs::model_file::Document;
use languages::{Comparison, interpreter};
use serde_json::{Value, json};
use std::path::Path;

fn shipped(model: &str, sets: &[&str]) -> Exported {
    Exported::of(&document(model, &sets.iter().map(|&set| set.to_owned()).collect::<Vec<_>>()))
}

fn given(model: &Value) -> Exported {
    Exported::of(&Document::parse(Path::new("m.json"), &model.to_string()).unwrap())
}

/// A room with regions whose faces cut cells, one of them a triangle; its noise makes actions inputs, or targets.
fn room(task: &Value, inputs: bool) -> Value {
    let known = json!({"components": [{"gaussian": {"deviation": 0.4}}, {"gaussian": {"deviation": 0.4}}]});
    let sampled =
        json!({"gaussian": {"mean": [0, 0], "covariance": [[0.01, 0], [0, 0.01]]}, "count": 4000, "seed": 3});
    let mut model = json!({
        "name": "A room, 2*/",
        "dynamics": {"A": [[0.9, 0], [0, 0.9]], "B": [[1, 0], [0, 1]]},
        "noise": if inputs { known } else { sampled },
        "input": {"lower": [-1, -1], "upper": [1, 1]},
        "partition": {"lower": [-3, -3], "upper": [3, 3], "cells": [12, 12]},
        "regions": {
            "a": {"lower": [1.2, -1], "upper": [3, 1.2]},
            "b": [{"lower": [-0.5, -2], "upper": [0.25, 0]}, {"lower": [2, 2], "upper": [3, 3]}],
            "c": {"G": [[1, 1], [-1, 0], [0, -1]], "g": [-2.25, 3, 3]}
        },
        "task": task,
        "initial_state": [-2, 2]
    });
    if inputs {
        model["input"]["points"] = json!([3, 3]);
    }
    model
}

/// The room turned into a tube, with a feedback that is not zero.
fn tube() -> Value {
    let mut model = room(&json!({"goal": ["a"], "unsafe": ["b"], "horizon": 6}), true);
    model["partition"]["periodic"] = json!([false, true]);
    model["feedback"] = json!({"gain": [[0.7, 0.1], [0, 0.3]]});
    model["input"]["points"] = json!([9, 9]);
    model
}

/// Nothing to decide: a system without an input.
fn uncontrolled() -> Value {
    let noise = json!({"gaussian": {"deviation": 0.4}});
    json!({
        "name": "uncontrolled",
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
        given(&room(&formula("(F a) & G !b", "ltlf", 4), true)),
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
    if let (Some(octave), Some(_)) = (&octave, &python) {
        comparison.octave(octave);
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

/// For `scripts/compare-exports.sh`: a model file in DYNABS_MODEL, in 100,000 states.
#[test]
#[ignore = "for scripts/compare-exports.sh, which names a model"]
fn every_export_of_a_model() {
    let path = std::env::var("DYNABS_MODEL").unwrap();
    let document = Document::parse(Path::new(&path), &std::fs::read_to_string(&path).unwrap()).unwrap();
    let statuses = compare(Exported::of(&document), true).statuses();
    println!("{path}: 100,000 states: {statuses:?} (acts, reached, unsafe, outside, no action, over)");
}
