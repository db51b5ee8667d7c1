//! Certificates: honest ones are accepted, false ones are not.
#![allow(missing_docs, clippy::unwrap_used)]

#[path = "../common/cases.rs"]
mod cases;
#[path = "../common/certified.rs"]
mod certified;
mod command_line;
#[path = "../common/mod.rs"]
mod common;
#[path = "../solver/reference.rs"]
#[allow(dead_code)]
mod exact;
mod falsified;
mod files;
#[path = "../solver/models.rs"]
mod models;
mod oracle;
mod random;
mod shipped;
