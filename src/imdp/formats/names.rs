//! Names that a format has no way to write.

use crate::model::{ActionNames, IntervalMdp};

/// A model has a name that the format to be written cannot express.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the {kind} `{}` cannot be written as {format}: found this name; expected {expected}", name.escape_debug())]
pub struct NameError {
    /// `label`, `action` or `variable`.
    pub kind: &'static str,
    /// The name.
    pub name: String,
    /// The format.
    pub format: &'static str,
    /// What its names look like.
    pub expected: &'static str,
}

/// What the names of a format look like.
pub(super) struct NameRule {
    pub format: &'static str,
    pub expected: &'static str,
    pub accepts: fn(&str) -> bool,
}

impl NameRule {
    /// Checks the labels of a model.
    pub(super) fn check_labels(&self, model: &IntervalMdp) -> Result<(), NameError> {
        self.check("label", model.labels().iter().map(|(name, _)| name))
    }
    /// Checks the names of the variables of a model.
    pub(super) fn check_variables(&self, model: &IntervalMdp) -> Result<(), NameError> {
        self.check("variable", model.variables().iter().map(|variable| variable.name.as_str()))
    }

    /// Checks the names of the choices of a model.
    pub(super) fn check_actions(&self, model: &IntervalMdp) -> Result<(), NameError> {
        match model.actions() {
            ActionNames::OfChoice { names, .. } => self.check("action", names.iter().map(String::as_str)),
            ActionNames::None | ActionNames::OfRow => Ok(()),
        }
    }

    fn check<'a>(
        &self,
        kind: &'static str,
        mut names: impl Iterator<Item = &'a str>,
    ) -> Result<(), NameError> {
        let Self { format, expected, accepts } = *self;
        match names.find(|name| !accepts(name)) {
            Some(name) => Err(NameError { kind, name: name.to_owned(), format, expected }),
            None => Ok(()),
        }
    }
}

/// A letter or `_`, then letters, digits and `_`.
pub(super) fn is_identifier(name: &str) -> bool {
    let inside = |byte: u8| byte.is_ascii_alphanumeric() || byte == b'_';
    name.bytes().next().is_some_and(|first| !first.is_ascii_digit()) && name.bytes().all(inside)
}
