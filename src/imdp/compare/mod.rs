//! Comparing what two runs left behind: sizes, labels, intervals, results, values, policies.
//!
//! A [`Record`] holds what is known of one side: a directory, explicit files, results, or a
//! [`Reference`], which is a summary of a model small enough to be kept under version control. [`diff`]
//! compares all that both sides have, says where they differ and by how much, worst first, and notes what
//! only one side has.

mod actions;
pub(crate) mod backup;
mod compact_json;
mod comparison;
mod diff;
mod diff_digests;
mod diff_labels;
mod diff_models;
mod diff_policies;
mod diff_values;
mod digest;
mod error;
mod open;
mod options;
mod paired_choices;
mod policy_file;
pub(crate) mod record;
mod reference;
mod results;
mod tolerance;
mod used_rows;

pub use comparison::{Difference, Differences, Section};
pub use diff::diff;
pub use digest::{LabelDigest, ModelDigest, Sizes};
pub use error::CompareError;
pub use open::{collect, open};
pub use options::DiffOptions;
pub use policy_file::PolicyFile;
pub use record::Record;
pub use reference::Reference;
pub use results::{InitialResult, RecordedResult, ResultsFile};
pub use tolerance::Tolerance;
