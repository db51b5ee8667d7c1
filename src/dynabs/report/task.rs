//! The task in words, and the regions that it speaks of.

use super::markup::escape;
use super::numbers::short;
use super::scene::Scene;
use super::sides::sides;
use crate::partition::Region;
use crate::problem::Objective;
use crate::task::Aim;
use serde_json::Value;

/// What is wanted within so many steps, as the model file says it.
pub(super) fn task(objective: &Objective, model: &Value, scene: &Scene<'_>, steps: Option<u64>) -> String {
    let (what, wanted) = match (objective, steps) {
        (Objective::Automaton(_), _) => {
            let task = model.pointer("/task").map(lines).unwrap_or_default();
            let regions = model.pointer("/regions").map_or(String::new(), |regions| {
                format!("<p>Regions:</p>\n<pre class=\"wide\">{}</pre>\n", escape(&lines(regions)))
            });
            return format!("<p>Task:</p>\n<pre class=\"wide\">{}</pre>\n{regions}", escape(&task));
        }
        (objective, Some(steps)) if objective.aim() == Aim::Stay => {
            (format!("stay in the safe region for {steps} steps"), "Safe region")
        }
        (objective, None) if objective.aim() == Aim::Stay => {
            ("stay in the safe region for ever".to_owned(), "Safe region")
        }
        (_, Some(steps)) => (format!("reach the goal within {steps} steps"), "Goal"),
        (_, None) => ("reach the goal at any time".to_owned(), "Goal"),
    };
    format!("<p>Task: {what}, avoiding the unsafe region.</p>\n") + &boxes(wanted, &scene.names, scene.wanted)
}

/// A field to a line; short lists stay on theirs.
pub(super) fn lines(value: &Value) -> String {
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

/// A region as a list of boxes.
pub(super) fn boxes(name: &str, names: &[String], regions: &[Region]) -> String {
    if regions.is_empty() {
        return format!("<p>{name}: none.</p>\n");
    }
    let item = |region: &Region| {
        let side = |j: usize| {
            let (lower, upper) = sides(region, j);
            let x = escape(&names[j]);
            match (lower.is_finite(), upper.is_finite()) {
                (true, true) => Some(format!("{} ≤ {x} &lt; {}", short(lower), short(upper))),
                (true, false) => Some(format!("{x} ≥ {}", short(lower))),
                (false, true) => Some(format!("{x} &lt; {}", short(upper))),
                (false, false) => None,
            }
        };
        let sides: Vec<_> = (0..region.lower.len()).filter_map(side).collect();
        format!("<li>{}</li>", if sides.is_empty() { "everything".to_owned() } else { sides.join(", ") })
    };
    let items: String = regions.iter().map(item).collect();
    format!("<p>{name}:</p>\n<ul class=\"boxes\">{items}</ul>\n")
}
