//! Names that a format has no way to write.

use crate::model::{ActionNames, ImdpError, IntervalMdp, Labels, StateVariables};
use std::collections::HashSet;

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

/// What becomes of names that a format cannot express.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Names {
    /// They are an error.
    Keep,
    /// They are replaced by similar ones that no other has.
    #[default]
    Rename,
    /// Choices lose their names, labels and variables are left out.
    Drop,
}

/// A name that was changed for a format.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChangedName {
    /// `label`, `action` or `variable`.
    pub kind: &'static str,
    /// The name in the model.
    pub name: String,
    /// What is written instead; nothing if it is left out.
    pub written: Option<String>,
}

impl std::fmt::Display for ChangedName {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { kind, name, written } = self;
        match written {
            Some(written) => write!(f, "the {kind} `{}` is written as `{written}`", name.escape_debug()),
            None => write!(f, "the {kind} `{}` is left out", name.escape_debug()),
        }
    }
}

/// The names of a model made such that PRISM's files can express them.
///
/// # Errors
/// [`ImdpError`] never: the model stays what it is.
pub fn identifiers(model: IntervalMdp, names: Names) -> Result<(IntervalMdp, Vec<ChangedName>), ImdpError> {
    let mut changed = vec![];
    if names == Names::Keep {
        return Ok((model, changed));
    }
    let model = model.renamed(|actions, labels, variables| {
        if let ActionNames::OfChoice { names: of_choices, ids } = actions {
            let written = fit("action", of_choices, names, &mut changed);
            let dropped = |id: &u32| written.get(*id as usize).is_some_and(Option::is_none);
            ids.iter_mut().filter(|id| dropped(id)).for_each(|id| *id = ActionNames::UNNAMED);
            for (name, written) in of_choices.iter_mut().zip(written) {
                // A name that no choice has any more must still be one.
                *name = written.unwrap_or_else(|| "_".to_owned());
            }
        }
        let old: Vec<String> = labels.iter().map(|(name, _)| name.to_owned()).collect();
        let mut fitted = Labels::default();
        for ((_, states), written) in labels.iter().zip(fit("label", &old, names, &mut changed)) {
            if let Some(written) = written {
                fitted.insert(written, states.clone());
            }
        }
        *labels = fitted;
        let old: Vec<String> = variables.iter().map(|variable| variable.name.clone()).collect();
        let mut fitted = StateVariables::default();
        for (variable, written) in variables.iter().zip(fit("variable", &old, names, &mut changed)) {
            if let Some(written) = written {
                fitted.push(written, variable.values.clone());
            }
        }
        *variables = fitted;
    })?;
    Ok((model, changed))
}

/// For every name, what is written: itself if it is an identifier.
fn fit(
    kind: &'static str,
    all: &[String],
    names: Names,
    changed: &mut Vec<ChangedName>,
) -> Vec<Option<String>> {
    let mut taken: HashSet<String> = all.iter().filter(|name| is_identifier(name)).cloned().collect();
    let mut fit = |name: &String| {
        if is_identifier(name) {
            return Some(name.clone());
        }
        let written = (names == Names::Rename).then(|| {
            let fits = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
            let mut written: String = name.chars().map(fits).collect();
            if !written.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') {
                written.insert(0, '_');
            }
            while !taken.insert(written.clone()) {
                written.push('_');
            }
            written
        });
        changed.push(ChangedName { kind, name: name.clone(), written: written.clone() });
        written
    };
    all.iter().map(&mut fit).collect()
}
