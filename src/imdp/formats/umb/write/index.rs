//! `index.json`.

use super::{UmbWriter, member, valuations};
use crate::model::ModelKind;
use serde_json::{Map, Value, json};
use std::collections::HashSet;

impl UmbWriter<'_> {
    /// The index as text.
    pub(super) fn index(&self) -> String {
        let model = self.model;
        let mut file = json!({ "tool": "dynabs" });
        if let Some(raised) = self.raised {
            file["parameters"] = json!({ member::ZERO_LOWER_BOUND: raised });
        }
        let mut index = json!({
            "format-version": 1,
            "format-revision": 0,
            "file-data": file,
            "transition-system": {
                "time": "discrete",
                "#players": u64::from(model.kind() == ModelKind::Imdp),
                "#states": model.num_states(),
                "#initial-states": model.initial().count_ones(..),
                "#choices": self.choices,
                "#choice-actions": self.actions.count(),
                "#branches": self.branches,
                "#branch-actions": 0,
                "#observations": 0,
                "branch-probability-type": { "type": "double-interval", "size": 128 },
            },
        });
        let annotations = self.annotations();
        if !annotations.is_empty() {
            index["annotations"] = Value::Object(annotations);
        }
        if !model.variables().is_empty() {
            index["valuations"] = valuations::description(model);
        }
        format!("{index:#}\n")
    }

    fn annotations(&self) -> Map<String, Value> {
        let annotation = |alias: &str| json!({ "alias": alias, "applies-to": ["states"], "type": { "type": "bool", "size": 1 } });
        let mut groups = Map::new();
        let aps: Map<_, _> = self
            .label_ids()
            .into_iter()
            .zip(self.labels())
            .map(|(id, (name, _))| (id, annotation(name)))
            .collect();
        if !aps.is_empty() {
            groups.insert(member::APS.to_owned(), Value::Object(aps));
        }
        let rewards = self.reward_annotations();
        if !rewards.is_empty() {
            groups.insert(member::REWARDS.to_owned(), Value::Object(rewards));
        }
        if !self.deadlocks.is_clear() {
            groups.insert(
                member::OWN.to_owned(),
                json!({ member::WITHOUT_CHOICES: annotation("without choices") }),
            );
        }
        groups
    }

    /// Per label, an identifier of lower-case letters, digits, `_` and `-` that no other label has.
    pub(super) fn label_ids(&self) -> Vec<String> {
        unique_ids(self.labels().map(|(name, _)| name))
    }
}

/// Per name, an identifier of lower-case letters, digits, `_` and `-` that no other has.
pub(super) fn unique_ids<'n>(names: impl Iterator<Item = &'n str>) -> Vec<String> {
    let mut taken = HashSet::new();
    let unique = |name: &str| {
        let fit = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c.to_ascii_lowercase() } else { '_' };
        // The path of its values must fit into the header of a tar archive.
        let mut id: String = name.chars().map(fit).take(40).collect();
        while id.is_empty() || !taken.insert(id.clone()) {
            id.push('_');
        }
        id
    };
    names.map(unique).collect()
}
