//! Storm's explicit text format, DRN, of interval MDPs and interval DTMCs.
//!
//! ```text
//! // Written by dynabs
//! //! labels deadlock reached failed
//! //! variables x1 x2
//! @type: MDP
//! @value_type: double-interval
//! @parameters
//!
//! @reward_models
//!
//! @nr_states
//! 2
//! @nr_choices
//! 2
//! @model
//! state 0 init
//! //! values 3 -1
//!     action a_0
//!         0 : [0, 0.5]
//!         1 : [0.25, 1]
//! state 1 reached
//! //! values 4 -1
//!     action __NOLABEL__
//!         1 : [1, 1]
//! ```
//!
//! The format has no place for labels that no state has, for the order of labels, for variables, and for
//! states without choices that other tools can check. They stand in comments that begin with `//!`, which
//! Storm skips and [`import`] understands. A state without choices is written with a self-loop, for it is
//! treated as absorbing, and the comment `//! deadlock`. Without names of actions, a choice is called by its
//! index, as Storm does. Lower bounds of 0 are written as they are.

mod header;
mod read;
mod rewards;
mod state_line;
mod stopped;
mod valuations;
mod write;

pub use read::{import, import_with_progress};
pub use write::DrnWriter;

/// What Storm calls a choice without a name.
const UNNAMED: &str = "__NOLABEL__";
