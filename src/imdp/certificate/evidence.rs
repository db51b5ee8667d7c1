//! The certificate itself.

use crate::model::StateId;
use crate::numeric::Rational;
use crate::property::{Nature, Property, Verdict};

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

/// A claim about an expression, and what proves the values of the operators in it, in the order of their evaluation.
#[derive(Clone, Debug, PartialEq)]
pub struct Derivation {
    /// The expression, with what its names stand for in their places.
    pub expression: String,
    /// What nature does in operators that name the policy's direction only.
    pub nature: Option<Nature>,
    /// The files of the model.
    pub files: Vec<FileDigest>,
    /// The number of states of the model.
    pub states: u64,
    /// What is claimed.
    pub claim: Claim,
    /// Why.
    pub proofs: Vec<Evidence>,
}

/// What is claimed about the initial states.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Claim {
    /// The value is at least and at most this, in every initial state; perhaps infinite.
    Between(f64, f64),
    /// Whether a formula holds in all of them.
    Verdict(Verdict),
}

/// What a certificate is about.
#[derive(Clone, Debug, PartialEq)]
pub enum Statement {
    /// One probability, perhaps compared with a threshold.
    Probability(Box<Certificate>),
    /// Anything else: rewards, and probabilities inside of each other.
    Expression(Derivation),
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
    /// For expected rewards of a number of steps: as [`Evidence::Steps`], bounds being any numbers of at least 0; without a
    /// step they are 0, or what the state earns.
    RewardSteps(Vec<Step>),
    /// For expected rewards until a goal, and for discounted ones.
    RewardInductive(RewardInductive),
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

/// Bounds on expected rewards that reproduce themselves; states ascending.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RewardInductive {
    /// The policy's choices.
    pub choices: Vec<(StateId, u32)>,
    /// The lower bounds that are above 0.
    pub lower: Vec<(StateId, f64)>,
    /// The upper bounds that are finite.
    pub upper: Vec<(StateId, f64)>,
    /// Upper bounds below 1 on the probability that the goal is met, the players flipped: the rewards of these states are
    /// infinite.
    pub missed: Vec<(StateId, f64)>,
}
