//! A model whose actions are inputs, in its own words.

use super::formulas::partition;
use super::input_material::InputMaterial;
use super::markup::escape;
use super::numbers::short;
use super::task::{boxes, lines, task};

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
        text += &format!("<p>Periodic: {}.</p>\n", escape(&periodic.join(", ")));
    }
    text += &task(run.problem.objective(), &run.document.value, scene, scene.horizon);
    text += &boxes("Unsafe region", &scene.names, scene.unsafe_);
    if let Some(threshold) = scene.threshold {
        text += &format!("<p>Asked for: at least {}.</p>\n", short(threshold));
    }
    text
}
