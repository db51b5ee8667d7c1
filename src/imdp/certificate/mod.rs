//! Certificates: what is needed to check a result again, and the file that holds it.
//!
//! What a certificate proves, and why, is told by the checker, [`crate::verify`].
//!
//! # The file
//!
//! Lines of text, items separated by one space; states, choices, steps and ranks are counted as everywhere
//! (states and choices from 0, steps from 1, being the number of steps left). Numbers are shortest decimals
//! that read back as the same double.
//!
//! ```text
//! dynabs certificate 1
//! property <the property in PRISM's syntax>
//! model <kind> <sha256>            one line per file: dynabs, or tra, sta (if any) and lab
//! states <number of states>
//! claim <lower> <upper>            for all initial states
//! step <k>                         for bounded properties, k = 1, 2, … as long as anything changes
//! choices <state> <choice> …       what changes with k steps left; a line without items is left out
//! lower <state> <bound> …
//! upper <state> <bound> …
//! exact-lower <state> <n>/<d> …    bounds that are no doubles, where doubles cannot prove the claim
//! exact-upper <state> <n>/<d> …
//! inductive                        for unbounded properties, instead of steps
//! choices <state> <choice> …
//! lower <state> <bound> …          bounds above 0
//! upper <state> <bound> …          bounds below 1
//! exact-lower <state> <n>/<d> …
//! exact-upper <state> <n>/<d> …
//! ranks <state> <rank> …
//! end <sha256 of everything before this line>
//! ```
//!
//! Bounds are about the event (for `G`: its complement), claims about the property.

mod error;
mod evidence;
mod read;
mod write;

pub use error::CertificateError;
pub use evidence::{Certificate, Evidence, FileDigest, Inductive, Step};
pub use read::{read, read_file};
pub use write::write;

/// The first line of the file.
const FIRST_LINE: &str = "dynabs certificate 1";
