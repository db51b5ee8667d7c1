//! The text format of bmdp-tool: counts, the states to be reached, and `state action destination lower upper` line by line.
//!
//! The first three lines hold the numbers of states, of actions and of states to be reached; those follow, one a line. The
//! latter are the label `reach` here. State 0 is the initial one, for the format names none.

mod read;
mod write;

pub(crate) use read::begins;
pub use read::{import, import_with_progress};
pub use write::BmdpWriter;
pub(in crate::formats) use write::padded_choices;

/// The label of the states to be reached.
pub(in crate::formats) const REACH: &str = "reach";
