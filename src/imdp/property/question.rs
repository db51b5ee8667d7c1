//! Properties: what is asked about a path formula.

use std::fmt;

use super::{Optimum, PathFormula, Resolution, Threshold};

/// A value that is asked for, or compared with a threshold.
///
/// This is what PRISM's text says; [`Property::resolve`] adds what it means for a kind of model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Property {
    /// The name in front of it, as in `"safe": Pmaxmin=? […]`.
    pub name: Option<String>,
    /// What is asked.
    pub question: Question,
    /// The event whose probability is meant.
    pub path: PathFormula,
}

/// What a property asks about the probability of a path formula.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Question {
    /// `Pmaxmin=? […]`: the value.
    Value(Optimum),
    /// `(Pmaxmin=? […])>=p`: whether the value satisfies a comparison.
    Verdict(Optimum, Threshold),
    /// `P>=p […]`: whether the probability satisfies a comparison under every policy and every nature.
    ForAll(Threshold),
}

impl Property {
    /// `<resolution>=? [ <path> ]`, without a name.
    pub fn value(resolution: Resolution, path: PathFormula) -> Self {
        Self { name: None, question: Question::Value(Optimum::Both(resolution)), path }
    }

    /// `(<resolution>=? [ <path> ])<threshold>`, without a name.
    pub fn verdict(resolution: Resolution, path: PathFormula, threshold: Threshold) -> Self {
        Self { name: None, question: Question::Verdict(Optimum::Both(resolution), threshold), path }
    }

    /// The same property with a name.
    pub fn named(self, name: impl Into<String>) -> Self {
        Self { name: Some(name.into()), ..self }
    }

    /// The text of the same question about another path formula, which this crate need not understand.
    pub fn with_path(&self, path: &str) -> String {
        let name = self.name.as_ref().map(|name| format!("\"{name}\": ")).unwrap_or_default();
        match &self.question {
            Question::Value(optimum) => format!("{name}{optimum}=? [ {path} ]"),
            // PRISM has no `Pmaxmin>=p […]`.
            Question::Verdict(optimum, threshold) => format!("{name}({optimum}=? [ {path} ]){threshold}"),
            Question::ForAll(threshold) => format!("{name}P{threshold} [ {path} ]"),
        }
    }
}

impl fmt::Display for Property {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.with_path(&self.path.to_string()))
    }
}
