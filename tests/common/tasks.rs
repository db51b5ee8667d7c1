//! Tasks over named regions, for both kinds of actions: a package to be picked up at `a` and brought to `c` without meeting `b`.

use serde_json::{Value, json};

/// A room with named regions whose faces cut cells; `c` is a triangle. Known noise makes actions inputs, samples make them
/// targets.
pub fn room(task: &Value, inputs: bool) -> Value {
    let known = json!({"gaussian": {"deviation": 0.4}});
    let sampled =
        json!({"gaussian": {"mean": [0, 0], "covariance": [[0.01, 0], [0, 0.01]]}, "count": 4000, "seed": 3});
    let mut model = json!({
        "name": "room",
        "dynamics": {"A": [[0.9, 0], [0, 0.9]], "B": [[1, 0], [0, 1]]},
        "noise": if inputs { json!({"components": [known, known]}) } else { sampled },
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

pub fn sequence(horizon: impl Into<Value>) -> Value {
    let horizon: Value = horizon.into();
    json!({"type": "sequence", "sequence": [{"reach": "a"}, {"reach": "c", "avoid": ["b"]}], "horizon": horizon})
}

pub fn formula(text: &str, logic: &str, horizon: u64) -> Value {
    json!({"type": "formula", "formula": text, "logic": logic, "horizon": horizon})
}

/// As another tool may write `F (a & (!b U c))`.
pub const DELIVERY: &str = r#"HOA: v1
States: 3
Start: 0
AP: 3 "c" "b" "a"
Acceptance: 1 Inf(0)
--BODY--
State: 0 [!2 | !0 & 1] 0 [2 & !0 & !1] 1 [0 & 2] 2
State: 1 [!0 & !1] 1 [!0 & 1 & !2] 0 [!0 & 1 & 2] 0 [0] 2
State: 2 {0} [t] 2
--END--
"#;
