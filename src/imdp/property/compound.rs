//! Questions that are made of several, or of rewards.

use super::tree::Node;
use std::fmt;

/// An expression of PRISM's language, to be evaluated on a model by [`crate::evaluation`].
#[derive(Clone, Debug)]
pub struct Compound {
    /// The name in front of it.
    pub name: Option<String>,
    text: String,
    pub(crate) root: Node,
}

impl Compound {
    pub(super) fn new(name: Option<String>, text: &str, root: Node) -> Self {
        Self { name, text: text.split_whitespace().collect::<Vec<_>>().join(" "), root }
    }

    /// The expression as text, with what its names stand for in their places: it needs no definitions.
    pub fn resolved(&self) -> String {
        self.root.to_string()
    }
}

impl fmt::Display for Compound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.name {
            Some(name) => write!(f, "\"{name}\": {}", self.text),
            None => f.write_str(&self.text),
        }
    }
}
