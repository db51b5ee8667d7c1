//! Tasks as memories: what a run of the system has done so far, as far as its task cares.
//!
//! A task is a deterministic automaton that reads, step by step, which regions the state is in. A *memory* is one of its
//! states; [`CellTask`] says what a memory may become in each cell of a partition. Where a cell straddles the face of a region
//! several letters are possible, and nature picks one: it may do more than the state can in truth, so lower bounds are
//! bounds from below and upper ones from above. To reach and to stay somewhere are tasks with a single memory.

mod automaton;
mod cells;
mod labels;
mod region;
mod safety;
mod standing;

pub use automaton::AutomatonTask;
pub use cells::{CellTask, Letters, Straddling};
pub use imdp::automaton::Aim;
pub use labels::Label;
pub use region::{HalfSpace, Letter, LetterLookup, NamedRegion, Shape};
pub use safety::Safety;
pub use standing::{Memory, Standing};
