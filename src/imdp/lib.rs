//! Interval Markov decision processes: read, solved soundly, proved, compared.
//!
//! | module | what it holds |
//! |---|---|
//! | [`model`] | an [`IntervalMdp`](model::IntervalMdp): choices that share rows of intervals |
//! | [`property`] | PRISM's property language, as far as it speaks of interval models |
//! | [`automaton`] | temporal logic and HOA files as deterministic automata |
//! | [`evaluation`] | properties with several operators: formulas, rewards, temporal logic |
//! | [`formats`] | PRISM's explicit files, DRN, UMB, those of bmdp-tool and IntervalMDP.jl, and a native one |
//! | [`solver`] | robust value iteration with bounds from both sides, policies |
//! | [`solution_file`] | a solution stored, so that nobody need solve again |
//! | [`certificate`], [`verify`] | what proves a result, and the checker in exact arithmetic |
//! | [`compare`] | what differs between two runs |
//! | [`engines`] | PRISM and Storm, asked the same questions |
//! | [`numeric`], [`progress`] | exact and directed arithmetic; what long work tells and asks |
//! | [`files`] | what may be read, and output that appears whole or not at all |
//!
//! Nothing here knows of control. The solver fills in certificates, the checker reads them, and neither
//! knows the other.

pub mod automaton;
pub mod certificate;
pub mod compare;
pub mod engines;
pub mod evaluation;
mod exact;
pub mod files;
pub mod formats;
pub mod model;
pub mod numeric;
pub mod progress;
pub mod property;
pub mod ranks;
pub mod solution_file;
pub mod solver;
pub mod verify;
