//! Deterministic automata from files in the Hanoi omega-automata format, version 1, which Spot, Owl, Rabinizer and PRISM's
//! `ltl2dstar` write (Babiak et al., CAV 2015).
//!
//! ```text
//! HOA: v1
//! States: 2
//! Start: 0
//! AP: 1 "goal"
//! Acceptance: 1 Inf(0)
//! --BODY--
//! State: 0
//! [!0] 0
//! [0] 1
//! State: 1 {0}
//! [t] 1
//! --END--
//! ```
//!
//! Acceptance may be any condition of `Fin` and `Inf`, of states or of edges. Edges that are not listed lead to a state that
//! accepts nothing. Automata that are not deterministic, or alternate, are refused.

mod acceptance;
mod error;
mod header;
mod label;
mod lexer;
mod read;

pub use error::{HoaError, HoaErrorKind};
pub use read::read_hoa;
