//! Why an expression has no value on a model.

use crate::automaton::LtlError;
use crate::property::PropertyError;
use crate::solver::SolveError;

/// An expression cannot be evaluated on a model.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EvaluationError {
    /// It does not fit the model.
    #[error(transparent)]
    Property(#[from] PropertyError),
    /// The solver cannot take a question that it asks.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// A path formula is too large.
    #[error(transparent)]
    Formula(#[from] LtlError),
    /// The file of an automaton cannot be used.
    #[error("{}: {problem}", file.display())]
    Automaton {
        /// The file.
        file: std::path::PathBuf,
        /// What is wrong with it.
        problem: String,
    },
    /// A proposition of an automaton is nothing of the model.
    #[error(
        "{}: found the proposition \"{name}\", which is no label of the model; expected its meaning behind the name of the file, \
         as in HOA: {{\"{}\", \"{name}\" <- x=1}}",
        file.display(),
        file.display()
    )]
    Proposition {
        /// The file of the automaton.
        file: std::path::PathBuf,
        /// The proposition.
        name: String,
    },
    /// The product with an automaton does not fit into memory.
    #[error(transparent)]
    Memory(#[from] crate::model::MemoryError),
    /// The product with an automaton is no model, which should not happen.
    #[error(
        "found a product of model and automaton that is no interval MDP: {0}; expected one; please report this"
    )]
    Product(String),
    /// The model has no such reward structure.
    #[error(
        "found no reward structure {found} in the model; expected one of its structures: {known}; .srew and .trew files beside a \
         .tra file are read, as `prism … -exportmodel m.tra,sta,lab,srew,trew` writes them"
    )]
    UnknownRewards {
        /// What was asked for.
        found: String,
        /// All structures.
        known: String,
    },
    /// A number has no value in some state.
    #[error("found {problem} in state {state}; expected an expression with a value in every state")]
    Undefined {
        /// The state.
        state: usize,
        /// What is wrong.
        problem: &'static str,
    },
    /// A filter for one state has none or several.
    #[error("found {found} states for filter(state, …); expected exactly one")]
    NotOneState {
        /// How many states satisfy the filter's condition.
        found: usize,
    },
    /// A filter has no states at all.
    #[error("found a filter whose condition holds in no state; expected one that holds somewhere")]
    NoState,
    /// A proof proves something else, or nothing.
    #[error(transparent)]
    Proof(#[from] crate::verify::Rejection),
    /// A formula inside of another is not decided in some state.
    #[error(
        "found a formula inside of a path formula that is not decided in state {state}; expected it to hold or to fail there; \
         bounds that are closer together may help"
    )]
    Undecided {
        /// The state.
        state: usize,
    },
}
