//! Models written in one format and read again, in any other.
#![allow(missing_docs, clippy::unwrap_used)]

#[path = "../common/mod.rs"]
mod common;
mod drn;
mod tiny;
