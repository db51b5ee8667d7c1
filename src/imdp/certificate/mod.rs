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
//!
//! Other expressions have a line `expression` in place of `property`, and the proofs of all operators in them, in the order of
//! their evaluation:
//!
//! ```text
//! expression <PRISM's syntax, what names stand for in their places>
//! nature robust                    or cooperative, if operators name the policy's direction only
//! model …
//! states …
//! claim <lower> <upper>            or holds, fails, unknown
//! probability                      followed by the steps, or `inductive` and its lines, as above
//! reward                           followed by steps, or by:
//! inductive
//! choices <state> <choice> …
//! lower <state> <bound> …          bounds above 0
//! upper <state> <bound> …          bounds below infinity
//! missed <state> <bound> …         bounds below 1 on the probability of meeting the goal: what is earned is infinite
//! ```

mod error;
mod evidence;
mod read;
mod write;

pub use error::CertificateError;
pub use evidence::{
    Certificate, Claim, Derivation, Evidence, FileDigest, Inductive, RewardInductive, Statement, Step,
};
pub use read::{read, read_file, read_statement, read_statement_file};
pub use write::{write, write_derivation};

/// The first line of the file.
const FIRST_LINE: &str = "dynabs certificate 1";
