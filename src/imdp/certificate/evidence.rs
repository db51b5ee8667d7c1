//! The certificate itself.

use crate::model::StateId;
use crate::numeric::Rational;
use crate::property::Property;

/// A claim about a property of a model, and what is needed to check it.
#[derive(Clone, Debug, PartialEq)]
pub struct Certificate {
    /// The property that was solved.
    pub property: Property,
    /// The files of the model.
    pub files: Vec<FileDigest>,
    /// The number of states of the model.
    pub states: u64,
    /// The claim: the value is at least this in every initial state.
    pub lower: f64,
    /// The claim: the value is at most this in every initial state.
    pub upper: f64,
    /// Why.
    pub evidence: Evidence,
}

/// A file that a model was read from.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct FileDigest {
    /// What it is: `dynabs` for the native format; `tra`, `sta` and `lab` for PRISM's explicit files.
    pub kind: String,
    /// Its SHA-256, in hexadecimal.
    pub sha256: String,
}

/// Bounds on the probability of the event in every state, and the policy that attains one of them.
///
/// The event is that of the property, or its complement for `G`.
#[derive(Clone, Debug, PartialEq)]
pub enum Evidence {
    /// For bounded properties: the first steps; further ones change nothing.
    Steps(Vec<Step>),
    /// For unbounded properties.
    Inductive(Inductive),
}

/// What changes with one more step left; states ascending.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Step {
    /// The policy's choice with so many steps left.
    pub choices: Vec<(StateId, u32)>,
    /// The lower bounds; 1 in the goal and 0 elsewhere without a step.
    pub lower: Vec<(StateId, f64)>,
    /// The upper bounds; 1 in the goal and 0 elsewhere without a step.
    pub upper: Vec<(StateId, f64)>,
    /// Lower bounds that are no doubles.
    pub exact_lower: Vec<(StateId, Rational)>,
    /// Upper bounds that are no doubles.
    pub exact_upper: Vec<(StateId, Rational)>,
}

/// Bounds that reproduce themselves; states ascending.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Inductive {
    /// The policy's choices.
    pub choices: Vec<(StateId, u32)>,
    /// The lower bounds that are above 0.
    pub lower: Vec<(StateId, f64)>,
    /// The upper bounds that are below 1.
    pub upper: Vec<(StateId, f64)>,
    /// Lower bounds that are no doubles, because rounded ones would not reproduce themselves.
    pub exact_lower: Vec<(StateId, Rational)>,
    /// Upper bounds that are no doubles.
    pub exact_upper: Vec<(StateId, Rational)>,
    /// Ranks of the states with a positive lower bound, at least 1: a lower rank is met with positive probability.
    pub ranks: Vec<(StateId, u32)>,
}
