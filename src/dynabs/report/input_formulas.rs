//! A model whose actions are inputs, in its own words.

use super::formulas::{boxes, partition};
use super::input_material::InputMaterial;
use super::markup::escape;
use super::numbers::short;
use crate::problem::Objective;
use crate::task::Aim;
use serde_json::Value;

/// Dynamics, noise and inputs as the model file has them; partition and task.
pub(super) fn model(material: &InputMaterial<'_>) -> String {
    let (run, scene) = (material.run, &material.scene);
    let mut text = String::new();
    for (title, pointer) in [
        ("Dynamics of one step", "/dynamics"),
        ("Noise of one step", "/noise"),
        ("Inputs", "/input"),
        ("Feedback about the centers of cells", "/feedback"),
    ] {
        if let Some(value) = run.document.value.pointer(pointer) {
            text += &format!("<p>{title}:</p>\n<pre class=\"wide\">{}</pre>\n", escape(&lines(value)));
        }
    }
    if let Some(how) = run.problem.mode().discretisation() {
        text += &format!("<p>A step is {}.</p>\n", escape(&how.to_string()));
    }
    text += &partition(scene);
    let periodic: Vec<&str> = scene
        .names
        .iter()
        .zip(run.problem.periodic())
        .filter(|(_, periodic)| **periodic)
        .map(|(name, _)| name.as_str())
        .collect();
    if !periodic.is_empty() {
        text += &format!("<p>Periodic: {}.</p>\n", periodic.join(", "));
    }
    let when = match scene.horizon {
        Some(steps) => format!("within {steps} steps"),
        None => "at any time".to_owned(),
    };
    match run.problem.objective() {
        Objective::Automaton(_) => {
            let task = run.document.value.pointer("/task").map(lines).unwrap_or_default();
            text += &format!("<p>Task:</p>\n<pre class=\"wide\">{}</pre>\n", escape(&task));
            if let Some(regions) = run.document.value.pointer("/regions") {
                text += &format!("<p>Regions:</p>\n<pre class=\"wide\">{}</pre>\n", escape(&lines(regions)));
            }
        }
        objective => {
            let (what, wanted) = match (objective.aim(), scene.horizon) {
                (Aim::Stay, Some(steps)) => {
                    (format!("stay in the safe region for {steps} steps"), "Safe region")
                }
                (Aim::Stay, None) => ("stay in the safe region for ever".to_owned(), "Safe region"),
                _ => (format!("reach the goal {when}"), "Goal"),
            };
            text += &format!("<p>Task: {what}, avoiding the unsafe region.</p>\n");
            text += &boxes(wanted, &scene.names, scene.wanted);
        }
    }
    text += &boxes("Unsafe region", &scene.names, scene.unsafe_);
    if let Some(threshold) = scene.threshold {
        text += &format!("<p>Asked for: at least {}.</p>\n", short(threshold));
    }
    text
}

/// A field to a line; short lists stay on theirs.
fn lines(value: &Value) -> String {
    match value {
        Value::Object(fields) => {
            let line = |(name, value): (&String, &Value)| match value {
                Value::Array(items) if items.iter().all(Value::is_string) => {
                    let items: Vec<_> = items.iter().filter_map(Value::as_str).collect();
                    format!(
                        "{name}: {}",
                        items.join(if name == "next" || name == "derivative" { "\n      " } else { ", " })
                    )
                }
                _ => format!("{name}: {value}"),
            };
            fields.iter().map(line).collect::<Vec<_>>().join("\n")
        }
        other => other.to_string(),
    }
}
