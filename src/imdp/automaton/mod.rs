//! Deterministic automata: of linear temporal logic, or read from files.
//!
//! A formula over propositions `0, 1, …` becomes a deterministic automaton with a generalised Rabin condition, by what is
//! known as the master theorem (Esparza, Kretinsky, Sickert: *One Theorem to Rule Them All*, LICS 2018). For a formula `φ`
//! in negation normal form let `μ` be its subformulas `F U M` and `ν` its subformulas `G W R`. A word `w` satisfies `φ` if
//! and only if for some `X ⊆ μ` (what holds again and again) and `Y ⊆ ν` (what holds for ever from some time on)
//!
//! 1. `∃i. wᵢ ⊨ af(φ, w₀ᵢ)[X]_ν`,
//! 2. `∀ψ ∈ X. w ⊨ GF ψ[Y]_μ`,
//! 3. `∀ψ ∈ Y. w ⊨ FG ψ[X]_ν`,
//!
//! where `af(φ, u)` is what remains of `φ` after the letters `u`, `[X]_ν` replaces `F U M` by what `X` says of them, which
//! leaves a safety formula, and `[Y]_μ` likewise a co-safety formula. Each is checked by what remains of it: a safety
//! formula has failed when nothing but false remains, a co-safety formula has succeeded when true does; then the check
//! starts anew. 1 and 3 hold if their checks fail finitely often, 2 if its checks succeed infinitely often.
//!
//! What remains of a formula is a positive Boolean combination of finitely many others, kept as the set of its minimal
//! disjuncts, which is the same for equivalent combinations: so there are finitely many states. They are made when they
//! are met.
//!
//! [`read_hoa`] reads others from files; a [`DeterministicAutomaton`] may have any condition of what is met infinitely often.

mod acceptance;
mod acceptor;
mod checks;
mod deterministic;
mod dfa;
mod finite;
mod formulas;
mod guard;
mod hoa;
mod ltl;
mod ltl_error;
#[cfg(test)]
mod random;
mod run;
mod text;

pub use deterministic::DeterministicAutomaton;
pub use dfa::{Aim, Dfa};
pub use hoa::{HoaError, HoaErrorKind, read_hoa};
pub use ltl::Ltl;
pub use ltl_error::LtlError;

pub(crate) use acceptor::{Acceptor, Condition};
pub(crate) use deterministic::MarkedAutomaton;
pub(crate) use run::Automaton;
pub use text::FormulaError;

#[cfg(test)]
mod tests;
