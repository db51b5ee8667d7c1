//! Properties: what is asked about a path formula.

use std::fmt;
use std::str::FromStr;

use super::{Optimum, ParseError, PathFormula, PropertyError, Resolution, Threshold, parse_property};
use crate::model::ModelKind;

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

/// A property of a given kind of model: who maximises, who minimises, and what is asked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Objective {
    /// Who maximises and who minimises. An interval DTMC has one choice per state, and both players agree.
    pub resolution: Resolution,
    /// The event whose probability is meant.
    pub path: PathFormula,
    /// What the value is compared with, if a verdict is asked for: it must hold in all initial states.
    pub threshold: Option<Threshold>,
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

    /// What the property means for a kind of model.
    ///
    /// `P>=p` asks for all policies and natures, hence for `Pminmin ≥ p`; likewise `P<=p` for
    /// `Pmaxmax ≤ p`. An interval DTMC has no policy, and its `Pmin` and `Pmax` become `Pminmin` and
    /// `Pmaxmax`.
    ///
    /// # Errors
    /// [`PropertyError::PlainOptimum`] for `Pmin` and `Pmax` of an interval MDP, which are read differently
    /// by different tools; [`PropertyError::NoPolicy`] for the four-letter forms of an interval DTMC.
    pub fn resolve(&self, kind: ModelKind) -> Result<Objective, PropertyError> {
        let (resolution, threshold) = match &self.question {
            Question::Value(optimum) => (optimum.resolve(kind)?, None),
            Question::Verdict(optimum, threshold) => (optimum.resolve(kind)?, Some(threshold)),
            Question::ForAll(threshold) if threshold.comparison.is_lower_bound() => {
                (Resolution::Pminmin, Some(threshold))
            }
            Question::ForAll(threshold) => (Resolution::Pmaxmax, Some(threshold)),
        };
        Ok(Objective { resolution, path: self.path.clone(), threshold: threshold.cloned() })
    }
}

impl fmt::Display for Property {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.with_path(&self.path.to_string()))
    }
}

impl FromStr for Property {
    type Err = ParseError;

    fn from_str(text: &str) -> Result<Self, ParseError> {
        parse_property(text)
    }
}
