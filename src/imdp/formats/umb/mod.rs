//! The unified Markov binary format, UMB 1.0, of interval MDPs and interval DTMCs.
//!
//! A tar archive, as a rule compressed with gzip, of a JSON index and arrays in little-endian order:
//!
//! | member | entries |
//! |---|---|
//! | `index.json` | how many states, choices and branches (transitions) there are, what labels and variables are called |
//! | `state-to-choices.bin` | `u64` per state and one more: where its choices start |
//! | `choice-to-branches.bin` | `u64` per choice and one more: where its branches start |
//! | `state-is-initial.bin` | one bit per state, lowest first, filled up to 8 bytes |
//! | `branch-to-target.bin` | `u64` per branch: its destination |
//! | `branch-to-probability.bin` | two `f64` per branch: its bounds |
//! | `actions/choices/…` | per choice an index into a list of names, which may be empty |
//! | `annotations/aps/<id>/states/values.bin` | per label, one bit per state |
//! | `valuations/states/valuations.bin` | per state the values of its variables, packed bit by bit |
//!
//! PRISM 4.10, Storm and the Python package `umbi` read what is written here, and [`import`] what they write.
//!
//! *Lower bounds of 0.* PRISM refuses them and Storm does in unbounded properties, so they are written as a tiny
//! constant as in [`prism`](super::prism), one that the model does not have otherwise. The index says which, under
//! `file-data/parameters/zero-lower-bound`, and [`import`] turns it back into 0. *States without choices* get a
//! self-loop, for they are treated as absorbing, and the annotation `dynabs/without-choices`, which [`import`]
//! understands.
//!
//! The bytes are a function of the model and of the compression: no time, no user, a fixed order.

mod member;
mod read;
mod write;

pub use read::{import, import_with_progress};
pub use write::{Compression, UmbWriter};
