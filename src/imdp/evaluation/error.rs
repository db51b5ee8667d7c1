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
    #[error("the product of model and automaton is no interval MDP: {0}; please report this")]
    Product(String),
    /// The model has no such reward structure.
    #[error(
        "the model has no reward structure {found}; its structures: {known} (.srew and .trew files beside a .tra file are read; \
         `prism … -exportmodel m.tra,sta,lab,srew,trew` writes them)"
    )]
    UnknownRewards {
        /// What was asked for.
        found: String,
        /// All structures.
        known: String,
    },
    /// A number has no value in some state.
    #[error("the value of an expression in state {state} is not defined: {problem}")]
    Undefined {
        /// The state.
        state: usize,
        /// What is wrong.
        problem: &'static str,
    },
    /// A filter for one state has none or several.
    #[error("filter(state, …) needs exactly one state, found {found}")]
    NotOneState {
        /// How many states satisfy the filter's condition.
        found: usize,
    },
    /// A filter has no states at all.
    #[error("the condition of a filter holds in no state")]
    NoState,
    /// A proof proves something else, or nothing.
    #[error(transparent)]
    Proof(#[from] crate::verify::Rejection),
    /// A formula inside of another is not decided in some state.
    #[error(
        "a formula inside of the path formula is not decided in state {state}; bounds that are closer together may help"
    )]
    Undecided {
        /// The state.
        state: usize,
    },
}
