//! Why a certificate is not accepted.

use super::Side;
use crate::model::{MemoryError, RowId, StateId};

/// A certificate that proves nothing about the model at hand.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Rejection {
    /// The model is another one.
    #[error(
        "another model was solved: the SHA-256 of the .{kind} file is {found}; the certificate says {expected}"
    )]
    Model {
        /// Which file.
        kind: String,
        /// Its SHA-256, or that there is none.
        found: String,
        /// What the certificate says.
        expected: String,
    },
    /// The number of states is another one.
    #[error("the model has {found} states; the certificate says {expected}")]
    States {
        /// The model's.
        found: u64,
        /// The certificate's.
        expected: u64,
    },
    /// The property does not fit the model.
    #[error("the property does not fit the model: {error}")]
    Property {
        /// Why.
        error: String,
    },
    /// Steps for an unbounded property or the other way round.
    #[error("the property is {property}, the evidence is for one that is {evidence}")]
    Evidence {
        /// `bounded` or `unbounded`, or what else it is about.
        property: &'static str,
        /// The other one.
        evidence: &'static str,
    },
    /// More steps than the property has.
    #[error("there is evidence for {found} steps; the property has {expected}")]
    Steps {
        /// The certificate's.
        found: u64,
        /// The property's.
        expected: u64,
    },
    /// A state that does not exist or about which nothing can be claimed, or states out of order.
    #[error("{}: state {state} in the list of {what} {problem}", place(.step))]
    State {
        /// In which step.
        step: Option<u64>,
        /// The state.
        state: StateId,
        /// Which list.
        what: &'static str,
        /// What is wrong.
        problem: &'static str,
    },
    /// A row that admits no distribution when its bounds are taken exactly.
    #[error(
        "row {row} of the model admits no distribution: its bounds are further from sum 1 than rounding explains"
    )]
    NoDistribution {
        /// The row.
        row: RowId,
    },
    /// The policy must make a bound true but has no such choice.
    #[error("{}, state {state}: the {side} bound needs a choice of the policy, found none that exists", place(.step))]
    NoChoice {
        /// In which step.
        step: Option<u64>,
        /// The state.
        state: StateId,
        /// Which bound.
        side: Side,
    },
    /// A bound does not follow.
    #[error(
        "{}, state {state}: the {side} bound {bound:?} does not follow: row {row} has the expectation {expectation:?}",
        place(.step)
    )]
    Bound {
        /// In which step.
        step: Option<u64>,
        /// The state.
        state: StateId,
        /// Which bound.
        side: Side,
        /// The bound.
        bound: f64,
        /// The row that refutes it.
        row: RowId,
        /// The row's expectation, rounded to the side of the bound.
        expectation: f64,
    },
    /// What a state that stays where it is earns is another number.
    #[error("{}, state {state}: the {side} bound {bound:?} does not follow: staying there earns {value:?}", place(.step))]
    Earned {
        /// In which step.
        step: Option<u64>,
        /// The state.
        state: StateId,
        /// Which bound.
        side: Side,
        /// The bound.
        bound: f64,
        /// What it is, rounded to the side of the bound.
        value: f64,
    },
    /// A rank that does not decrease.
    #[error(
        "state {state} has rank {rank}: by row {row} it need not meet a rank below {needed}, so it may never be left"
    )]
    Rank {
        /// The state.
        state: StateId,
        /// Its rank.
        rank: u32,
        /// The row.
        row: RowId,
        /// The least rank that the row would justify.
        needed: u64,
    },
    /// A claim about the initial states goes beyond what was proved.
    #[error(
        "the {side} bound {claimed:?} is claimed for the initial states; proved is only {proved:?} in state {state}"
    )]
    Claim {
        /// Which bound.
        side: Side,
        /// What is claimed.
        claimed: f64,
        /// What is proved, rounded outwards.
        proved: f64,
        /// The initial state.
        state: StateId,
    },
    /// A reward or a bound on one is too large to be added up in doubles.
    #[error("found a reward or a bound on one of {found:?}; expected at least 0 and less than {largest:?}")]
    Reward {
        /// The number.
        found: f64,
        /// What it must be below.
        largest: f64,
    },
    /// A policy cannot make sure that a path formula is satisfied.
    #[error(
        "state {state} of the product with the automaton counts as one that satisfies the path formula; it need not"
    )]
    Accepting {
        /// The state of the product.
        state: StateId,
    },
    /// Runs may satisfy a path formula elsewhere.
    #[error(
        "state {state} of the product with the automaton does not count, but the path formula may be satisfied from it"
    )]
    Missed {
        /// The state of the product.
        state: StateId,
    },
    /// The expression cannot be evaluated with what was proved.
    #[error("{problem}")]
    Expression {
        /// Why.
        problem: String,
    },
    /// The verdict that is claimed is not the one that was proved.
    #[error("it is claimed that the formula {claimed}; proved is that it {proved}")]
    Verdict {
        /// The claim.
        claimed: String,
        /// What was proved.
        proved: String,
    },
    /// The exact model does not fit into memory.
    #[error(transparent)]
    Memory(#[from] MemoryError),
}

fn place(step: &Option<u64>) -> String {
    step.map_or_else(|| "inductive bounds".to_owned(), |step| format!("step {step}"))
}
