//! The solution of a property as a file, so that nobody need solve it again.
//!
//! It proves nothing (that is what [certificates](crate::certificate) do): whoever uses one trusts where it comes from. What
//! can be checked cheaply is checked: that it is about this model and property, and that everything is in its range.
//!
//! # The file
//!
//! One line of JSON (the header) with the property, the SHA-256 of the native model (or of the problem), how the computation ended
//! and how many of everything there are; then arrays of little-endian numbers without gaps, for `n` states, `m` changes of the
//! policy and `h` earlier steps:
//!
//! | array | type | content |
//! |---|---|---|
//! | lower bounds | `n × f64` | with all steps left |
//! | upper bounds | `n × f64` | |
//! | number of changes | `n × u32` | of the policy in every state |
//! | changes | `m × (u64, u32)` | steps left, choice; state after state, ascending in the steps left |
//! | earlier lower bounds | `h × n × f64` | with one step less, with two steps less, … |

mod header;
mod read;
mod write;

pub use header::SolutionFileError;
pub use read::{SolutionSubject, read};
pub use write::write;
