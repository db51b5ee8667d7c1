//! Comparing what two runs left behind: sizes, labels, intervals, results, values, policies.
//!
//! A [`Record`] holds what is known of one side: a run directory, explicit files, results, or a
//! [`Reference`], which is a summary of a model small enough to be kept under version control. [`diff`]
//! compares all that both sides have, says where they differ and by how much, worst first, and notes what
//! only one side has.
//!
//! [`engines`] asks other people's solvers what we computed, and compares.

mod actions;
mod backup;
mod compact_json;
mod comparison;
mod diff;
mod diff_digests;
mod diff_labels;
mod diff_models;
mod diff_policies;
mod diff_values;
mod digest;
pub mod engines;
mod error;
mod open;
mod paired_choices;
mod policy_file;
mod record;
mod reference;
mod results;
mod tolerance;
mod used_rows;

pub use comparison::{Comparison, Difference, Section};
pub use diff::{DiffOptions, diff};
pub use digest::{LabelDigest, ModelDigest, Sizes};
pub use error::CrosscheckError;
pub use open::open;
pub use policy_file::PolicyFile;
pub use record::{Record, Values};
pub use reference::Reference;
pub use results::RecordedResult;
pub use tolerance::Tolerance;
