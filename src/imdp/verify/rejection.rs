//! Why a certificate is not accepted.

use super::Side;
use crate::model::{MemoryError, RowId, StateId};

/// A certificate that proves nothing about the model at hand.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Rejection {
    /// The model is another one.
    #[error(
        "found the SHA-256 {found} of the .{kind} file; expected {expected}, which the certificate says: another model was solved"
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
    #[error("found {found} states in the model; expected {expected}, as many as the certificate says")]
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
    #[error("found evidence for a property that is {evidence}; expected evidence for one that is {property}")]
    Evidence {
        /// `bounded` or `unbounded`, or what else it is about.
        property: &'static str,
        /// The other one.
        evidence: &'static str,
    },
    /// More steps than the property has.
    #[error("found evidence for {found} steps; expected {expected}, as many as the property has")]
    Steps {
        /// The certificate's.
        found: u64,
        /// The property's.
        expected: u64,
    },
    /// A state that does not exist or about which nothing can be claimed, or states out of order.
    #[error("{}: found state {state} in the list of {what}; expected {expected}", place(.step))]
    State {
        /// In which step.
        step: Option<u64>,
        /// The state.
        state: StateId,
        /// Which list.
        what: &'static str,
        /// What stands there if all is well.
        expected: &'static str,
    },
    /// A row that admits no distribution when its bounds are taken exactly.
    #[error(
        "found bounds of row {row} of the model that are further from sum 1 than rounding explains; expected bounds that admit a \
         distribution"
    )]
    NoDistribution {
        /// The row.
        row: RowId,
    },
    /// The policy must make a bound true but has no such choice.
    #[error("{}, state {state}: found no choice of the policy that exists; expected one for the {side} bound", place(.step))]
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
        "{}, state {state}: found the {side} bound {bound:?}, which does not follow; expected {} {expectation:?}, the expectation of \
         row {row}",
        place(.step),
        side.limit()
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
    #[error(
        "{}, state {state}: found the {side} bound {bound:?}, which does not follow; expected {} {value:?}, what staying there earns",
        place(.step),
        side.limit()
    )]
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
    #[error("state {state}: found rank {rank}; expected {}, or it may never be left", least_rank(*.needed, *.row))]
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
        "found the claim of a {side} bound {claimed:?} for the initial states; expected {} {proved:?}, which is proved of state {state}",
        side.limit()
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
        "found state {state} of the product with the automaton among those that satisfy the path formula, which it need not; \
         expected only those that must"
    )]
    Accepting {
        /// The state of the product.
        state: StateId,
    },
    /// Runs may satisfy a path formula elsewhere.
    #[error(
        "found state {state} of the product with the automaton missing, though the path formula may be satisfied from it; \
         expected all such states"
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
    #[error("found the claim that the formula {claimed}; expected what is proved, that it {proved}")]
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

fn least_rank(needed: u64, row: RowId) -> String {
    match needed {
        u64::MAX => format!("a policy without row {row}, which need not meet any rank"),
        needed => format!("at least {needed}, as row {row} need not meet a smaller one"),
    }
}
