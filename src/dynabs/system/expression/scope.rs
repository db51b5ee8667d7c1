//! What names stand for.

use super::functions::is_reserved;
use super::graph::NodeId;
use std::collections::BTreeMap;

/// The names that an expression may use.
#[derive(Clone, Debug, Default)]
pub struct Scope {
    names: BTreeMap<String, NodeId>,
}

/// Why something cannot have a name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NameError {
    /// It is no identifier.
    #[error("found the name \"{0}\"; expected letters, digits and _, beginning with a letter or _")]
    NotAName(String),
    /// It is the name of a function or of π.
    #[error("found the name \"{0}\", which has a meaning of its own in expressions; expected another")]
    Reserved(String),
    /// Something else has it.
    #[error("found the name \"{0}\" for a second thing; expected one meaning for every name")]
    Taken(String),
}

impl Scope {
    /// Gives `node` a name.
    ///
    /// # Errors
    /// [`NameError`] if the name cannot be used.
    pub fn insert(&mut self, name: &str, node: NodeId) -> Result<(), NameError> {
        let starts = name.chars().next().is_some_and(|c| c.is_alphabetic() || c == '_');
        if !starts || !name.chars().all(|c| c.is_alphanumeric() || c == '_') {
            return Err(NameError::NotAName(name.into()));
        }
        if is_reserved(name) {
            return Err(NameError::Reserved(name.into()));
        }
        if self.names.contains_key(name) {
            return Err(NameError::Taken(name.into()));
        }
        self.names.insert(name.into(), node);
        Ok(())
    }

    pub(super) fn get(&self, name: &str) -> Option<NodeId> {
        self.names.get(name).copied()
    }

    /// The known names, for an error.
    pub(super) fn describe(&self) -> String {
        if self.names.is_empty() {
            return "a number (no names are known here)".into();
        }
        let shown: Vec<_> = self.names.keys().take(20).map(String::as_str).collect();
        let more = if self.names.len() > shown.len() { ", …" } else { "" };
        format!("one of {}{more}", shown.join(", "))
    }
}
