//! Constants, formulas and labels of a properties file.

use super::parser::{Parser, Result};
use super::tree::{Node, NodeKind};
use super::{ParseError, ParseErrorKind};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// What names in a property stand for. Everything in it is free of names that stand for something else.
#[derive(Clone, Debug, Default)]
pub struct Definitions {
    constants: HashMap<String, Option<Node>>,
    formulas: HashMap<String, Node>,
    labels: HashMap<String, Node>,
    /// Constants that were given a value from outside, and whether a file declares them.
    given: HashMap<String, Node>,
    /// Where files stand whose names are relative.
    folder: PathBuf,
}

impl Definitions {
    /// Gives constants values, as PRISM's `-const K=3,p=0.5` does.
    ///
    /// # Errors
    /// [`ParseError`] if the text is no list of such values.
    pub fn give(&mut self, text: &str) -> std::result::Result<(), ParseError> {
        for assignment in text.split(',').map(str::trim).filter(|assignment| !assignment.is_empty()) {
            let mut parser = Parser::new(assignment);
            let name = parser.name("NAME=VALUE, such as K=3")?;
            parser.expect("=", "`=` and a value")?;
            let value = parser.expression()?;
            parser.expect_end("the end of the value")?;
            self.given.insert(name, value);
        }
        Ok(())
    }

    /// Files that properties name are looked for in this folder from now on; otherwise in the one of the process.
    pub fn look_in(&mut self, folder: &Path) {
        folder.clone_into(&mut self.folder);
    }

    /// Declares a constant; what was given from outside counts more than what the file says.
    pub(super) fn constant(&mut self, name: String, value: Option<Node>) {
        let value = self.given.get(&name).cloned().or(value);
        self.constants.insert(name, value);
    }

    /// Declares a formula.
    pub(super) fn formula(&mut self, name: String, formula: Node) {
        self.formulas.insert(name, formula);
    }

    /// Declares a label.
    pub(super) fn label(&mut self, name: String, formula: Node) {
        self.labels.insert(name, formula);
    }

    /// What a node stands for, if it is a name for something else.
    fn meaning(&self, node: &Node) -> std::result::Result<Option<Node>, String> {
        Ok(match &node.kind {
            NodeKind::Variable(name) => match (self.constants.get(name), self.given.get(name)) {
                (Some(Some(value)), _) | (None, Some(value)) => Some(value.clone()),
                (Some(None), _) => return Err(name.clone()),
                (None, None) => self.formulas.get(name).cloned(),
            },
            NodeKind::Label(name) => self.labels.get(name).cloned(),
            _ => None,
        })
    }
}

impl Parser<'_> {
    /// Puts what names stand for in their places.
    pub(super) fn substitute(&self, node: Node, definitions: &Definitions) -> Result<Node> {
        match definitions.meaning(&node) {
            Ok(Some(mut meaning)) => {
                // Messages point to where the name stands.
                set_span(&mut meaning, node.span);
                self.node(meaning.kind, node.span)
            }
            Ok(None) => {
                let Node { mut kind, span, .. } = node;
                if let NodeKind::Automaton(path) = &mut kind {
                    path.file = definitions.folder.join(&path.file);
                }
                for child in kind.children_mut() {
                    let placeholder = Node::new(NodeKind::True, child.span);
                    let old = std::mem::replace(child, placeholder);
                    *child = self.substitute(old, definitions)?;
                }
                self.node(kind, span)
            }
            Err(name) => Err(self.error_at(node.span, ParseErrorKind::Undefined { name })),
        }
    }
}

fn set_span(node: &mut Node, span: super::parse_error::Span) {
    node.span = span;
    node.kind.children_mut().into_iter().for_each(|child| set_span(child, span));
}
