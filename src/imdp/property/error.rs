//! What can be wrong with a property and a model that are each right on their own.

use super::{Optimum, Resolution};

/// A property does not fit its model.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PropertyError {
    /// The direction of nature is missing.
    #[error(
        "found {found} of an interval MDP, which does not say what nature does (PRISM reads it as {prism}, Storm as {storm}); \
         expected Pmaxmin, Pmaxmax, Pminmin or Pminmax (policy first, then nature)"
    )]
    PlainOptimum {
        /// What was written.
        found: Optimum,
        /// What PRISM reads.
        prism: &'static str,
        /// What Storm reads.
        storm: &'static str,
    },
    /// Neither direction is given, but there is something to choose.
    #[error(
        "found P=? or R=?, which do not say who maximises and who minimises; expected Pmaxmin, Pmaxmax, Pminmin or Pminmax \
         (interval MDP), or Pmin or Pmax (interval DTMC)"
    )]
    NoDirection,
    /// A weak until with a first step.
    #[error("found W with a first step, which is not supported; expected F, G or U with one, or W without")]
    LateWeakUntil,
    /// The direction of a policy is given, but there is none.
    #[error("found {found}, which needs a policy, but an interval DTMC has none; expected {instead}")]
    NoPolicy {
        /// What was written.
        found: Resolution,
        /// What to write.
        instead: &'static str,
    },
    /// The model has no such label.
    #[error("found no label \"{name}\" in the model; expected one of its labels: {}{}", list(.known), suggestion(.closest))]
    UnknownLabel {
        /// The label that was asked for.
        name: String,
        /// What may have been meant, as it is written in a formula.
        closest: Option<String>,
        /// All labels.
        known: Vec<String>,
    },
    /// The model has no such variable.
    #[error("found no variable {name} in the model; expected one of its variables: {}{}", list(.known), suggestion(.closest))]
    UnknownVariable {
        /// The variable that was asked for.
        name: String,
        /// What may have been meant, as it is written in a formula.
        closest: Option<String>,
        /// All variables.
        known: Vec<String>,
    },
    /// An integer variable stands where a formula must.
    #[error(
        "found the integer variable {name}, which is no formula by itself; expected a comparison, as in {name}=1"
    )]
    NotBoolean {
        /// The variable.
        name: String,
    },
    /// A Boolean variable stands where an integer must.
    #[error(
        "found the Boolean variable {name}, which is no integer; expected {name} or !{name} without a comparison"
    )]
    NotInteger {
        /// The variable.
        name: String,
    },
    /// An integer expression leaves the range of 64-bit integers.
    #[error(
        "found a value of {expression} in state {state} that does not fit into 64 bits; expected one that does"
    )]
    Overflow {
        /// The expression.
        expression: String,
        /// The state.
        state: usize,
    },
}

fn suggestion(closest: &Option<String>) -> String {
    closest.as_ref().map(|name| format!("; did you mean {name}?")).unwrap_or_default()
}

/// At most this many names are listed in a message.
const LISTED: usize = 20;

fn list(names: &[String]) -> String {
    match names.len() {
        0 => "none".to_owned(),
        n if n <= LISTED => names.join(", "),
        n => format!("{} and {} more", names[..LISTED].join(", "), n - LISTED),
    }
}
